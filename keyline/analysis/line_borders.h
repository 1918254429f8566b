#pragma once

#include <vector>

#include <Eigen/Core>

#include "keyline/analysis/line_turnings.h"
#include "keyline/analysis/piece_frame.h"
#include "keyline/core/interval.h"

namespace keyline::analysis::detail {

constexpr int kRate = 1;  // among the parameters of a fit

/// x folded back and forth into [low, high]: a bound that, unlike a clamp, never leaves the
/// minimiser without a gradient.
double folded(double x, double low, double high);

/// Where parameter `at` of a fit is folded into a range.
struct Fold {
  int at;
  core::Interval range;
};

/// At a fold the gradient jumps, and a minimum there is not found by steps of all parameters:
/// where these have ended next to borders, the others are fitted along them. Returns the distance.
double settle_at_borders(const PieceFrame& frame, const Lines::Model& model,
                         const std::vector<Fold>& folds, double deviation, Eigen::VectorXd& x);

}  // namespace keyline::analysis::detail
