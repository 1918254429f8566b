#include "keyline/analysis/arcs_fit.h"

#include <algorithm>

#include <Eigen/Core>

#include "keyline/analysis/frame_fit.h"

namespace keyline::analysis::detail {
namespace {

/// Ends of the n parts of the cells that leave the least sum of squares about the parts' means.
std::vector<int> best_parts(const Eigen::VectorXd& v, int n) {
  const int cells = static_cast<int>(v.size());
  std::vector<double> sum(cells + 1, 0), square(cells + 1, 0);
  for (int i = 0; i < cells; ++i) {
    sum[i + 1] = sum[i] + v[i];
    square[i + 1] = square[i] + v[i] * v[i];
  }
  const auto cost = [&](int a, int b) {
    const double s = sum[b] - sum[a];
    return square[b] - square[a] - s * s / (b - a);
  };
  std::vector<std::vector<double>> least(n, std::vector<double>(cells + 1, 1e300));
  std::vector<std::vector<int>> from(n, std::vector<int>(cells + 1, 0));
  for (int i = 1; i <= cells; ++i) least[0][i] = cost(0, i);
  for (int k = 1; k < n; ++k) {
    for (int i = k + 1; i <= cells; ++i) {
      for (int j = k; j < i; ++j) {
        const double c = least[k - 1][j] + cost(j, i);
        if (c < least[k][i]) {
          least[k][i] = c;
          from[k][i] = j;
        }
      }
    }
  }
  std::vector<int> ends(n, cells);
  for (int k = n - 1; k > 0; --k) ends[k - 1] = from[k][ends[k]];
  return ends;
}

/// x holds n curvatures and then n - 1 breaks.
Eigen::VectorXd turning_of_arcs(const Eigen::VectorXd& x, int cells) {
  const int n = (static_cast<int>(x.size()) + 1) / 2;
  const auto turned = [&](double s) {  // up to s
    double angle = 0;
    double from = 0;
    for (int k = 0; k < n; ++k) {
      const double to = k + 1 < n ? std::clamp(x[n + k], from, 1.0) : 1.0;
      angle += x[k] * (std::clamp(s, from, to) - from);
      from = to;
    }
    return angle;
  };
  Eigen::VectorXd turning(cells);
  for (int i = 0; i < cells; ++i)
    turning[i] = turned((i + 1.0) / cells) - turned(static_cast<double>(i) / cells);
  return turning;
}

struct Arcs {
  Eigen::VectorXd at(const Eigen::VectorXd& x, int cells) const {
    return turning_of_arcs(x, cells);
  }
  Eigen::VectorXd beside(const Eigen::VectorXd& x, int cells) const {
    return turning_of_arcs(x, cells);
  }
};

}  // namespace

ArcsFit fit_arcs(const PieceFrame& frame, int n) {
  if (is_straight(frame)) {
    ArcsFit fit;
    fit.deviation = straight_deviation(frame);
    fit.curvatures.assign(static_cast<std::size_t>(n), 0.0);
    for (int k = 1; k < n; ++k) fit.breaks.push_back(static_cast<double>(k) / n);
    return fit;
  }
  const std::vector<int> ends = best_parts(frame.turning(), n);
  Eigen::VectorXd x(2 * n - 1);
  for (int k = 0; k < n; ++k) {
    x[k] = frame.mean_curvature(k == 0 ? 0 : ends[k - 1], ends[k]);
    if (k + 1 < n) x[n + k] = static_cast<double>(ends[k]) / frame.cells();
  }
  ArcsFit fit;
  const Arcs build;
  fit.deviation = minimize(frame, build, {}, x, 100);
  fit.curvatures.assign(x.data(), x.data() + n);
  double from = 0;
  for (int k = 0; k + 1 < n; ++k) {
    from = std::clamp(x[n + k], from, 1.0);
    fit.breaks.push_back(from);
  }
  return fit;
}

}  // namespace keyline::analysis::detail
