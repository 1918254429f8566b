#include "keyline/operations/document_write.h"

#include <algorithm>

#include "keyline/core/text.h"
#include "keyline/exchange/cad/planar_form.h"
#include "keyline/exchange/file/atomic_file.h"
#include "keyline/operations/registry.h"

namespace keyline::operations {
namespace {

using core::Result;

document::Path path_of(const acquire::KeyLine& line) {
  curve::Polyline2 polyline{line.points};
  if (line.closed) polyline.points.push_back(line.points.front());
  return {{{std::move(polyline)}}, line.closed};
}

/// How far it reaches from its start, about; 1 where it is a point.
double size_of(const document::Path& path) {
  constexpr int kSamples = 16;
  const core::Point2 start = evaluate(path.curves.front(), 0);
  double size = 0;
  for (const document::PlanarCurve& member : path.curves)
    for (int i = 0; i <= kSamples; ++i)
      size = std::max(size, core::distance(start, evaluate(member, 1.0 * i / kSamples)));
  return size > 0 ? size : 1;
}

/// A plane curve with a plane as a curve of space; false for other curves, which lie where they
/// are. tolerance: 0 for 1e-5 of its size.
bool put_in_space(document::Document& document, const NamedCurve& named, double tolerance) {
  const auto path = planar_path(*named.curve);
  if (!path || path->curves.empty()) return false;
  const auto vector = [](core::Point3 p) { return p - core::Point3{}; };
  const acquire::Plane plane{named.plane->origin, vector(named.plane->axis_x),
                             vector(named.plane->axis_y)};
  const double within = tolerance > 0 ? tolerance : 1e-5 * size_of(*path);
  document.space_curves.push_back(
      {{named.name, named.layer, named.color}, exchange::placed(*path, plane, within)});
  return true;
}

bool is_planar_format(const std::string& extension) {
  return extension == ".svg" || extension == ".svgz" || extension == ".glif" || extension == ".pdf";
}

/// Whether the curves were traced in a picture.
bool is_picture(const ReadAnswer& read) { return read.page && read.document.paths.empty(); }

/// Moved so that the page's upper left corner is the origin.
document::Document from_corner(document::Document document) {
  const core::Point2 corner{document.page->low.x, document.page->high.y};
  const core::Similarity2 map{1, 0, core::Point2{} - corner};
  for (document::NamedPath& named : document.paths)
    named.path = document::transform(named.path, map);
  const core::Vector2 size = document.page->high - document.page->low;
  document.page = curve::Box2{{0, -size.y}, {size.x, 0}};
  return document;
}

Result<WriteAnswer> write(const document::Document& document, const std::vector<std::string>& names,
                          const FormatOptions& options, bool on_page,
                          const core::Progress& progress) {
  exchange::OutputFiles files;
  WriteAnswer answer;
  for (const std::string& name : names) {
    auto written =
        formatted(document, exchange::extension_of(name), options, on_page, progress.cancellation);
    if (!written) return std::unexpected(exchange::in_file(written.error(), name));
    if (auto done = files.add(name, written->content); !done) return std::unexpected(done.error());
    answer.written.push_back({name, written->deviation, std::move(written->notes)});
  }
  if (progress.stop_requested()) return core::fail(core::ErrorCode::cancelled, "cancelled");
  if (auto done = files.commit(); !done) return std::unexpected(done.error());
  answer.unused = unused_of(options, names);
  return answer;
}

Result<WriteAnswer> run(const WriteRequest& request, const Context& context) {
  return write(document_of(request), request.file, request.format, request.on_page,
               context.progress);
}

struct ConvertRequest {
  InputRequest input;
  std::vector<std::string> to;
  FormatOptions format;
  static constexpr auto describe() {
    using Request = ConvertRequest;
    return core::fields(core::flattened<&Request::input>(),
                        core::field<&Request::to>("files to write; the extension chooses the "
                                                  "format: svg, json, csv, dxf, step, iges, glif, "
                                                  "pdf")
                            .count(1)
                            .or_bare_item()
                            .needed(),
                        core::flattened<&Request::format>());
  }
};

Result<WriteAnswer> run_convert(const ConvertRequest& request, const Context& context) {
  const auto read = read_input(request.input, context.progress);
  if (!read) return std::unexpected(read.error());
  auto answer =
      write(document_of(*read), request.to, request.format, is_picture(*read), context.progress);
  if (answer) answer->unused.insert(answer->unused.end(), read->unused.begin(), read->unused.end());
  return answer;
}

}  // namespace

std::vector<std::string> unused_of(const FormatOptions& options,
                                   const std::vector<std::string>& files) {
  unsigned kind = 0;
  for (const std::string& file : files) {
    const std::string extension = exchange::extension_of(file);
    if (extension == ".dxf") kind |= FormatOptions::kDxf;
    if (extension == ".glif") kind |= FormatOptions::kGlif;
    if (extension == ".csv") kind |= FormatOptions::kCsv;
  }
  return unused_fields(options, kind);
}

document::Document document_of(const WriteRequest& request) {
  document::Document document;
  document.unit = request.unit;
  for (const NamedCurve& c : request.curves) {
    const document::Label label{c.name, c.layer, c.color};
    if (c.line) document.paths.push_back({label, path_of(*c.line), c.stroke_width});
    if (!c.curve) continue;
    if (c.plane && put_in_space(document, c, request.format.tolerance)) continue;
    if (const auto path = planar_path(*c.curve))
      document.paths.push_back({label, *path, c.stroke_width});
    else if (const auto* space = std::get_if<document::SpaceCurve>(&*c.curve))
      document.space_curves.push_back({label, *space});
    else
      for (const auto& member : std::get<SpacePath>(*c.curve).curves)
        document.space_curves.push_back({label, member});
  }
  for (const NamedSurfaceValue& s : request.surfaces)
    document.surfaces.push_back({{s.name, s.layer, s.color}, s.surface, s.trims});
  if (request.page) document.page = curve::Box2{request.page->low, request.page->high};
  return document;
}

document::Document document_of(const ReadAnswer& read) {
  document::Document document = read.document;
  document.unit = read.unit;
  for (const NamedCurve& named : read.curves)
    if (named.line) document.paths.push_back({{named.name, {}, {}}, path_of(*named.line), 0});
  if (!document.page && read.page) document.page = curve::Box2{read.page->low, read.page->high};
  return document;
}

Result<exchange::Written> formatted(const document::Document& document,
                                    const std::string& extension, const FormatOptions& options,
                                    bool on_page, const core::CancellationToken& cancellation) {
  const exchange::WriteOptions how{
      .tolerance = options.tolerance,
      .samples = options.samples.value_or(exchange::WriteOptions{}.samples),
      .polylines = options.polylines,
      .grid = options.grid,
      .cancellation = cancellation};
  if (!is_planar_format(extension)) return exchange::format_document(document, extension, how);
  document::Document planar;
  const document::Document* shown = &document;
  double departure = 0;
  if (document.paths.empty()) {
    planar = document;
    for (const exchange::Laid& laid : exchange::flatten(planar, exchange::kMostOfMeasured))
      departure = std::max(departure, laid.departure);
    shown = &planar;
  }
  const std::size_t flattened = planar.paths.size();
  if (on_page && shown->page) {
    planar = from_corner(*shown);
    shown = &planar;
  }
  auto written = exchange::format_document(*shown, extension, how);
  if (written && flattened > 0)
    written->notes.push_back(core::counted(flattened, "curve") +
                             " in space: in the coordinates of their planes");
  if (written && departure > 0) {
    written->deviation = std::max(written->deviation, departure);
    written->notes.push_back("points in space: the largest distance from their plane is " +
                             core::number_text(departure, 3));
  }
  return written;
}

std::vector<std::string> document_extensions() {
  std::vector<std::string> known = exchange::written_extensions();
  known.push_back(".pdf");
  return known;
}

Operation document_write_operation() {
  return declare<run>({.name = "document.write",
                       .summary = "Writes curves and surfaces to files, each whole or not at all.",
                       .examples = {R"({"file":"/tmp/keyline-example.json","curves":[
           {"name":"a","curve":{"type":"polyline","points":[[0,0],[1,1]]}}]})"},
                       .writes_files = true});
}

Operation document_convert_operation() {
  return declare<run_convert>(
      {.name = "document.convert",
       .summary = "Converts a file to other formats; writes all of the files or none.",
       .examples = {R"({"file":"examples/cubic.json","to":"/tmp/keyline-example.svg"})"},
       .long_running = true,
       .reads_files = true,
       .writes_files = true});
}

}  // namespace keyline::operations
