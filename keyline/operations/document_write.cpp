#include "keyline/acquire/plane.h"
#include "keyline/exchange/document_file.h"
#include "keyline/operations/document_read.h"
#include "keyline/operations/registry.h"

namespace keyline::operations {
namespace {

using core::Result;

struct WriteRequest {
  std::vector<std::string> file;
  std::string unit;
  std::vector<NamedCurve> curves;
  std::vector<NamedSurfaceValue> surfaces;
  std::optional<Page> page;
  double tolerance = 0;
  bool polylines = false;
  bool grid = false;
  static constexpr auto describe() {
    using Request = WriteRequest;
    return core::fields(
        core::field<&Request::file>("to write; the extension chooses the format: svg, json, csv, "
                                    "dxf, step, iges, glif")
            .count(1)
            .or_bare_item()
            .needed(),
        core::field<&Request::unit>("of all lengths; empty: none"),
        core::field<&Request::curves>("in the plane or in space"),
        core::field<&Request::surfaces>("Bezier or B-spline"),
        core::field<&Request::page>("what a drawing shows; else tight around the curves"),
        core::field<&Request::tolerance>(
            "largest deviation where a format cannot hold a curve as it is; 1e-5 of the longest "
            "unless given")
            .in("length")
            .within(core::kPositive),
        core::field<&Request::polylines>("dxf: polylines in place of splines"),
        core::field<&Request::grid>("glif: nodes and handles on whole numbers"));
  }
};

struct Written {
  std::string file;
  double deviation = 0;
  std::vector<std::string> notes;
  static constexpr auto describe() {
    return core::fields(core::field<&Written::file>("as asked for"),
                        core::field<&Written::deviation>("of what is not exact in it").in("length"),
                        core::field<&Written::notes>("what the format could not hold, in words"));
  }
};

struct WriteAnswer {
  std::vector<Written> written;
  static constexpr auto describe() {
    return core::fields(core::field<&WriteAnswer::written>("one for each file"));
  }
};

document::Path path_of(const acquire::KeyLine& line) {
  curve::Polyline2 polyline{line.points};
  if (line.closed) polyline.points.push_back(line.points.front());
  return {{{std::move(polyline)}}, line.closed};
}

document::Document document_of(const WriteRequest& request) {
  document::Document document;
  document.unit = request.unit;
  for (const NamedCurve& c : request.curves) {
    const document::Label label{c.name, c.layer, c.color};
    if (c.line) document.paths.push_back({label, path_of(*c.line), c.stroke_width});
    if (!c.curve) continue;
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

Result<WriteAnswer> run(const WriteRequest& request, const Context&) {
  const document::Document document = document_of(request);
  exchange::WriteOptions options;
  options.tolerance = request.tolerance;
  options.polylines = request.polylines;
  options.grid = request.grid;
  WriteAnswer answer;
  for (const std::string& file : request.file) {
    auto written = exchange::write_document(document, file, options);
    if (!written) return std::unexpected(exchange::in_file(written.error(), file));
    answer.written.push_back({file, written->deviation, written->notes});
  }
  return answer;
}

}  // namespace

Operation document_write_operation() {
  return declare<run>({.name = "document.write",
                       .summary = "Curves and surfaces into files, each whole or not at all.",
                       .examples = {R"({"file":"/tmp/keyline-example.json","curves":[
           {"name":"a","curve":{"type":"polyline","points":[[0,0],[1,1]]}}]})"},
                       .writes_files = true});
}

}  // namespace keyline::operations
