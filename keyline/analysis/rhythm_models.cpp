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
constexpr double kLeastCurvature = 1e-12;  // to begin with, of a piece of length 1

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

/// Rates to begin with: shares of the last one with which the piece exists, 0 to beside it; where
/// there is none, or beyond these, as many that double.
std::vector<double> rates_to_try(const LineModel& m) {
  constexpr int kMany = 10;
  constexpr double kLeast = -0.1;
  const double last = drawable_rates(m).low;
  const bool near = last > kLeast * std::exp2(kMany);
  std::vector<double> rates;
  for (int k = 0; k < kMany; ++k)
    rates.push_back(near ? last * (1 - std::exp2(-k)) : kLeast * std::exp2(k));
  return rates;
}

/// The model with the rate of these, and its curvature, that leaves least. Displacement is linear
/// in curvature: the best one is known.
LineModel with_best_rate(const PieceFrame& frame, LineModel m) {
  const Eigen::VectorXd none = frame.displacement(Eigen::VectorXd::Zero(frame.cells()));
  double least = std::numeric_limits<double>::infinity();
  LineModel best = m;
  for (const double rate : rates_to_try(m)) {
    m.rate = rate;
    m.curvature = 1;
    const Eigen::VectorXd one = frame.displacement(turning_of(m, frame.cells())) - none;
    m.curvature = std::max(-one.dot(none) / one.squaredNorm(), kLeastCurvature);
    const double left = (m.curvature * one + none).norm();
    if (!(left < least)) continue;
    least = left;
    best = m;
  }
  return best;
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
    const LineModel guess = with_best_rate(few, {1, 0, 0.5, start, start});
    Eigen::VectorXd x(3);
    x << std::log(guess.curvature), guess.rate, start;
    const double deviation = settle_at_last_rate(few, lines, fit(few, lines, x, 60), x);
    if (!(deviation < least)) continue;
    least = deviation;
    best_x = x;
  }
  LineFit best;
  if (best_x.size() == 0) {
    const double slope = std::clamp(0.0, low, high);
    best.model = with_best_rate(frame, {1, 0, 0.5, slope, slope});
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

constexpr std::size_t kStarts = 6;  // docs/design/rhythm-choice.md

/// A slope of that size in the larger part of its range, or at its border.
double slope_of(double size, double low, double high) {
  return std::clamp(low + high < 0 ? -size : size, low, high);
}

/// Where to begin: of anchors and sizes of slopes those that leave least.
std::vector<Eigen::VectorXd> two_lines_starts(const PieceFrame& frame, const SlopeBounds& b) {
  std::vector<std::pair<double, Eigen::VectorXd>> all;
  for (const double anchor : {0.2, 0.35, 0.5, 0.65, 0.8})
    for (const double size0 : {0.2, 0.6, 1.5, 4.0})
      for (const double size1 : {0.2, 0.6, 1.5, 4.0}) {
        const LineModel m = with_best_rate(frame, {1, 0, anchor, slope_of(size0, b.low0, b.high0),
                                                   slope_of(size1, b.low1, b.high1)});
        Eigen::VectorXd x(5);
        x << std::log(m.curvature), m.rate, m.slope0, m.slope1, m.anchor;
        all.emplace_back(frame.displacement(turning_of(m, frame.cells())).norm(), std::move(x));
      }
  std::ranges::stable_sort(all, {}, [](const auto& start) { return start.first; });
  std::vector<Eigen::VectorXd> first;
  for (std::size_t i = 0; i < kStarts; ++i) first.push_back(std::move(all[i].second));
  return first;
}

}  // namespace

LineFit fit_two_lines(const PieceFrame& frame, const SlopeBounds& bounds, double seen) {
  if (is_straight(frame))
    return straight_line(frame, (bounds.low0 + bounds.high0) / 2, (bounds.low1 + bounds.high1) / 2);
  const LineModels lines{
      [&](const Eigen::VectorXd& x) { return two_lines(x, bounds); },
      bounds_of({{bounds.low0, bounds.high0}, {bounds.low1, bounds.high1}, kAnchors})};
  const PieceFrame few = frame.coarse();
  const std::vector<Eigen::VectorXd> starts = two_lines_starts(few, bounds);
  Eigen::VectorXd best_x = starts.front();
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::VectorXd x : starts) {
    if (least < seen) break;
    const double deviation = settle_at_last_rate(few, lines, fit(few, lines, x, 80), x);
    if (!(deviation < least)) continue;
    least = deviation;
    best_x = x;
  }
  LineFit best;
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
