#include "keyline/operations/document_points.h"

#include <cmath>

#include <fmt/format.h>

#include "keyline/acquire/join.h"
#include "keyline/acquire/lattice.h"
#include "keyline/acquire/order.h"
#include "keyline/acquire/section.h"
#include "keyline/acquire/section_curves.h"
#include "keyline/acquire/symmetry.h"
#include "keyline/core/extent.h"
#include "keyline/core/text.h"
#include "keyline/exchange/cad/planar_form.h"
#include "keyline/exchange/file/read_file.h"
#include "keyline/exchange/points/lattice_reader.h"
#include "keyline/exchange/points/points_reader.h"
#include "keyline/operations/common_unit.h"

namespace keyline::operations {

using acquire::KeyLine;
using acquire::RawCurve;
using core::ErrorCode;
using core::fail;
using core::Result;

Result<exchange::FileSection> cut_file(const InputRequest& input, const std::string& file) {
  const auto request = exchange::parse_section(input.section);
  if (!request) return std::unexpected(request.error());
  return exchange::section_of_file(file, *request, input.band);
}

NamedCurve named_line(KeyLine line) {
  NamedCurve curve;
  curve.name = line.id;
  curve.plane = placement_of(line.plane);
  curve.line = std::move(line);
  return curve;
}

namespace {

Result<exchange::PointsFile> read_lattice_input(const InputRequest& input,
                                                const std::string& file) {
  exchange::PointsOptions options;
  options.columns = input.columns;
  auto read = exchange::read_lattice(file, options);
  if (!read) return std::unexpected(read.error());
  const auto index = static_cast<std::size_t>(input.row ? *input.row : *input.column);
  auto curve = input.row ? acquire::lattice_row(read->lattice, index)
                         : acquire::lattice_column(read->lattice, index);
  if (!curve) return std::unexpected(curve.error());
  curve->left_out = std::move(read->left_out);
  return exchange::PointsFile{{std::move(*curve)}, std::move(read->unit)};
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

Result<exchange::PointsFile> read_raw(const InputRequest& input, const std::string& file) {
  if (input.row || input.column) return read_lattice_input(input, file);
  const bool told =
      !input.columns.empty() || !input.weight_column.empty() || !input.id_column.empty();
  if (!input.section.empty() && !told) {
    auto cut = cut_file(input, file);
    if (!cut) return std::unexpected(cut.error());
    return exchange::PointsFile{std::move(cut->curves), std::move(cut->unit)};
  }
  exchange::PointsOptions options;
  options.columns = input.columns;
  options.weight_column = input.weight_column;
  options.id_column = input.id_column;
  options.blank_lines_part = input.section.empty();
  auto raw = exchange::read_points_file(file, options);
  if (!raw || input.section.empty()) return raw;
  auto cuts = cut_table(input, raw->curves);
  if (!cuts) return std::unexpected(cuts.error());
  raw->curves = std::move(*cuts);
  return raw;
}

/// Whether measured points have a plane worth the name.
bool has_plane(const KeyLine& line) {
  return line.report.plane_departure <= exchange::kMostOfMeasured * core::reach(line.points);
}

/// Points of three coordinates that leave z = 0.
bool is_in_space(const KeyLine& line) {
  return placement_of(line.plane) || line.report.plane_departure > 0;
}

/// The points where they were measured: in the order found, cleaned; as they are in the file where
/// they lie in no plane.
document::NamedSpaceCurve in_space(const KeyLine& line, const RawCurve& raw) {
  curve::Polyline3 polyline;
  if (has_plane(line)) {
    for (std::size_t i = 0; i < line.points.size(); ++i)
      polyline.points.push_back(line.sources.empty()
                                    ? acquire::from_plane(line.plane, line.points[i])
                                    : raw.points[line.sources[i]]);
    if (line.closed) polyline.points.push_back(polyline.points.front());
  } else {
    for (const core::Point3 p : raw.points)
      if (core::is_finite(p)) polyline.points.push_back(p);
  }
  return {{line.id, {}, {}}, {std::move(polyline)}};
}

/// What was not taken of a key-line's points, in words.
void tell_dropped(const KeyLine& line, std::vector<std::string>& skipped) {
  const std::string of = line.id.empty() ? "" : line.id + ": ";
  const auto tell = [&](std::size_t count, const char* what) {
    if (count > 0) skipped.push_back(of + core::counted(count, "point") + what);
  };
  tell(line.report.non_finite, " without all coordinates");
  if (!has_plane(line)) return;  // the points are those of the file
  tell(line.report.duplicates, " where a neighbour is");
  tell(line.report.outliers, " astray");
  tell(line.report.apart, " apart from the rest");
  tell(line.report.averaged, " replaced by means");
}

/// Puts a key-line among what was read: told in its plane, or where it lies in space.
/// Fails: bad_input where it has to lie in a plane and does not.
Result<void> add_line(ReadAnswer& answer, KeyLine line, const RawCurve& raw, bool planar) {
  tell_dropped(line, answer.skipped);
  const std::string name =
      line.id.empty() ? fmt::format("curve {}", answer.curves.size() + 1) : line.id;
  if (line.report.reordered && has_plane(line))
    answer.notes.push_back(name + ": the points in another order than the file's");
  if (!is_in_space(line)) {
    answer.curves.push_back(named_line(std::move(line)));
    return {};
  }
  if (planar) {
    if (!has_plane(line))
      return fail(ErrorCode::bad_input,
                  fmt::format("the points lie in no plane: they leave the nearest by {}",
                              core::number_text(line.report.plane_departure, 3)),
                  "choose two coordinates, as with --columns x,y");
    if (placement_of(line.plane))
      answer.notes.push_back(name + ": " + exchange::in_words(line.plane));
    answer.curves.push_back(named_line(std::move(line)));
    return {};
  }
  document::NamedSpaceCurve curve = in_space(line, raw);
  if (!has_plane(line) &&
      !acquire::is_ordered(std::get<curve::Polyline3>(curve.curve.value).points))
    answer.notes.push_back(name +
                           ": points joined in the order of the file, which follows no "
                           "curve; of a cloud --section takes curves");
  answer.curves.push_back({line.id, {}, {}, 0, AnyCurve{curve.curve}, {}});
  answer.document.space_curves.push_back(std::move(curve));
  return {};
}

Result<ReadAnswer> read_points_of(const InputRequest& input,
                                  const core::CancellationToken& cancellation,
                                  const std::string& file) {
  const auto read = in_file(read_raw(input, file), file);
  if (!read) return std::unexpected(read.error());
  const std::vector<RawCurve>& raw = read->curves;
  ReadAnswer answer;
  answer.unit = read->unit;
  if (!raw.empty()) answer.skipped = raw.front().left_out;
  take_unit(answer.unit, input.unit, answer.skipped);
  const auto wanted = in_file(wanted_of(raw, input.select), file);
  if (!wanted) return std::unexpected(wanted.error());
  for (std::size_t i = 0; i < raw.size(); ++i) {
    const RawCurve& curve = raw[i];
    if (!(*wanted)[i]) continue;
    const std::string which = curve.id.empty() ? fmt::format("curve {}", i + 1) : curve.id;
    const std::string place = raw.size() > 1 ? file + ": " + which : file;
    auto line = in_file(
        acquire::acquire_key_line(curve, acquire_options(input.acquiring, cancellation)), place);
    if (!line) return std::unexpected(line.error());
    line->id = curve.id;
    if (auto added = in_file(add_line(answer, std::move(*line), curve, input.planar), place);
        !added)
      return std::unexpected(added.error());
  }
  return answer;
}

Result<ReadAnswer> join_files(const InputRequest& input,
                              const core::CancellationToken& cancellation) {
  std::vector<RawCurve> parts;
  ReadAnswer answer;
  CommonUnit unit;
  for (const std::string& file : input.file) {
    auto raw = in_file(read_raw(input, file), file);
    if (!raw) return std::unexpected(raw.error());
    if (auto same = unit.take(raw->unit, file); !same) return std::unexpected(same.error());
    for (RawCurve& curve : raw->curves) parts.push_back(std::move(curve));
  }
  answer.unit = unit.name();
  take_unit(answer.unit, input.unit, answer.skipped);
  auto line = acquire::acquire_joined(parts, acquire_options(input.acquiring, cancellation));
  if (!line) return std::unexpected(line.error());
  if (!has_plane(*line))
    return fail(ErrorCode::bad_input, "the parts lie in no plane",
                "choose two coordinates, as with --columns x,y", input.file.front());
  if (auto added = add_line(answer, std::move(*line), {}, input.planar); !added)
    return std::unexpected(added.error());
  return answer;
}

}  // namespace

Result<ReadAnswer> read_points_input(const InputRequest& input,
                                     const core::CancellationToken& cancellation) {
  const bool alone = input.file.size() == 1;
  auto read = alone ? read_points_of(input, cancellation, input.file.front())
                    : join_files(input, cancellation);
  if (!read) return read;
  read->kind = alone ? InputRequest::kAlone : 0U;
  if (input.row || input.column)
    read->kind |= input.row ? InputRequest::kLatticeRow : InputRequest::kLatticeColumn;
  else
    read->kind |= InputRequest::kTable | (input.section.empty() ? 0U : InputRequest::kCloud);
  return read;
}

}  // namespace keyline::operations
