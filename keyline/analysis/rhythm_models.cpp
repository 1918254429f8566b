#include "keyline/analysis/rhythm_models.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <Eigen/Core>

#include "keyline/analysis/frame_fit.h"
#include "keyline/analysis/line_fit.h"
#include "keyline/core/interval.h"
#include "keyline/numeric/solve.h"

namespace keyline::analysis::detail {
namespace {

constexpr core::Interval kAnchors{0.05, 0.95};

LineFit straight_line(const PieceFrame& frame, double slope0, double slope1) {
  const double none = std::numeric_limits<double>::infinity();
  return {{0, 0, 0.5, slope0, slope1}, straight_deviation(frame), none, none};
}

/// Standard deviations of x for residuals of standard deviation 1.
Eigen::VectorXd uncertainty(const PieceFrame& frame, Lines build, const Eigen::VectorXd& x) {
  const int cells = frame.cells();
  build.at(x, cells);
  Eigen::MatrixXd j(2 * (cells + 1), x.size());
  for (int k = 0; k < x.size(); ++k) {
    Eigen::VectorXd up = x;
    Eigen::VectorXd down = x;
    up[k] += 1e-5;
    down[k] -= 1e-5;
    j.col(k) = (frame.displacement(build.beside(up, cells)) -
                frame.displacement(build.beside(down, cells))) /
               2e-5;
  }
  const std::optional<Eigen::MatrixXd> inverse = numeric::inverse(j.transpose() * j);
  if (!inverse) {
    return Eigen::VectorXd::Constant(x.size(), std::numeric_limits<double>::infinity());
  }
  return inverse->diagonal().cwiseMax(0).cwiseSqrt();
}

/// One line through the mean curvature of both ends, with the right whole turning.
LineModel first_guess(const PieceFrame& frame, double slope) {
  const int cells = frame.cells();
  const int part = cells / 20;
  const double floor = 1e-3 * std::max(frame.mean_curvature(0, cells), 1e-12);
  const double start = std::max(frame.mean_curvature(0, part), floor);
  const double end = std::max(frame.mean_curvature(cells - part, cells), floor);
  const double q = std::log(end / start);
  LineModel m{1, q, 0.5, slope, slope};
  if (std::abs(slope) > 1e-6) m.rate = 2 / slope * std::tanh(slope * q / 2);
  m.rate = drawable_rate(m);
  m.curvature = frame.turning().sum() / turning_of(m, cells).sum();
  return m;
}

/// Of a curvature and a rate, which are free, and of what has ranges.
Bounds bounds_of(const std::vector<core::Interval>& ranges) {
  const auto count = static_cast<Eigen::Index>(ranges.size()) + 2;
  Bounds bounds{Eigen::VectorXd::Constant(count, -HUGE_VAL),
                Eigen::VectorXd::Constant(count, HUGE_VAL)};
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    bounds.low[static_cast<Eigen::Index>(i) + 2] = ranges[i].low;
    bounds.high[static_cast<Eigen::Index>(i) + 2] = ranges[i].high;
  }
  return bounds;
}

LineModel one_line(const Eigen::VectorXd& x, double low, double high) {
  const double slope = std::clamp(x[2], low, high);
  LineModel m{std::exp(x[0]), x[1], 0.5, slope, slope};
  m.rate = drawable_rate(m);
  return m;
}

LineModel two_lines(const Eigen::VectorXd& x, const SlopeBounds& b) {
  LineModel m{std::exp(x[0]), x[1], std::clamp(x[4], kAnchors.low, kAnchors.high),
              std::clamp(x[2], b.low0, b.high0), std::clamp(x[3], b.low1, b.high1)};
  m.rate = drawable_rate(m);
  return m;
}

}  // namespace

LineFit fit_one_line(const PieceFrame& frame, double low, double high, double seen) {
  if (is_straight(frame)) {
    LineFit fit = straight_line(frame, (low + high) / 2, (low + high) / 2);
    if (!(high > low)) fit.slope_error0 = fit.slope_error1 = 0;
    return fit;
  }
  const LineModels lines{[&](const Eigen::VectorXd& x) { return one_line(x, low, high); },
                         bounds_of({{low, high}})};
  const double width = high - low;
  const PieceFrame few = frame.coarse();
  double least = std::numeric_limits<double>::infinity();
  Eigen::VectorXd best_x;
  double last = std::numeric_limits<double>::quiet_NaN();
  for (double wish : {-3.0, -0.5, 0.5, 3.0}) {
    const double start = std::clamp(wish, low + width / 50, high - width / 50);
    if (start == last || least < seen) continue;
    last = start;
    const LineModel guess = first_guess(frame, start);
    Eigen::VectorXd x(3);
    x << std::log(std::max(guess.curvature, 1e-12)), guess.rate, start;
    const double deviation = settle_at_last_rate(few, lines, fit(few, lines, x, 60), x);
    if (!(deviation < least)) continue;
    least = deviation;
    best_x = x;
  }
  LineFit best;
  if (best_x.size() == 0) {
    best.model = first_guess(frame, std::clamp(0.0, low, high));
    best.deviation = frame.displacement(turning_of(best.model, frame.cells())).norm();
    return best;
  }
  best.deviation = fit(frame, lines, best_x, 60);
  best.deviation = settle_at_last_rate(frame, lines, best.deviation, best_x);
  best.model = one_line(best_x, low, high);
  if (width > 0) {
    const Lines free([](const Eigen::VectorXd& x) { return one_line(x, -99, 99); });
    best.slope_error0 = best.slope_error1 = uncertainty(frame, free, best_x)[2];
  }
  return best;
}

namespace {

/// Two lines near the one line m, meeting at the anchor, with slopes this far from its slope.
Eigen::VectorXd two_lines_guess(const LineModel& m, const SlopeBounds& b, double anchor,
                                double step0, double step1) {
  const double margin = 0.4;
  LineModel guess = m;
  guess.slope0 = std::clamp(m.slope0 + step0, b.low0 + margin, b.high0 - margin);
  guess.slope1 = std::clamp(m.slope0 + step1, b.low1 + margin, b.high1 - margin);
  guess.curvature = std::max(curvature_at(m, anchor), 1e-9);
  guess.rate = m.rate / std::max(1 - m.slope0 * m.rate * (anchor - m.anchor), 1e-3);
  guess.anchor = anchor;
  Eigen::VectorXd x(5);
  x << std::log(guess.curvature), drawable_rate(guess), guess.slope0, guess.slope1, anchor;
  return x;
}

}  // namespace

LineFit fit_two_lines(const PieceFrame& frame, const SlopeBounds& bounds, const LineModel& start,
                      double seen) {
  if (is_straight(frame))
    return straight_line(frame, (bounds.low0 + bounds.high0) / 2, (bounds.low1 + bounds.high1) / 2);
  const LineModels lines{
      [&](const Eigen::VectorXd& x) { return two_lines(x, bounds); },
      bounds_of({{bounds.low0, bounds.high0}, {bounds.low1, bounds.high1}, kAnchors})};
  const double way = bounds.low0 > bounds.low1 ? 1 : -1;
  const PieceFrame few = frame.coarse();
  Eigen::VectorXd best_x;
  double least = std::numeric_limits<double>::infinity();
  for (double anchor : {0.25, 0.5, 0.75}) {
    for (const auto& [step0, step1] : {std::pair{0.7, -0.7}, {2.0, -0.2}, {0.2, -2.0}}) {
      if (least < seen) break;
      Eigen::VectorXd x = two_lines_guess(start, bounds, anchor, way * step0, way * step1);
      const double deviation = settle_at_last_rate(few, lines, fit(few, lines, x, 80), x);
      if (!(deviation < least)) continue;
      least = deviation;
      best_x = x;
    }
  }
  LineFit best;
  if (best_x.size() == 0) {
    best.model = start;
    best.deviation = frame.displacement(turning_of(start, frame.cells())).norm();
    return best;
  }
  best.deviation = fit(frame, lines, best_x, 100);
  best.deviation = settle_at_last_rate(frame, lines, best.deviation, best_x);
  best.model = two_lines(best_x, bounds);
  const Lines free([](const Eigen::VectorXd& x) { return two_lines(x, {-99, 99, -99, 99}); });
  const Eigen::VectorXd errors = uncertainty(frame, free, best_x);
  best.slope_error0 = errors[2];
  best.slope_error1 = errors[3];
  return best;
}

}  // namespace keyline::analysis::detail
