#pragma once

#include <span>
#include <vector>

#include "keyline/fairing/dense_curve.h"

/// How far a curve comes to lie elsewhere where its curvature is another.
namespace keyline::fairing::detail {

/// A cell's mean curvature (times the curve's length) and its share of the length.
struct CellMean {
  double curvature = 0;
  double width = 0;
};

/// Of the cells from node `first` to node `last`; of a closed curve perhaps on other laps.
std::vector<CellMean> means_of(const DenseCurve& curve, int first, int last);

/// How far a curve departs sideways, from the middle of what it does about its chord, where these
/// cells have one curvature: the difference integrated twice, in shares of the length.
double sideways(std::span<const CellMean> cells, double curvature);

}  // namespace keyline::fairing::detail
