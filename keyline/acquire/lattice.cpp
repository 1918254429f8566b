#include "keyline/acquire/lattice.h"

#include <utility>

namespace keyline::acquire {
namespace {

core::Result<RawCurve> line_of(const Lattice& lattice, const char* what, std::size_t index,
                               std::size_t lines, std::size_t length, std::size_t start,
                               std::size_t step) {
  if (lattice.points.size() != lattice.rows * lattice.columns) {
    return core::fail(core::ErrorCode::bad_input, "the lattice is not complete",
                      "give rows times columns points", "points");
  }
  if (index >= lines) {
    return core::fail(core::ErrorCode::bad_input,
                      "there is no " + std::string(what) + " " + std::to_string(index),
                      "the last one is " + std::to_string(lines == 0 ? 0 : lines - 1), what);
  }
  RawCurve curve;
  curve.id = std::string(what) + " " + std::to_string(index);
  curve.has_z = true;
  for (std::size_t k = 0; k < length; ++k) curve.points.push_back(lattice.points[start + k * step]);
  return curve;
}

double coordinate(core::Point3 p, Axis axis) {
  return axis == Axis::x ? p.x : axis == Axis::y ? p.y : p.z;
}

/// First crossing of a line of the lattice with the plane, if any.
bool crossing(const RawCurve& line, Axis axis, double position, core::Point3& out) {
  for (std::size_t k = 1; k < line.points.size(); ++k) {
    const double a = coordinate(line.points[k - 1], axis) - position;
    const double b = coordinate(line.points[k], axis) - position;
    // Half-open, so that a point in the plane counts once; NaN never crosses.
    if (!((a <= 0 && b > 0) || (a >= 0 && b < 0))) continue;
    out = core::mix(line.points[k - 1], line.points[k], a / (a - b));
    (axis == Axis::x ? out.x : axis == Axis::y ? out.y : out.z) = position;
    return true;
  }
  return false;
}

}  // namespace

core::Result<RawCurve> lattice_row(const Lattice& lattice, std::size_t row) {
  return line_of(lattice, "row", row, lattice.rows, lattice.columns, row * lattice.columns, 1);
}

core::Result<RawCurve> lattice_column(const Lattice& lattice, std::size_t column) {
  return line_of(lattice, "column", column, lattice.columns, lattice.rows, column, lattice.columns);
}

core::Result<RawCurve> lattice_section(const Lattice& lattice, Axis axis, double position) {
  RawCurve across_rows, across_columns;
  core::Point3 p;
  for (std::size_t i = 0; i < lattice.rows; ++i) {
    const auto line = lattice_row(lattice, i);
    if (!line) return line;
    if (crossing(*line, axis, position, p)) across_rows.points.push_back(p);
  }
  for (std::size_t j = 0; j < lattice.columns; ++j) {
    const auto line = lattice_column(lattice, j);
    if (!line) return line;
    if (crossing(*line, axis, position, p)) across_columns.points.push_back(p);
  }
  const bool rows = across_rows.points.size() >= across_columns.points.size();
  RawCurve& best = rows ? across_rows : across_columns;
  if (best.points.size() < 3) {
    return core::fail(
        core::ErrorCode::bad_input,
        "the plane cuts the lattice in " + std::to_string(best.points.size()) + " places",
        "move the plane", "section");
  }
  best.has_z = true;
  best.notes.push_back("section through " + std::to_string(best.points.size()) +
                       (rows ? " rows" : " columns") + " of the lattice");
  return std::move(best);
}

}  // namespace keyline::acquire
