#pragma once

#include <algorithm>

#include <Eigen/Core>

#include "keyline/analysis/piece_frame.h"
#include "keyline/numeric/levenberg_marquardt.h"

namespace keyline::analysis::detail {

/// Such a frame leaves a model nothing to tell: it has no curvature and any slope.
inline bool is_straight(const PieceFrame& frame) {
  return frame.turning().cwiseAbs().sum() < 1e-13;
}

/// The root mean square distance of a straight line.
inline double straight_deviation(const PieceFrame& frame) {
  return frame.displacement(Eigen::VectorXd::Zero(frame.cells())).norm();
}

/// Between which the parameters of a fit stay; empty: anywhere.
struct Bounds {
  Eigen::VectorXd low;
  Eigen::VectorXd high;
};

/// Least squares of the frame's displacement by build.at(x) with a numeric Jacobian; returns the
/// distance.
template <class Build>
double minimize(const PieceFrame& frame, Build& build, const Bounds& bounds, Eigen::VectorXd& x,
                int iterations) {
  Eigen::VectorXd known_at;  // a step that is taken is asked for again, with its derivatives
  Eigen::VectorXd known;
  const auto displaced = [&](const Eigen::VectorXd& at) -> const Eigen::VectorXd& {
    if (known_at.size() == at.size() && known_at == at) return known;
    known = frame.displacement(build.at(at, frame.cells()));
    known_at = at;
    return known;
  };
  const auto residuals = [&](const Eigen::VectorXd& at, Eigen::VectorXd& r, Eigen::MatrixXd* j) {
    r = displaced(at);
    if (!r.allFinite()) return false;
    if (!j) return true;
    j->resize(r.size(), at.size());
    for (int k = 0; k < at.size(); ++k) {
      double step = 1e-7 * std::max(1.0, std::abs(at[k]));
      if (bounds.high.size() > 0 && at[k] + step > bounds.high[k]) step = -step;
      Eigen::VectorXd beside = at;
      beside[k] += step;
      j->col(k) = (frame.displacement(build.beside(beside, frame.cells())) - r) / step;
    }
    return j->allFinite();
  };
  numeric::LevenbergMarquardtOptions options;
  options.max_iterations = iterations;
  options.low = bounds.low;
  options.high = bounds.high;
  numeric::minimize_least_squares(residuals, x, options);
  return displaced(x).norm();
}

}  // namespace keyline::analysis::detail
