#pragma once

#include <vector>

#include "keyline/fairing/dense_curve.h"
#include "keyline/fairing/dense_riccati.h"

/// Where a dense curve stands: what is missing between its cells, and beside its points.
namespace keyline::fairing::detail {

using Shapes = std::vector<CellShape>;

struct Gaps {
  std::vector<CellPlace> end;         ///< of every cell
  std::vector<Eigen::Vector3d> cell;  ///< end of the cell less the joint after it
  Vector6 seam = Vector6::Zero();     ///< end of the curve less where it is to be
  double sum = 0;
};
Gaps gaps_of(const DenseCurve& curve, const Shapes& shapes);

/// Where the points' feet are, and their offsets there.
struct Spots {
  std::vector<CellPlace> place;
  std::vector<double> offset;
};
Spots spots_of(const DenseCurve& curve, const Shapes& shapes, const std::vector<FitPoint>& points);
/// The offsets without the gaps between their places and those that the feet had before: a foot
/// that goes over a joint changes its offset by the gap there, however short the step.
std::vector<double> without_gaps(const Spots& spots, const std::vector<Foot>& before,
                                 const DenseCurve& curve, const Gaps& gaps,
                                 const std::vector<FitPoint>& points);
/// How far the end lies before or beyond the last point (or the start, the first), along it.
double along(const Spots& spots, const std::vector<FitPoint>& points, std::size_t j);

/// What the state before a cell moves a place in it by, in a direction.
Vector6 derivative(const DenseCurve& curve, const CellPlace& place, int cell,
                   core::Vector2 direction);
/// How a point's offset changes with the state before its foot's cell.
Vector6 by_offset(const DenseCurve& curve, const Spots& spots, const std::vector<FitPoint>& points,
                  std::size_t j);

}  // namespace keyline::fairing::detail
