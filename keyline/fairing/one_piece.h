#pragma once

#include <optional>
#include <vector>

#include "keyline/fairing/chain_fit.h"
#include "keyline/lac/segment/segment.h"

/// One log-aesthetic piece through points.
namespace keyline::fairing::detail {

struct OnePiece {
  lac::Segment segment;
  std::vector<double> feet;  ///< of the points, fractions of the length
  double off = 0;            ///< largest distance of a point
};

/// The piece nearest to the points by least squares, from the first of them to the last: the point
/// by point distance across it, at the ends the whole. Starts at the poses of the first and last
/// points, a pose from those within a tenth of the length. Slopes to ±kSteepestSlope.
/// Precondition: at least 3 points, no two neighbours alike.
OnePiece fit_one_piece(const std::vector<FitPoint>& points);

}  // namespace keyline::fairing::detail
