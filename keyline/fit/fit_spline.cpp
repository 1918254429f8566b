#include "keyline/fit/fit_spline.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include "keyline/fit/canonical.h"

namespace keyline::fit {
namespace {

using core::ErrorCode;
using core::Point2;

core::Result<void> check(const SplineFitOptions& o) {
  const auto bad = [](const char* name, const char* range) {
    return core::fail(ErrorCode::bad_input, std::string(name) + " must lie in " + range, "", name);
  };
  if (o.order < kMinimumOrder || o.order > kMaximumOrder) return bad("order", "2 … 8");
  if (o.population < 2 || o.population > 100000) return bad("population", "2 … 100000");
  if (o.generations < 0 || o.generations > 1000000) return bad("generations", "0 … 1000000");
  if (o.trials < 1 || o.trials > 100000) return bad("trials", "1 … 100000");
  if (!(o.rounding >= 0) || !std::isfinite(o.rounding)) return bad("rounding", "0 … infinity");
  if (!(o.resolution >= 0) || !(o.resolution < 1)) return bad("resolution", "0 … 1");
  return {};
}

/// The weights with those of must-pass points raised; empty where all are 1.
core::Result<std::vector<double>> all_weights(std::size_t count, std::span<const double> given,
                                              const std::vector<std::size_t>& must_pass) {
  if (!given.empty() && given.size() != count) {
    return core::fail(ErrorCode::bad_input, "as many weights as points are needed", "", "weights");
  }
  std::vector<double> weights(given.begin(), given.end());
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (weights[i] > 0 && std::isfinite(weights[i])) continue;
    return core::fail(ErrorCode::bad_input, "weights must be positive and finite", "",
                      "weights[" + std::to_string(i) + "]");
  }
  if (must_pass.empty()) return weights;
  weights.resize(count, 1.0);
  const double heavy = 1e6 * *std::max_element(weights.begin(), weights.end());
  for (const std::size_t i : must_pass) {
    if (i >= count) {
      return core::fail(ErrorCode::bad_input, "no such point to pass", "", "must_pass");
    }
    weights[i] = heavy;
  }
  return weights;
}

KnotSearchOptions search_options(const SplineFitOptions& o) {
  KnotSearchOptions s;
  s.population = o.population;
  s.generations = o.generations;
  s.trials = o.trials;
  s.seed = o.seed;
  s.threads = o.threads;
  s.placement = o.knots;
  s.smart_start = o.smart_start;
  s.polish_rounds = o.polish_rounds;
  s.progress = o.progress;
  return s;
}

double sum_of_weights(const SplineData& data) {
  if (data.weights.empty()) return static_cast<double>(data.parameters.size());
  return std::accumulate(data.weights.begin(), data.weights.end(), 0.0);
}

/// Knots in [0, 1] in the direction of the data, the criterion in the data's unit, and the report.
struct Found {
  std::vector<double> knots;
  BayesCriterion criterion;
  SplineFitReport report;
};

core::Result<Found> find_knots(const detail::CanonicalData& canonical, double rounding,
                               const SplineFitOptions& options) {
  Found found;
  found.report.rounding = rounding;
  found.report.seed = options.seed;
  const double unit = rounding * canonical.scale;
  const double finest = std::max(unit * unit / 12, options.resolution * options.resolution);
  BayesCriterion criterion;
  criterion.count = static_cast<double>(canonical.data.parameters.size());
  criterion.order = options.order;
  criterion.floor =
      finest * sum_of_weights(canonical.data) * static_cast<double>(canonical.data.columns.size());
  found.criterion = criterion;
  found.criterion.floor /= canonical.scale * canonical.scale;
  detail::CondensedData condensed{canonical.data, 0};
  if (options.condense_above > 0 && canonical.data.parameters.size() > options.condense_above) {
    condensed = detail::condense(canonical.data, options.condense_above);
  }
  criterion.hidden = condensed.scatter;
  found.report.data_used = condensed.data.parameters.size();
  SplineSolver solver(std::move(condensed.data), {0, 1}, options.order);
  if (!std::isfinite(solver.sum_of_squares({}))) {
    return core::fail(ErrorCode::bad_input, "too few different points for a spline of this order",
                      "give at least as many points as the order");
  }
  KnotSearchResult searched = search_knots(solver, criterion, search_options(options));
  found.knots = detail::given_direction(canonical, std::move(searched.knots));
  found.report.status = searched.cancelled ? SplineFitStatus::cancelled : SplineFitStatus::complete;
  found.report.generations = searched.generations;
  found.report.evaluations = searched.evaluations;
  return found;
}

/// The final fit; where rounding puts the knots just beyond the rank limit, the nearest knots
/// within it: those left when the closest pair loses one.
bool solve_final(SplineSolver& solver, std::vector<double>& knots) {
  while (!solver.solve(knots)) {
    if (knots.empty()) return false;
    std::size_t closest = 0;
    double gap = 2;
    for (std::size_t i = 1; i < knots.size(); ++i) {
      if (knots[i] - knots[i - 1] < gap) {
        gap = knots[i] - knots[i - 1];
        closest = i;
      }
    }
    knots.erase(knots.begin() + static_cast<std::ptrdiff_t>(closest));
  }
  return true;
}

struct Misfit {
  double sse = 0;
  double largest = 0;
};

/// Weighted squares and largest distance of the data from the solver's spline.
Misfit misfit(const SplineSolver& solver) {
  const std::size_t n = solver.data_count();
  std::vector<double> residuals(n * solver.column_count());
  solver.residuals(residuals);
  Misfit result;
  for (std::size_t i = 0; i < n; ++i) {
    double squares = 0;
    for (std::size_t k = 0; k < solver.column_count(); ++k) {
      squares += residuals[k * n + i] * residuals[k * n + i];
    }
    result.sse += squares;
    const double w = solver.data().weights.empty() ? 1 : solver.data().weights[i];
    result.largest = std::max(result.largest, std::sqrt(squares / w));
  }
  return result;
}

core::Result<void> check_points(std::span<const Point2> points, int order) {
  if (points.size() < static_cast<std::size_t>(order)) {
    return core::fail(ErrorCode::bad_input, "a spline of order " + std::to_string(order) +
                                                " needs at least " + std::to_string(order) +
                                                " points, got " + std::to_string(points.size()));
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (core::is_finite(points[i])) continue;
    return core::fail(ErrorCode::bad_input, "a coordinate is not a finite number", "",
                      "points[" + std::to_string(i) + "]");
  }
  return {};
}

double curve_rounding(std::span<const Point2> points, double given) {
  if (given > 0) return given;
  std::vector<double> values;
  for (const Point2& p : points) {
    values.push_back(p.x);
    values.push_back(p.y);
  }
  return detail::decimal_rounding(values);
}

}  // namespace

SplineFitOptions SplineFitOptions::for_fairing() {
  SplineFitOptions options;
  options.order = 5;
  options.population = 30;
  options.generations = 30;
  options.trials = 1;
  options.smart_start = true;
  options.polish_rounds = 10;
  options.condense_above = 800;
  options.resolution = 1e-6;
  return options;
}

core::Result<SplineFit> fit_spline(std::span<const Point2> points, std::span<const double> weights,
                                   const SplineFitOptions& options) {
  if (auto ok = check(options); !ok) return std::unexpected(ok.error());
  if (auto ok = check_points(points, options.order); !ok) return std::unexpected(ok.error());
  const auto w = all_weights(points.size(), weights, options.must_pass);
  if (!w) return std::unexpected(w.error());
  SplineFit fit;
  fit.parameters =
      detail::polygon_parameters(points, options.parameter == Parametrization::centripetal);
  if (fit.parameters.empty()) {
    return core::fail(
        ErrorCode::bad_input,
        "the points are all equal, or too far apart for their distances to be numbers");
  }
  const auto found = find_knots(detail::canonical_curve(points, fit.parameters, *w),
                                curve_rounding(points, options.rounding), options);
  if (!found) return std::unexpected(found.error());
  SplineData data{fit.parameters, {{}, {}}, *w};
  for (const Point2& p : points) {
    data.columns[0].push_back(p.x - points.front().x);
    data.columns[1].push_back(p.y - points.front().y);
  }
  SplineSolver solver(std::move(data), {0, 1}, options.order);
  fit.interior_knots = found->knots;
  if (!solve_final(solver, fit.interior_knots)) {
    return core::fail(ErrorCode::bad_input, "too few different points for a spline of this order");
  }
  fit.curve.degree = options.order - 1;
  fit.curve.knots.assign(solver.knots().begin(), solver.knots().end());
  for (std::size_t i = 0; i + static_cast<std::size_t>(options.order) < fit.curve.knots.size();
       ++i) {
    fit.curve.control.push_back(points.front() +
                                core::Vector2{solver.coefficient(i, 0), solver.coefficient(i, 1)});
  }
  const Misfit m = misfit(solver);
  fit.sse = m.sse;
  fit.deviation = m.largest;
  fit.rms = std::sqrt(m.sse / sum_of_weights(solver.data()));
  fit.bic = found->criterion(fit.sse, fit.interior_knots.size());
  fit.report = found->report;
  return fit;
}

core::Result<FunctionFit> fit_function(std::span<const double> x, std::span<const double> y,
                                       std::span<const double> weights,
                                       const SplineFitOptions& options) {
  if (auto ok = check(options); !ok) return std::unexpected(ok.error());
  if (x.size() != y.size()) {
    return core::fail(ErrorCode::bad_input, "as many y as x are needed");
  }
  std::vector<Point2> points;
  for (std::size_t i = 0; i < x.size(); ++i) points.push_back({x[i], y[i]});
  if (auto ok = check_points(points, options.order); !ok) return std::unexpected(ok.error());
  const auto w = all_weights(x.size(), weights, options.must_pass);
  if (!w) return std::unexpected(w.error());
  std::vector<std::size_t> by_x(x.size());
  std::iota(by_x.begin(), by_x.end(), std::size_t{0});
  std::stable_sort(by_x.begin(), by_x.end(),
                   [&](std::size_t a, std::size_t b) { return x[a] < x[b]; });
  SplineData data{{}, {{}}, {}};
  for (const std::size_t i : by_x) {
    data.parameters.push_back(x[i]);
    data.columns[0].push_back(y[i]);
    if (!w->empty()) data.weights.push_back((*w)[i]);
  }
  const core::Interval range{data.parameters.front(), data.parameters.back()};
  const auto [least, most] = std::minmax_element(y.begin(), y.end());
  if (!(range.low < range.high) || !std::isfinite(core::length(range)) ||
      !std::isfinite((*most - *least) * static_cast<double>(y.size()))) {
    return core::fail(ErrorCode::bad_input, "x are all equal, or x or y too far apart");
  }
  const double rounding = options.rounding > 0 ? options.rounding : detail::decimal_rounding(y);
  const auto found =
      find_knots(detail::canonical_function(data.parameters, data.columns[0], data.weights),
                 rounding, options);
  if (!found) return std::unexpected(found.error());
  FunctionFit fit;
  for (const double t : found->knots) fit.interior_knots.push_back(core::at(range, t));
  std::erase_if(fit.interior_knots, [&](double t) { return !(t > range.low && t < range.high); });
  SplineSolver solver(std::move(data), range, options.order);
  if (!solve_final(solver, fit.interior_knots)) {
    return core::fail(ErrorCode::bad_input, "too few different x for a spline of this order");
  }
  fit.spline.order = options.order;
  fit.spline.knots.assign(solver.knots().begin(), solver.knots().end());
  fit.spline.coefficients.emplace_back();
  for (std::size_t i = 0; i + static_cast<std::size_t>(options.order) < fit.spline.knots.size();
       ++i) {
    fit.spline.coefficients[0].push_back(solver.coefficient(i, 0));
  }
  const Misfit m = misfit(solver);
  fit.spline.sum_of_squares = fit.sse = m.sse;
  fit.deviation = m.largest;
  fit.rms = std::sqrt(m.sse / sum_of_weights(solver.data()));
  fit.bic = found->criterion(fit.sse, fit.interior_knots.size());
  fit.report = found->report;
  return fit;
}

}  // namespace keyline::fit
