#pragma once

#include <vector>

#include "keyline/core/error.h"
#include "keyline/curve/bezier.h"
#include "keyline/surface/bezier_surface.h"

namespace keyline::surface {

struct NetworkPatch {
  BezierSurface surface;
  std::vector<double> moved;  ///< how far each row was moved to stand on the column
};

/// The patch whose net has the given curves for rows (A1 … A4 of [Oya] 3.4) and one more for its
/// first column (A5): a profile swept along A5 while it changes from A1 to A4. Row i is moved so
/// that it starts at control point i of the column; the other columns (A6 … A8) follow.
///
/// Fails: bad_input unless there are as many rows as the column has control points, all rows have
/// one degree, all degrees lie in 1 … 30 and all numbers are finite; unsupported for weights. The
/// path is "rows" or "rows[i]" or "column".
core::Result<NetworkPatch> patch_from_network(const std::vector<curve::Bezier3>& rows,
                                              const curve::Bezier3& column);

}  // namespace keyline::surface
