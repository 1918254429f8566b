#pragma once

#include <vector>

#include "keyline/fairing/chain_fit.h"
#include "keyline/lac/segment/segment.h"

/// One log-aesthetic piece through points.
namespace keyline::fairing::detail {

struct OnePiece {
  FitChain chain;  ///< of the one piece, from the first point's foot to the last one's
  double off = 0;  ///< largest distance of a point
  lac::Segment segment() const;
};

/// The piece nearest to the points by least squares, from the first of them to the last: the
/// distance across it of each point, at the ends the whole. Starts at the poses of the first and
/// last points, a pose from those within a tenth of the length. Slopes to ±kSteepestSlope.
/// Precondition: at least 3 points, no two neighbours alike.
OnePiece fit_one_piece(const std::vector<FitPoint>& points);

}  // namespace keyline::fairing::detail
