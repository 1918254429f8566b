#include "keyline/operations/document_read.h"

#include <algorithm>

#include <fmt/format.h>

#include "keyline/core/text.h"
#include "keyline/exchange/cad/planar_form.h"
#include "keyline/exchange/document_file.h"
#include "keyline/exchange/image/image_reader.h"
#include "keyline/exchange/input_file.h"
#include "keyline/exchange/mesh/mesh.h"
#include "keyline/exchange/mesh/section_file.h"
#include "keyline/operations/document_points.h"
#include "keyline/operations/registry.h"
#include "keyline/operations/sketch_run.h"

namespace keyline::operations {
namespace {

using acquire::KeyLine;
using core::ErrorCode;
using core::fail;
using core::Result;

/// The longer strokes of a drawing, in pixels, and the drawing's page.
Result<ReadAnswer> read_drawing(const InputRequest& input, const core::Progress& progress) {
  const std::string& file = input.file.front();
  auto image = exchange::read_image_file(file);
  if (!image) return std::unexpected(image.error());
  sketch::TraceOptions options;
  options.progress = progress;
  const auto trace = in_file(trace_picture(std::move(*image), options), file);
  if (!trace) return std::unexpected(trace.error());
  std::size_t skipped = 0;
  auto lines = in_file(key_lines_of(*trace, skipped), file);
  if (!lines) return std::unexpected(lines.error());
  ReadAnswer answer;
  answer.unit = input.unit.empty() ? "px" : input.unit;
  answer.page = Page{{0, 0}, {static_cast<double>(trace->width), 1.0 * trace->height}};
  if (lines->empty())
    return fail(ErrorCode::bad_input, "holds no line long enough to fair",
                "give a drawing of longer lines", file);
  const auto wanted = in_file(wanted_of(*lines, input.select), file);
  if (!wanted) return std::unexpected(wanted.error());
  for (std::size_t i = 0; i < lines->size(); ++i)
    if ((*wanted)[i]) answer.curves.push_back(named_line((*lines)[i]));
  answer.notes = trace->notes;
  if (skipped > 0)
    answer.skipped.push_back(core::counted(skipped, "short stroke") + " of the drawing");
  auto& told = answer.curves.front().line->report.notes;  // those who fair it tell these
  told.insert(told.end(), answer.notes.begin(), answer.notes.end());
  for (const std::string& one : answer.skipped) told.push_back(one + " left out");
  return answer;
}

/// What a file holds, and which kinds of InputRequest it is of.
struct Opened {
  document::Document document;
  unsigned kind = 0;
};

/// The lines in which a plane cuts a mesh; of a cloud, its section as acquired.
Result<Opened> open_section(const InputRequest& input, const core::CancellationToken& cancellation,
                            const std::string& file) {
  const auto cut = cut_file(input, file);
  if (!cut) return std::unexpected(cut.error());
  document::Document document;
  document.unit = cut->unit;
  if (!cut->curves.empty()) document.skipped = cut->curves.front().left_out;
  for (std::size_t i = 0; i < cut->curves.size(); ++i) {
    const acquire::RawCurve& curve = cut->curves[i];
    curve::Polyline2 line;
    bool closed = cut->closed[i];
    if (cut->ordered) {
      for (const core::Point3 p : curve.points) line.points.push_back({p.x, p.y});
    } else {
      const auto acquired = in_file(
          acquire::acquire_key_line(curve, acquire_options(input.acquiring, cancellation)), file);
      if (!acquired) return std::unexpected(acquired.error());
      line.points = acquired->points;
      closed = acquired->closed;
    }
    if (closed) line.points.push_back(line.points.front());
    document.paths.push_back({{curve.id, {}, {}}, {{{std::move(line)}}, closed}, 0});
  }
  return Opened{std::move(document), cut->ordered ? InputRequest::kMesh : InputRequest::kCloud};
}

exchange::Format format_of(const std::string& file) {
  return exchange::format_of(file, exchange::head_of(file).value_or(""));
}

Result<Opened> open_curves(const InputRequest& input, const core::Progress& progress) {
  const std::string& file = input.file.front();
  if (exchange::is_mesh_file(file) && !input.section.empty())
    return open_section(input, progress.cancellation, file);
  auto document = exchange::read_document(
      file, {.glyphs = input.glyphs, .cancellation = progress.cancellation});
  if (!document) return std::unexpected(document.error());
  unsigned kind = format_of(file) == exchange::Format::font ? InputRequest::kFont : 0U;
  if (!document->surfaces.empty()) kind |= InputRequest::kSurfaces;
  return Opened{std::move(*document), kind};
}

template <class Thing>
NamedCurve named(const document::Label& label, const Thing& curve, double width) {
  return {label.name, label.layer, label.color, width, AnyCurve{curve}, {}};
}

ReadAnswer answer_of(Opened opened) {
  document::Document& document = opened.document;
  ReadAnswer answer;
  answer.kind = opened.kind;
  answer.unit = document.unit;
  for (const auto& p : document.paths)
    answer.curves.push_back(named(p.label, simplest(p.path), p.stroke_width));
  for (const auto& c : document.space_curves) answer.curves.push_back(named(c.label, c.curve, 0));
  for (const auto& s : document.surfaces)
    answer.surfaces.push_back({s.label.name, s.label.layer, s.label.color, s.surface, s.trims});
  if (document.page) answer.page = Page{document.page->low, document.page->high};
  answer.skipped = document.skipped;
  answer.document = std::move(document);
  return answer;
}

}  // namespace

std::optional<Placement> placement_of(const acquire::Plane& plane) {
  if (plane == acquire::Plane{}) return std::nullopt;
  const auto point = [](core::Vector3 v) { return core::Point3{} + v; };
  return Placement{plane.origin, point(plane.axis_x), point(plane.axis_y)};
}

namespace {

/// Half-breadths stay on their side of the centre plane.
void place(NamedCurve& curve, const exchange::Laid& laid) {
  curve.plane = placement_of(laid.plane);
  if (!laid.half_breadth) return;
  const core::Vector3 across{0, 1, 0};
  if (laid.plane.axis_x == across) curve.keep_inside = {{fairing::Axis::x, 0.0, {}}};
  if (laid.plane.axis_y == across) curve.keep_inside = {{fairing::Axis::y, 0.0, {}}};
}

Result<ReadAnswer> read_curves(const InputRequest& input, const core::Progress& progress) {
  const std::string& file = input.file.front();
  auto opened = open_curves(input, progress);
  if (!opened) return std::unexpected(opened.error());
  document::Document& document = opened->document;
  if (auto done = in_file(document::select(document, input.select), file); !done)
    return std::unexpected(done.error());
  take_unit(document.unit, input.unit, document.skipped);
  if (input.trims) document::add_trim_curves(document);
  if (!input.planar) return answer_of(std::move(*opened));
  const std::size_t plane_already = document.paths.size();
  const auto planes = exchange::flatten(document);
  if (document.paths.empty() && document.surfaces.empty())
    return fail(ErrorCode::bad_input, "there is no planar curve in it",
                "give curves that lie in a plane", file);
  ReadAnswer answer = answer_of(std::move(*opened));
  for (std::size_t i = 0; i < planes.size(); ++i) {
    NamedCurve& curve = answer.curves[plane_already + i];
    place(curve, planes[i]);
    const std::string& name = curve.name;
    answer.notes.push_back((name.empty() ? fmt::format("curve {}", plane_already + i + 1) : name) +
                           ": " + exchange::in_words(planes[i].plane));
  }
  return answer;
}

Result<ReadAnswer> read_files(const InputRequest& request, const core::Progress& progress) {
  const std::string& file = request.file.front();
  const bool points =
      !exchange::has_image_name(file) && format_of(file) == exchange::Format::points;
  if (!points && request.file.size() > 1)
    return fail(ErrorCode::bad_input, "several files are parts of one key-line of points",
                "give one file of curves, or one drawing, at a time", "file");
  if (points) return read_points_input(request, progress.cancellation);
  auto read = exchange::has_image_name(file) ? read_drawing(request, progress)
                                             : read_curves(request, progress);
  if (read) read->kind |= InputRequest::kAlone;
  return read;
}

Result<ReadAnswer> run(const InputRequest& request, const Context& context) {
  return read_input(request, context.progress);
}

}  // namespace

Result<ReadAnswer> read_input(const InputRequest& request, const core::Progress& progress) {
  InputRequest readable = request;
  std::vector<exchange::InputFile> files;
  for (std::string& file : readable.file) {
    auto opened = exchange::InputFile::open(file, progress);
    if (!opened) return std::unexpected(opened.error());
    file = opened->path().string();
    files.push_back(std::move(*opened));
  }
  auto read = read_files(readable, progress);
  if (progress.stop_requested())
    return fail(ErrorCode::cancelled, "cancelled", {}, request.file.front());
  if (read) read->unused = unused_fields(request, read->kind);
  if (!read)
    for (const exchange::InputFile& file : files)
      read = std::unexpected(file.as_named(read.error()));
  return read;
}

Operation document_read_operation() {
  return declare<run>(
      {.name = "document.read",
       .summary =
           "What a file holds: curves and surfaces as they are, measured points put in order "
           "and cleaned, the lines of a drawing.",
       .examples = {R"({"file":"examples/clothoid.csv"})"},
       .long_running = true,
       .reads_files = true});
}

}  // namespace keyline::operations
