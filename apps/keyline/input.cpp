#include "input.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>

#include "keyline/acquire/acquire.h"
#include "keyline/acquire/join.h"
#include "keyline/acquire/lattice.h"
#include "keyline/acquire/section.h"
#include "keyline/acquire/section_curves.h"
#include "keyline/acquire/symmetry.h"
#include "keyline/exchange/document_file.h"
#include "keyline/exchange/image_reader.h"
#include "keyline/exchange/lattice_reader.h"
#include "keyline/exchange/mesh.h"
#include "keyline/exchange/planar_form.h"
#include "keyline/exchange/points_reader.h"
#include "keyline/exchange/section_file.h"
#include "keyline/operations/fair_request.h"
#include "keyline/operations/sketch_run.h"

namespace keyline::app {
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

acquire::AcquireOptions acquire_options(const InputOptions& input) {
  acquire::AcquireOptions options;
  if (input.closed) options.closed = true;
  if (input.open) options.closed = false;
  if (input.keep_order) options.ordered = true;
  options.remove_outliers = !input.keep_strays;
  options.noise = input.noise;
  return options;
}

Result<std::vector<RawCurve>> read_lattice_input(const InputOptions& input,
                                                 const std::string& file) {
  const auto lattice = exchange::read_lattice(file);
  if (!lattice) return std::unexpected(lattice.error());
  const long index = input.row ? *input.row : *input.column;
  if (index < 0)
    return fail(ErrorCode::bad_input, "rows and columns count from 0", "give 0 or more");
  const auto curve = input.row ? acquire::lattice_row(*lattice, static_cast<std::size_t>(index))
                               : acquire::lattice_column(*lattice, static_cast<std::size_t>(index));
  if (!curve) return std::unexpected(curve.error());
  return std::vector<RawCurve>{*curve};
}

/// Clouds whose columns are told: read whole, then cut.
Result<std::vector<RawCurve>> cut_table(const InputOptions& input,
                                        const std::vector<RawCurve>& clouds) {
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
    const double band = size > 0 && std::isfinite(size) ? size / 150 : 1;
    auto curve = acquire::section_plane(cloud, plane, input.band.value_or(band));
    if (!curve) return std::unexpected(curve.error());
    for (RawCurve& part : acquire::section_curves(*curve, plane)) cuts.push_back(std::move(part));
  }
  return cuts;
}

Result<exchange::FileSection> cut_file(const InputOptions& input, const std::string& file) {
  const auto request = exchange::parse_section(input.section);
  if (!request) return std::unexpected(request.error());
  return exchange::section_of_file(file, *request, input.band);
}

Result<std::vector<RawCurve>> read_raw(const InputOptions& input, const std::string& file) {
  if (input.row || input.column) return read_lattice_input(input, file);
  const bool told = !input.columns.empty() || !input.weights.empty() || !input.id.empty();
  if (!input.section.empty() && !told && file != "-") {
    auto cut = cut_file(input, file);
    if (!cut) return std::unexpected(cut.error());
    return std::move(cut->curves);
  }
  exchange::PointsOptions options;
  options.columns = input.columns;
  options.weight_column = input.weights;
  options.id_column = input.id;
  auto raw = file == "-" ? exchange::read_points(std::cin, "standard input", options)
                         : exchange::read_points(std::filesystem::path(file), options);
  if (!raw) return raw;
  if (input.section.empty()) return raw;
  return cut_table(input, *raw);
}

/// Of those of the name wanted; where there are none, that of the number, counted from 1.
bool is_wanted(const std::vector<RawCurve>& curves, std::size_t index, const std::string& wanted) {
  if (wanted.empty() || curves[index].id == wanted) return true;
  const bool named = std::any_of(curves.begin(), curves.end(),
                                 [&](const RawCurve& curve) { return curve.id == wanted; });
  return !named && wanted == std::to_string(index + 1);
}

Result<std::vector<KeyLine>> acquire_all(const InputOptions& input, const std::string& file) {
  const auto raw = in_file(read_raw(input, file), file);
  if (!raw) return std::unexpected(raw.error());
  std::vector<KeyLine> lines;
  for (std::size_t i = 0; i < raw->size(); ++i) {
    const RawCurve& curve = (*raw)[i];
    if (!is_wanted(*raw, i, input.select)) continue;
    auto line = in_file(acquire::acquire_key_line(curve, acquire_options(input)),
                        raw->size() > 1 ? file + ": " + curve.id : file);
    if (!line) return std::unexpected(line.error());
    line->id = curve.id;
    lines.push_back(std::move(*line));
  }
  if (lines.empty())
    return fail(ErrorCode::bad_input, "no curve is named \"" + input.select + "\"",
                "leave --select out to take all", file);
  return lines;
}

Result<std::vector<KeyLine>> join_files(const InputOptions& input) {
  std::vector<RawCurve> parts;
  for (const std::string& file : input.files) {
    auto raw = in_file(read_raw(input, file), file);
    if (!raw) return std::unexpected(raw.error());
    for (RawCurve& curve : *raw) parts.push_back(std::move(curve));
  }
  auto line = acquire::acquire_joined(parts, acquire_options(input));
  if (!line) return std::unexpected(line.error());
  return std::vector<KeyLine>{std::move(*line)};
}

/// The longer strokes of a drawing, in pixels, and the drawing's page.
Result<std::vector<KeyLine>> trace_key_lines(const InputOptions& input,
                                             std::optional<curve::Box2>* page) {
  const std::string& file = input.files.front();
  if (input.files.size() > 1)
    return fail(ErrorCode::bad_input, "one drawing at a time", "give one INPUT");
  auto image = exchange::read_image_file(file);
  if (!image) return std::unexpected(image.error());
  const auto trace = operations::trace_picture(std::move(*image), {});
  if (!trace) return in_file(Result<std::vector<KeyLine>>(std::unexpected(trace.error())), file);
  if (page) *page = curve::Box2{{0, 0}, {static_cast<double>(trace->width), 1.0 * trace->height}};
  std::size_t skipped = 0;
  auto lines = in_file(operations::key_lines_of(*trace, skipped), file);
  if (!lines) return lines;
  if (!input.select.empty())
    std::erase_if(*lines, [&](const KeyLine& line) { return line.id != input.select; });
  if (lines->empty())
    return fail(ErrorCode::bad_input, "holds no line long enough to fair", "check --select", file);
  if (skipped > 0)
    lines->front().report.notes.push_back(std::to_string(skipped) +
                                          " short strokes of the drawing were left out");
  return lines;
}

/// The lines in which a plane cuts a mesh; of a cloud, its section as acquired.
Result<document::Document> section_document(const InputOptions& input, const std::string& file) {
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
      const auto acquired = acquire::acquire_key_line(curve, acquire_options(input));
      if (!acquired) return std::unexpected(acquired.error());
      line.points = acquired->points;
      closed = acquired->closed;
    }
    if (closed) line.points.push_back(line.points.front());
    document.paths.push_back({{curve.id, {}, {}}, {{{std::move(line)}}, closed}, 0});
  }
  return document;
}

}  // namespace

const curve::Polyline2* only_polyline(const document::Path& path) {
  return path.curves.size() == 1 ? std::get_if<curve::Polyline2>(&path.curves.front().value)
                                 : nullptr;
}

Result<KeyLine> key_line_of(const document::Path& path, const InputOptions& input) {
  const auto* polyline = only_polyline(path);
  if (!polyline) return operations::key_line_of(path);
  RawCurve raw;
  for (const core::Point2 p : polyline->points) raw.points.push_back({p.x, p.y, 0});
  acquire::AcquireOptions options = acquire_options(input);
  options.ordered = true;
  if (path.closed) options.closed = true;
  return acquire::acquire_key_line(raw, options);
}

bool holds_points(const std::string& file) {
  if (exchange::is_mesh_file(file)) return false;
  return file == "-" || exchange::format_of(file, exchange::head_of(file).value_or("")) ==
                            exchange::Format::points;
}

Result<document::Document> load_document(const InputOptions& input) {
  const std::string& file = input.files.front();
  if (input.files.size() > 1)
    return fail(ErrorCode::bad_input, "one file of curves at a time", "give one INPUT");
  auto document = exchange::is_mesh_file(file) && !input.section.empty()
                      ? section_document(input, file)
                      : exchange::read_document(file, {.glyphs = input.glyphs});
  if (!document) return document;
  if (auto done = document::select(*document, input.select); !done)
    return in_file(Result<document::Document>(std::unexpected(done.error())), file);
  if (!input.unit.empty()) document->unit = input.unit;
  return document;
}

Result<document::Document> load_planar(const InputOptions& input) {
  auto document = load_document(input);
  if (!document) return document;
  std::vector<std::string> notes;
  exchange::flatten(*document, notes);
  if (document->paths.empty())
    return fail(ErrorCode::bad_input, "there is no planar curve in it",
                "give curves that lie in a plane", input.files.front());
  return document;
}

Result<std::vector<KeyLine>> load_key_lines(const InputOptions& input,
                                            std::optional<curve::Box2>* page) {
  if (exchange::has_image_name(input.files.front())) return trace_key_lines(input, page);
  if (holds_points(input.files.front())) {
    if (input.files.size() > 1) return join_files(input);
    return acquire_all(input, input.files.front());
  }
  auto document = load_planar(input);
  if (!document) return std::unexpected(document.error());
  std::vector<KeyLine> lines;
  for (const auto& named : document->paths) {
    auto line = in_file(key_line_of(named.path, input), input.files.front());
    if (!line) return std::unexpected(line.error());
    line->id = named.label.name;
    if (!document->skipped.empty())
      line->report.notes.push_back(std::to_string(document->skipped.size()) +
                                   " things in the file were skipped");
    lines.push_back(std::move(*line));
  }
  return lines;
}

}  // namespace keyline::app
