#include "keyline/operations/document_read.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "keyline/acquire/join.h"
#include "keyline/acquire/lattice.h"
#include "keyline/acquire/section.h"
#include "keyline/acquire/section_curves.h"
#include "keyline/acquire/symmetry.h"
#include "keyline/core/text.h"
#include "keyline/document/select.h"
#include "keyline/exchange/cad/planar_form.h"
#include "keyline/exchange/document_file.h"
#include "keyline/exchange/image/image_reader.h"
#include "keyline/exchange/input_file.h"
#include "keyline/exchange/mesh/mesh.h"
#include "keyline/exchange/mesh/section_file.h"
#include "keyline/exchange/points/lattice_reader.h"
#include "keyline/exchange/points/points_reader.h"
#include "keyline/operations/registry.h"
#include "keyline/operations/sketch_run.h"

namespace keyline::operations {
namespace {

using acquire::KeyLine;
using acquire::RawCurve;
using core::ErrorCode;
using core::fail;
using core::Result;

template <class T>
Result<T> in_file(Result<T> result, const std::string& file) {
  if (result) return result;
  return std::unexpected(exchange::in_file(result.error(), file));
}

Result<std::vector<RawCurve>> read_lattice_input(const InputRequest& input,
                                                 const std::string& file) {
  const auto lattice = exchange::read_lattice(file);
  if (!lattice) return std::unexpected(lattice.error());
  const auto index = static_cast<std::size_t>(input.row ? *input.row : *input.column);
  auto curve =
      input.row ? acquire::lattice_row(*lattice, index) : acquire::lattice_column(*lattice, index);
  if (!curve) return std::unexpected(curve.error());
  return std::vector<RawCurve>{std::move(*curve)};
}

/// Clouds whose columns are told: read whole, then cut.
Result<std::vector<RawCurve>> cut_table(const InputRequest& input,
                                        const std::vector<RawCurve>& clouds) {
  constexpr double kBand = 1.0 / 150;  // of the size, as section_of_file
  const auto request = exchange::parse_section(input.section);
  if (!request) return std::unexpected(request.error());
  std::vector<RawCurve> cuts;
  for (const RawCurve& cloud : clouds) {
    acquire::Plane plane = request->plane.value_or(acquire::Plane{});
    if (!request->plane) {
      const auto found = acquire::symmetry_plane(cloud.points);
      if (!found) return std::unexpected(found.error());
      plane = found->plane;
    }
    double size = 0;
    for (const core::Point3& p : cloud.points)
      if (core::is_finite(p)) size = std::max(size, core::distance(p, cloud.points.front()));
    const double band = size > 0 && std::isfinite(size) ? size * kBand : 1;
    auto curve = acquire::section_plane(cloud, plane, input.band.value_or(band));
    if (!curve) return std::unexpected(curve.error());
    for (RawCurve& part : acquire::section_curves(*curve, plane)) cuts.push_back(std::move(part));
  }
  return cuts;
}

Result<exchange::FileSection> cut_file(const InputRequest& input, const std::string& file) {
  const auto request = exchange::parse_section(input.section);
  if (!request) return std::unexpected(request.error());
  return exchange::section_of_file(file, *request, input.band);
}

Result<exchange::PointsFile> without_unit(Result<std::vector<RawCurve>> curves) {
  if (!curves) return std::unexpected(curves.error());
  return exchange::PointsFile{std::move(*curves), {}};
}

Result<exchange::PointsFile> read_raw(const InputRequest& input, const std::string& file) {
  if (input.row || input.column) return without_unit(read_lattice_input(input, file));
  const bool told =
      !input.columns.empty() || !input.weight_column.empty() || !input.id_column.empty();
  if (!input.section.empty() && !told) {
    auto cut = cut_file(input, file);
    if (!cut) return std::unexpected(cut.error());
    return exchange::PointsFile{std::move(cut->curves), {}};
  }
  exchange::PointsOptions options;
  options.columns = input.columns;
  options.weight_column = input.weight_column;
  options.id_column = input.id_column;
  auto raw = exchange::read_points_file(file, options);
  if (!raw || input.section.empty()) return raw;
  auto cuts = cut_table(input, raw->curves);
  if (!cuts) return std::unexpected(cuts.error());
  raw->curves = std::move(*cuts);
  return raw;
}

/// Of those of the name wanted; where there are none, that of the number, counted from 1.
template <class Curve>
bool is_wanted(const std::vector<Curve>& curves, std::size_t index, const std::string& wanted) {
  if (wanted.empty() || curves[index].id == wanted) return true;
  const bool named = std::any_of(curves.begin(), curves.end(),
                                 [&](const Curve& curve) { return curve.id == wanted; });
  return !named && wanted == std::to_string(index + 1);
}

/// What was not taken of a key-line's points, in words.
void tell_dropped(const KeyLine& line, std::vector<std::string>& skipped) {
  const std::string of = line.id.empty() ? "" : line.id + ": ";
  const auto tell = [&](std::size_t count, const char* what) {
    if (count > 0) skipped.push_back(of + core::counted(count, "point") + what);
  };
  tell(line.report.non_finite, " without all coordinates");
  tell(line.report.outliers, " astray");
  tell(line.report.apart, " apart from the rest");
  tell(line.report.averaged, " replaced by means");
}

/// `told` gets the unit and what of the file was not taken.
Result<std::vector<KeyLine>> acquire_all(const InputRequest& input, const std::string& file,
                                         ReadAnswer& told) {
  const auto read = in_file(read_raw(input, file), file);
  if (!read) return std::unexpected(read.error());
  const std::vector<RawCurve>& raw = read->curves;
  told.unit = read->unit;
  if (!raw.empty()) told.skipped = raw.front().left_out;
  std::vector<KeyLine> lines;
  for (std::size_t i = 0; i < raw.size(); ++i) {
    const RawCurve& curve = raw[i];
    if (!is_wanted(raw, i, input.select)) continue;
    auto line = in_file(acquire::acquire_key_line(curve, acquire_options(input.acquiring)),
                        raw.size() > 1 ? file + ": " + curve.id : file);
    if (!line) return std::unexpected(line.error());
    line->id = curve.id;
    tell_dropped(*line, told.skipped);
    lines.push_back(std::move(*line));
  }
  if (lines.empty()) {
    std::vector<std::string> names;
    for (const RawCurve& curve : raw) names.push_back(curve.id);
    return in_file<std::vector<KeyLine>>(
        std::unexpected(document::nothing_named(input.select, names)), file);
  }
  return lines;
}

Result<std::vector<KeyLine>> join_files(const InputRequest& input, std::string& unit) {
  std::vector<RawCurve> parts;
  for (const std::string& file : input.file) {
    auto raw = in_file(read_raw(input, file), file);
    if (!raw) return std::unexpected(raw.error());
    if (!unit.empty() && !raw->unit.empty() && raw->unit != unit)
      return fail(ErrorCode::bad_input, "is in " + raw->unit + ", a file before it in " + unit,
                  "convert one of them", file);
    if (unit.empty()) unit = raw->unit;
    for (RawCurve& curve : raw->curves) parts.push_back(std::move(curve));
  }
  auto line = acquire::acquire_joined(parts, acquire_options(input.acquiring));
  if (!line) return std::unexpected(line.error());
  return std::vector<KeyLine>{std::move(*line)};
}

NamedCurve named(KeyLine line) {
  NamedCurve curve;
  curve.name = line.id;
  curve.line = std::move(line);
  return curve;
}

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
  std::vector<std::string> names;
  for (const KeyLine& line : *lines) names.push_back(line.id);
  for (std::size_t i = 0; i < lines->size(); ++i)
    if (is_wanted(*lines, i, input.select)) answer.curves.push_back(named((*lines)[i]));
  if (answer.curves.empty())
    return in_file<ReadAnswer>(std::unexpected(document::nothing_named(input.select, names)), file);
  if (skipped > 0)
    answer.curves.front().line->report.notes.push_back(
        std::to_string(skipped) + " short strokes of the drawing were left out");
  return answer;
}

/// The lines in which a plane cuts a mesh; of a cloud, its section as acquired.
Result<document::Document> section_document(const InputRequest& input, const std::string& file) {
  const auto cut = cut_file(input, file);
  if (!cut) return std::unexpected(cut.error());
  document::Document document;
  for (std::size_t i = 0; i < cut->curves.size(); ++i) {
    const RawCurve& curve = cut->curves[i];
    curve::Polyline2 line;
    bool closed = cut->closed[i];
    if (cut->ordered) {
      for (const core::Point3 p : curve.points) line.points.push_back({p.x, p.y});
    } else {
      const auto acquired = acquire::acquire_key_line(curve, acquire_options(input.acquiring));
      if (!acquired) return std::unexpected(acquired.error());
      line.points = acquired->points;
      closed = acquired->closed;
    }
    if (closed) line.points.push_back(line.points.front());
    document.paths.push_back({{curve.id, {}, {}}, {{{std::move(line)}}, closed}, 0});
  }
  return document;
}

template <class Thing>
NamedCurve named(const document::Label& label, const Thing& curve, double width) {
  return {label.name, label.layer, label.color, width, AnyCurve{curve}, {}};
}

ReadAnswer answer_of(document::Document document) {
  ReadAnswer answer;
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
  auto document = exchange::is_mesh_file(file) && !input.section.empty()
                      ? section_document(input, file)
                      : exchange::read_document(
                            file, {.glyphs = input.glyphs, .cancellation = progress.cancellation});
  if (!document) return std::unexpected(document.error());
  if (auto done = in_file(document::select(*document, input.select), file); !done)
    return std::unexpected(done.error());
  if (!input.unit.empty()) document->unit = input.unit;
  if (input.trims) document::add_trim_curves(*document);
  if (!input.planar) return answer_of(std::move(*document));
  const std::size_t plane_already = document->paths.size();
  const auto planes = exchange::flatten(*document);
  if (document->paths.empty() && document->surfaces.empty())
    return fail(ErrorCode::bad_input, "there is no planar curve in it",
                "give curves that lie in a plane", file);
  ReadAnswer answer = answer_of(std::move(*document));
  for (std::size_t i = 0; i < planes.size(); ++i) {
    NamedCurve& curve = answer.curves[plane_already + i];
    place(curve, planes[i]);
    const std::string& name = curve.name;
    answer.notes.push_back((name.empty() ? fmt::format("curve {}", plane_already + i + 1) : name) +
                           ": " + exchange::in_words(planes[i].plane));
  }
  return answer;
}

bool holds_points(const std::string& file) {
  return exchange::format_of(file, exchange::head_of(file).value_or("")) ==
         exchange::Format::points;
}

Result<ReadAnswer> read_files(const InputRequest& request, const core::Progress& progress) {
  const std::string& file = request.file.front();
  const bool points = !exchange::has_image_name(file) && holds_points(file);
  if (!points && request.file.size() > 1)
    return fail(ErrorCode::bad_input, "several files are parts of one key-line of points",
                "give one file of curves, or one drawing, at a time", "file");
  if (exchange::has_image_name(file)) return read_drawing(request, progress);
  if (!points) return read_curves(request, progress);
  ReadAnswer answer;
  auto lines = request.file.size() > 1 ? join_files(request, answer.unit)
                                       : acquire_all(request, file, answer);
  if (!lines) return std::unexpected(lines.error());
  if (!request.unit.empty()) answer.unit = request.unit;
  for (KeyLine& line : *lines) answer.curves.push_back(named(std::move(line)));
  return answer;
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
  if (read && progress.stop_requested())
    return fail(ErrorCode::cancelled, "cancelled", {}, request.file.front());
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
