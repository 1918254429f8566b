#include "keyline/operations/sketch_trace.h"

#include <algorithm>

#include "keyline/core/text.h"
#include "keyline/exchange/document_file.h"
#include "keyline/exchange/image/image_reader.h"
#include "keyline/exchange/input_file.h"
#include "keyline/exchange/points/scap_reader.h"
#include "keyline/operations/base64.h"
#include "keyline/operations/registry.h"
#include "keyline/operations/sketch_run.h"

namespace keyline::operations {
namespace {

using core::ErrorCode;
using core::Result;

/// A wave of a soft pen, 48 × 32 pixels.
constexpr const char* kExample =
    "iVBORw0KGgoAAAANSUhEUgAAADAAAAAgBAAAAAC0T0nBAAAAjklEQVR42mP4jwMwjEogg9/2OCQK+LFLbGLALvGN"
    "gSEfm8RvBQZrbJb/S2Bgx+qqiQzM52ESuUjiWxgY6uH+YKiDix9lYLBBeJCBMQcqvpSBgQPJ5wYMDOb7gPStJAYG"
    "1vtIEj8VGBgYTUKcGBgYWPajhNVPoB4wYFmPFoi/k8Di5ucxQ3dnaWj6nMGfGAAkq7xgUI10+gAAAABJRU5ErkJg"
    "gg==";

Result<sketch::Image> image_of(const SketchRequest& request) {
  if (!request.file.empty()) return exchange::read_image_file(request.file);
  const auto bytes = decode_base64(request.image);
  if (!bytes)
    return core::fail(ErrorCode::bad_input, "is not base64", "encode the picture's bytes", "image");
  auto image = exchange::read_image(*bytes);
  if (!image) image.error().path = "image";
  return image;
}

/// A document's curves as strokes, sampled finely; width of the pen from the first that has one.
std::vector<sketch::DrawnStroke> strokes_of(const document::Document& document, double& pen) {
  std::vector<sketch::DrawnStroke> strokes;
  for (const document::NamedPath& named : document.paths) {
    if (pen <= 0) pen = named.stroke_width;
    sketch::DrawnStroke stroke{{}, named.path.closed};
    const int samples = 64 * std::max(1, static_cast<int>(named.path.curves.size()));
    for (int i = 0; i <= samples; ++i) {
      const core::Point2 p = evaluate(named.path, static_cast<double>(i) / samples);
      if (stroke.points.empty() || stroke.points.back() != p) stroke.points.push_back(p);
    }
    if (stroke.closed && stroke.points.size() > 1 && stroke.points.front() == stroke.points.back())
      stroke.points.pop_back();
    strokes.push_back(std::move(stroke));  // dots too: strokes keep their numbers
  }
  if (pen <= 0) pen = exchange::extent(document) / 400;
  return strokes;
}

/// What of a document is no stroke.
std::vector<std::string> left_out_of(const document::Document& document) {
  std::vector<std::string> left_out = document.skipped;
  if (!document.space_curves.empty())
    left_out.push_back(core::counted(document.space_curves.size(), "curve") + " in space");
  if (!document.surfaces.empty())
    left_out.push_back(core::counted(document.surfaces.size(), "surface"));
  return left_out;
}

/// The strokes of a file of vectors and the width of their pen.
Result<std::vector<sketch::DrawnStroke>> drawn_strokes(const std::string& file, double& pen,
                                                       std::vector<std::string>& left_out) {
  if (exchange::extension_of(file) != ".scap") {
    const auto document = exchange::read_document(file);
    if (!document) return std::unexpected(document.error());
    left_out = left_out_of(*document);
    return strokes_of(*document, pen);
  }
  const auto text = exchange::read_file(file);
  if (!text) return std::unexpected(text.error());
  const auto drawing = exchange::read_scap(*text);
  if (!drawing) return std::unexpected(exchange::in_file(drawing.error(), file));
  pen = drawing->pen;
  left_out = drawing->left_out;
  std::vector<sketch::DrawnStroke> strokes;
  for (const exchange::ScapStroke& s : drawing->strokes) {
    sketch::DrawnStroke stroke;
    stroke.points = exchange::upright(*drawing, s);
    strokes.push_back(std::move(stroke));  // dots too: strokes keep their numbers
  }
  return strokes;
}

std::vector<core::Point2> scaled(std::vector<core::Point2> points, double scale) {
  for (core::Point2& p : points) p = {scale * p.x, scale * p.y};
  return points;
}

StrokeShown shown(const sketch::Stroke& stroke, double scale) {
  StrokeShown all;
  all.points = scaled(stroke.points, scale);
  all.segments = scaled(stroke.segments, scale);
  all.curve.curve = path_of(stroke, {scale, 0, {}});
  all.corners = stroke.corners;
  all.closed = stroke.closed;
  all.width = scale * stroke.width;
  if (!stroke.members.empty()) all.members = stroke.members;
  if (stroke.driven)
    all.curvature_error =
        CurvatureErrorShown{stroke.driven->before / scale, stroke.driven->after / scale};
  return all;
}

/// Millimetres per pixel; 1 where lengths are pixels.
double scale_of(const SketchRequest& request) {
  constexpr double kInch = 25.4;  // mm
  if (request.dpi) return kInch / *request.dpi;
  return request.scale.value_or(1);
}

/// The curves' tolerance counts in pixels, or in widths of the pen (`one`), there.
void set_tolerance(const SketchRequest& request, double one, sketch::TraceOptions& options) {
  if (request.tolerance) options.curve.tolerance = *request.tolerance / (scale_of(request) * one);
  if (request.per_segment) options.curve.tolerance = 0;
}

Result<sketch::TraceResult> trace_vectors(const SketchRequest& request,
                                          sketch::TraceOptions options) {
  double pen = 0;
  std::vector<std::string> left_out;
  const auto strokes = drawn_strokes(request.file, pen, left_out);
  if (!strokes) return std::unexpected(strokes.error());
  set_tolerance(request, pen, options);
  auto traced = trace_drawn(*strokes, pen, options);
  if (traced)
    for (std::string& told :
         core::told_in_part(std::move(left_out), "further thing", "further things"))
      traced->notes.push_back("left out: " + std::move(told));
  return traced;
}

/// The drawing traced: a picture, or pen strokes of a file of vectors, which can be opened again.
Result<sketch::TraceResult> trace_readable(const SketchRequest& request, const Context& context,
                                           std::vector<sketch::Stage>& stages) {
  sketch::TraceOptions options = request.options;
  if (request.thresholds)
    options.binarize.regions = {request.thresholds->begin(), request.thresholds->end()};
  if (options.curve.rhythm != fit::WantedRhythm::own)
    options.curve.aim = sketch::CurvatureAim::rhythm;
  options.progress = context.progress;
  if (request.stages)
    options.stage = [&stages](const sketch::Stage& stage) { stages.push_back(stage); };
  const std::string extension =
      exchange::telling_extension(request.file, exchange::head_of(request.file).value_or(""));
  if (extension == ".scap" || extension == ".svg" || extension == ".json" || extension == ".dxf")
    return trace_vectors(request, options);
  auto image = image_of(request);
  if (!image) return std::unexpected(image.error());
  set_tolerance(request, 1, options);
  return trace_picture(std::move(*image), options);
}

/// The same of whatever is named: "-" and pipes too.
Result<sketch::TraceResult> trace_drawing(const SketchRequest& request, const Context& context,
                                          std::vector<sketch::Stage>& stages) {
  if (request.file.empty()) return trace_readable(request, context, stages);
  const auto file = exchange::InputFile::open(request.file, context.progress);
  if (!file) return std::unexpected(file.error());
  SketchRequest readable = request;
  readable.file = file->path().string();
  auto traced = trace_readable(readable, context, stages);
  if (!traced) return std::unexpected(file->as_named(traced.error()));
  return traced;
}

std::vector<StageShown> shown(const std::vector<sketch::Stage>& stages) {
  std::vector<StageShown> all;
  for (const sketch::Stage& s : stages) {
    const auto* bytes = reinterpret_cast<const char*>(s.picture.data.data());
    all.push_back(
        {s.name, s.picture.width, s.picture.height, encode_base64({bytes, s.picture.data.size()})});
  }
  return all;
}

Result<SketchAnswer> run(const SketchRequest& request, const Context& context) {
  if (request.file.empty() == request.image.empty())
    return core::fail(ErrorCode::bad_input, "a drawing is wanted, once",
                      "give either \"image\" (base64) or \"file\"", "image");
  if (request.scale && request.dpi)
    return core::fail(ErrorCode::bad_input, "the scale is given twice",
                      "give either \"scale\" or \"dpi\"", "dpi");
  SketchAnswer answer;
  auto trace = trace_drawing(request, context, answer.pictures);
  if (!trace) return std::unexpected(trace.error());
  answer.scale = scale_of(request);
  answer.unit = request.scale || request.dpi ? "mm" : "px";
  if (auto done =
          follow_wanted(request.target, trace->strokes, answer.scale, answer.unit, trace->notes);
      !done)
    return std::unexpected(done.error());
  for (const sketch::Stroke& stroke : trace->strokes)
    answer.strokes.push_back(shown(stroke, answer.scale));
  answer.size = {answer.scale * trace->width, answer.scale * trace->height};
  answer.sheet = trace->sheet;
  answer.explained = trace->explained;
  answer.left_over = trace->left_over;
  answer.report = trace->notes;
  if (request.stages) answer.stages = shown(answer.pictures);
  answer.trace = std::move(*trace);
  return answer;
}

}  // namespace

Result<void> SketchRequest::check(const SketchRequest& request) {
  const sketch::StrokeCurveOptions& curve = request.options.curve;
  if (curve.aim == sketch::CurvatureAim::smooth && curve.rhythm != fit::WantedRhythm::own)
    return core::fail(ErrorCode::bad_input, "curvature is to be smoothed and to have a rhythm",
                      "leave one of them out", "rhythm");
  if (request.options.sheet && request.options.rectify == sketch::Rectify::off)
    return core::fail(ErrorCode::bad_input, "a sheet is given and not to be rectified",
                      "leave one of them out", "rectify");
  if (request.options.wishes.empty() || request.options.consolidate) return {};
  return core::fail(ErrorCode::bad_input, "nothing is consolidated that wishes could be about",
                    "add --consolidate (\"consolidate\": true), or leave keep, join, split out",
                    "consolidate");
}

Operation sketch_trace_operation() {
  return declare<run>(
      {.name = "sketch.trace",
       .summary = "The lines of a drawing as G2 chains of quintics: points along their middle, "
                  "line segments, curve, width. The unit is the pixel (or mm with scale), y up "
                  "from the lower left corner.",
       .examples = {std::string(R"({"image":")") + kExample + R"("})"},
       .long_running = true,
       .reads_files = true});
}

}  // namespace keyline::operations
