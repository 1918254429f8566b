#pragma once

#include <Eigen/Core>

#include "keyline/analysis/frame_fit.h"
#include "keyline/analysis/line_turnings.h"
#include "keyline/analysis/piece_frame.h"

namespace keyline::analysis::detail {

/// Line models by their parameters: the logarithm of the curvature, the rate, and what has ranges.
struct LineModels {
  Lines::Model model;
  Bounds bounds;
};

/// Least squares from x; returns the distance.
double fit(const PieceFrame& frame, const LineModels& lines, Eigen::VectorXd& x, int iterations);

/// The rate is folded where the piece ends in a cusp or an inflection: the gradient jumps there,
/// and a minimum along the fold is not found by steps of all parameters. Where these have ended
/// beside it, the others are fitted along it. Returns the distance.
double settle_at_last_rate(const PieceFrame& frame, const LineModels& lines, double deviation,
                           Eigen::VectorXd& x);

}  // namespace keyline::analysis::detail
