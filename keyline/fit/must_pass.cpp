#include "keyline/fit/must_pass.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>

#include "keyline/core/text.h"

namespace keyline::fit::detail {
namespace {

constexpr double kPassed = 1e-3;    // of how far other points are off
constexpr double kRounding = 1e-9;  // of the extent of all

double offset(const LeastSquaresSpline& spline, double parameter, const auto& value_of) {
  double squares = 0;
  for (std::size_t k = 0; k < spline.coefficients.size(); ++k) {
    const double r = evaluate(spline, parameter, k) - value_of(k);
    squares += r * r;
  }
  return std::sqrt(squares);
}

double extent(const SplineData& data) {
  double largest = 0;
  for (const std::vector<double>& column : data.columns) {
    const auto [least, most] = std::minmax_element(column.begin(), column.end());
    largest = std::max(largest, *most - *least);
  }
  return largest;
}

/// Offsets from which on points count as missed.
double allowed(const LeastSquaresSpline& spline, const SplineData& data) {
  const double heaviest = *std::ranges::max_element(data.weights);
  double farthest = 0;
  for (std::size_t i = 0; i < data.parameters.size(); ++i)
    if (data.weights[i] < heaviest)
      farthest = std::max(farthest, offset(spline, data.parameters[i],
                                           [&](std::size_t k) { return data.columns[k][i]; }));
  return std::max(kPassed * farthest, kRounding * extent(data));
}

struct Missed {
  const ToPass* point = nullptr;
  double by = 0;
};

/// The one that is missed most; none where all are passed.
Missed most_missed(const LeastSquaresSpline& spline, const SplineData& data,
                   const std::vector<ToPass>& points) {
  Missed most{nullptr, allowed(spline, data)};
  for (const ToPass& p : points) {
    const double by = offset(spline, p.parameter, [&](std::size_t k) { return p.values[k]; });
    if (!(by <= most.by)) most = {&p, by};
  }
  return most;
}

/// Means of as many neighbouring parameters as the degree: knots that meet the conditions of
/// Schoenberg and Whitney, so that some spline interpolates the points (de Boor, A Practical Guide
/// to Splines, ch. XIII). Of a closed curve, parameters in [0, 1), as many as there are points.
std::vector<double> interpolating_knots(const std::vector<ToPass>& points, int order, bool closed) {
  std::vector<double> at;
  for (const ToPass& p : points) at.push_back(p.parameter);
  std::ranges::sort(at);
  at.erase(std::unique(at.begin(), at.end()), at.end());
  const std::size_t count = at.size(), degree = static_cast<std::size_t>(order) - 1;
  const std::size_t first = closed ? 0 : 1, ends = closed ? 0 : degree + 1;
  std::vector<double> knots;
  for (std::size_t i = 0; i + ends < count; ++i) {
    double sum = 0;
    for (std::size_t j = i + first; j < i + first + degree; ++j)
      sum += at[j % count] + static_cast<double>(j / count);
    const double mean = sum / static_cast<double>(degree);
    knots.push_back(closed ? mean - std::floor(mean) : mean);
  }
  std::ranges::sort(knots);
  return knots;
}

}  // namespace

core::Result<std::optional<LeastSquaresSpline>> passing(const SplineOf& spline_of,
                                                        const std::vector<double>& knots,
                                                        const SplineData& data, bool closed,
                                                        const std::vector<ToPass>& points) {
  auto spline = spline_of(knots);
  if (!spline || points.empty()) return spline;
  Missed missed = most_missed(*spline, data, points);
  if (!missed.point) return spline;
  const std::vector<double> alone = interpolating_knots(points, spline->order, closed);
  std::vector<double> besides;
  std::merge(knots.begin(), knots.end(), alone.begin(), alone.end(), std::back_inserter(besides));
  for (const std::vector<double>& more : {besides, alone}) {
    auto next = spline_of(more);
    if (!next) continue;
    const Missed now = most_missed(*next, data, points);
    if (!now.point) return next;
    if (now.by < missed.by) missed = now;
  }
  return core::fail(core::ErrorCode::not_converged,
                    "point " + std::to_string(missed.point->number) +
                        ", which must be passed, is missed by " + core::number_text(missed.by, 3),
                    "let fewer points be passed, or take out points beside it", "must_pass");
}

}  // namespace keyline::fit::detail
