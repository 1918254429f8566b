#include "keyline/analysis/line_turnings.h"

#include <algorithm>
#include <cmath>

namespace keyline::analysis::detail {
namespace {

constexpr double kLeastBase = 1e-7;  // of 1 - alpha lambda x, before a cusp or an inflection

/// log(1 + z) / z, for z > -1.
double log_ratio(double z) { return std::abs(z) < 1e-8 ? 1 - z / 2 : std::log1p(z) / z; }
/// (e^w - 1) / w.
double exp_ratio(double w) { return std::abs(w) < 1e-8 ? 1 + w / 2 : std::expm1(w) / w; }

double slope_at(const LineModel& m, double s) { return s < m.anchor ? m.slope0 : m.slope1; }

/// `known`: of another model; what the two share is taken from it.
Shape shape_of(const LineModel& m, int cells, const Shape* known) {
  Shape shape{m, std::vector<double>(cells + 1), std::vector<double>(cells + 1)};
  const bool near = known && known->model.rate == m.rate && known->model.anchor == m.anchor;
  for (int i = 0; i <= cells; ++i) {
    const double s = static_cast<double>(i) / cells;
    const double alpha = slope_at(m, s);
    if (near && slope_at(known->model, s) == alpha) {
      shape.stretched[i] = known->stretched[i];
      shape.ratio[i] = known->ratio[i];
      continue;
    }
    const double x = s - m.anchor;
    shape.stretched[i] = x * log_ratio(-alpha * m.rate * x);
    shape.ratio[i] = exp_ratio((1 - alpha) * m.rate * shape.stretched[i]);
  }
  return shape;
}

Eigen::VectorXd turning_of(const Shape& shape) {
  const auto from_anchor = [&](int i) {
    return shape.model.curvature * shape.stretched[i] * shape.ratio[i];
  };
  const int cells = static_cast<int>(shape.ratio.size()) - 1;
  Eigen::VectorXd turning(cells);
  double before = from_anchor(0);
  for (int i = 0; i < cells; ++i) {
    const double now = from_anchor(i + 1);
    turning[i] = now - before;
    before = now;
  }
  return turning;
}

}  // namespace

/// Rates with which the whole piece exists.
core::Interval drawable_rates(const LineModel& m) {
  core::Interval all{-HUGE_VAL, HUGE_VAL};
  for (const double most : {-m.slope0 * m.anchor, m.slope1 * (1 - m.anchor)}) {
    // 1 - most * rate must stay above kLeastBase
    if (most > 0) all.high = std::min(all.high, (1 - kLeastBase) / most);
    if (most < 0) all.low = std::max(all.low, (1 - kLeastBase) / most);
  }
  return all;
}

double drawable_rate(const LineModel& m) {
  const core::Interval all = drawable_rates(m);
  double rate = m.rate;
  if (rate > all.high) rate = 2 * all.high - rate;
  if (rate < all.low) rate = 2 * all.low - rate;
  return std::clamp(rate, all.low, all.high);
}

double curvature_at(const LineModel& m, double s) {
  const double x = s - m.anchor;
  const double stretched = x * log_ratio(-slope_at(m, s) * m.rate * x);
  return m.curvature * std::exp(m.rate * stretched);
}

Eigen::VectorXd turning_of(const LineModel& m, int cells) {
  return turning_of(shape_of(m, cells, nullptr));
}

Eigen::VectorXd Lines::at(const Eigen::VectorXd& x, int cells) {
  last_ = shape_of(model_(x), cells, nullptr);
  return turning_of(last_);
}

Eigen::VectorXd Lines::beside(const Eigen::VectorXd& x, int cells) const {
  return turning_of(shape_of(model_(x), cells, &last_));
}

}  // namespace keyline::analysis::detail
