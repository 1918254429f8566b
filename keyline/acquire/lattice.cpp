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

}  // namespace

core::Result<RawCurve> lattice_row(const Lattice& lattice, std::size_t row) {
  return line_of(lattice, "row", row, lattice.rows, lattice.columns, row * lattice.columns, 1);
}

core::Result<RawCurve> lattice_column(const Lattice& lattice, std::size_t column) {
  return line_of(lattice, "column", column, lattice.columns, lattice.rows, column, lattice.columns);
}

}  // namespace keyline::acquire
