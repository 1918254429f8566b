#include "keyline/fit/final_spline.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "keyline/fit/near_data.h"
#include "keyline/fit/periodic.h"

namespace keyline::fit::detail {
namespace {

/// Removes the knot nearest behind another one.
void remove_closest(std::vector<double>& knots) {
  auto closest = knots.begin();
  for (auto it = knots.begin() + 1; it < knots.end(); ++it) {
    if (closest == knots.begin() || it[0] - it[-1] < closest[0] - closest[-1]) closest = it;
  }
  knots.erase(closest);
}

/// The loop's first point shared between both ends: half its weight at 0 and half at 1.
SplineData with_both_ends(SplineData data) {
  if (data.weights.empty()) data.weights.assign(data.parameters.size(), 1.0);
  data.weights.front() /= 2;
  data.parameters.push_back(data.parameters.front() + 1);
  data.weights.push_back(data.weights.front());
  for (auto& column : data.columns) column.push_back(column.front());
  for (double& t : data.parameters) t = std::min(t, 1.0);
  return data;
}

/// A periodic spline of one knot is a point, one of two runs to and fro.
constexpr std::size_t kLoop = 3;

/// So many knots at least, in the middle of the widest gaps.
void add_to_a_loop(std::vector<double>& knots) {
  if (knots.empty()) knots.push_back(0);
  while (knots.size() < kLoop) {
    std::size_t widest = 0;
    double width = 0;
    for (std::size_t i = 0; i < knots.size(); ++i) {
      const double next = i + 1 < knots.size() ? knots[i + 1] : knots[0] + 1;
      if (!(next - knots[i] > width)) continue;
      width = next - knots[i];
      widest = i;
    }
    const double middle = knots[widest] + width / 2;
    knots.push_back(middle < 1 ? middle : middle - 1);
    std::sort(knots.begin(), knots.end());
  }
}

}  // namespace

double sum_of_weights(const SplineData& data) {
  if (data.weights.empty()) return static_cast<double>(data.parameters.size());
  return std::accumulate(data.weights.begin(), data.weights.end(), 0.0);
}

std::optional<LeastSquaresSpline> final_fit(const SplineData& data, core::Interval domain,
                                            std::vector<double> knots, int order) {
  SplineSolver solver(data, domain, order);
  while (!knots.empty() && !solver.solve_near_data(knots)) remove_closest(knots);
  if (knots.empty() && !solver.solve(knots)) return std::nullopt;
  LeastSquaresSpline result;
  result.order = order;
  result.knots.assign(solver.knots().begin(), solver.knots().end());
  for (std::size_t k = 0; k < data.columns.size(); ++k) {
    auto& column = result.coefficients.emplace_back();
    for (std::size_t i = 0; i < knots.size() + static_cast<std::size_t>(order); ++i) {
      column.push_back(solver.coefficient(i, k));
    }
  }
  return result;
}

std::optional<LeastSquaresSpline> closed_fit(const SplineData& open, std::vector<double> knots,
                                             int order) {
  const SplineData data = with_both_ends(open);
  add_to_a_loop(knots);
  while (knots.size() >= kLoop) {
    auto spline = periodic_spline(data, knots, order);
    if (spline && (stays_near(*spline, data) || knots.size() == kLoop)) return spline;
    remove_closest(knots);
  }
  return std::nullopt;
}

Misfit misfit(const LeastSquaresSpline& spline, const SplineData& data) {
  Misfit result;
  for (std::size_t i = 0; i < data.parameters.size(); ++i) {
    double squares = 0;
    for (std::size_t k = 0; k < data.columns.size(); ++k) {
      const double r = evaluate(spline, data.parameters[i], k) - data.columns[k][i];
      squares += r * r;
    }
    result.sse += (data.weights.empty() ? 1 : data.weights[i]) * squares;
    result.largest = std::max(result.largest, std::sqrt(squares));
  }
  result.rms = std::sqrt(result.sse / sum_of_weights(data));
  return result;
}

std::vector<double> interior_of(const LeastSquaresSpline& spline) {
  return {spline.knots.begin() + spline.order, spline.knots.end() - spline.order};
}

}  // namespace keyline::fit::detail
