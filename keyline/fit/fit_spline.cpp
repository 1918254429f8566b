#include "keyline/fit/fit_spline.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include "keyline/core/text.h"
#include "keyline/fit/canonical.h"
#include "keyline/fit/final_spline.h"
#include "keyline/fit/knot_rates.h"
#include "keyline/fit/must_pass.h"

namespace keyline::fit {
namespace {

using core::ErrorCode;
using core::Point2;

std::unexpected<core::Failure> too_few_places(int order) {
  return core::fail(ErrorCode::bad_input,
                    "the points lie at too few places, as far apart as they are, for a spline of "
                    "order " +
                        std::to_string(order),
                    "give at least as many points as the order; leave out what lies far off");
}

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
  s.unite = o.unite;
  s.progress = o.progress;
  return s;
}

/// Knots in [0, 1] in the direction of the data, the criterion in the data's unit, and the report.
struct Found {
  std::vector<double> knots;
  BayesCriterion criterion;
  SplineFitReport report;
};

/// `weight`: sum of the weights given. Those raised for must-pass points would raise the floor,
/// too.
core::Result<Found> find_knots(const detail::CanonicalData& canonical, double weight,
                               double rounding, const SplineFitOptions& options,
                               const GeneticRates& rates) {
  Found found;
  found.report.rounding = rounding;
  found.report.seed = options.seed;
  const double unit = rounding * canonical.scale;
  const double finest = std::max(unit * unit / 12, options.resolution * options.resolution);
  BayesCriterion criterion;
  criterion.count = static_cast<double>(canonical.data.parameters.size());
  criterion.order = options.order;
  criterion.floor = finest * weight * static_cast<double>(canonical.data.columns.size());
  found.criterion = criterion;
  found.criterion.floor /= canonical.scale * canonical.scale;
  if (found.criterion.floor == 0 && criterion.floor > 0)
    return core::fail(ErrorCode::bad_input,
                      "the values lie so near each other that squares of their distances are 0",
                      "check the unit, or multiply all of them by a common factor");
  detail::CondensedData condensed{canonical.data, 0};
  if (options.condense_above > 0 && canonical.data.parameters.size() > options.condense_above) {
    condensed = detail::condense(canonical.data, options.condense_above);
  }
  criterion.hidden = condensed.scatter;
  found.report.data_used = condensed.data.parameters.size();
  SplineSolver solver(std::move(condensed.data), {0, 1}, options.order);
  if (!std::isfinite(solver.sum_of_squares({}))) {
    return too_few_places(options.order);
  }
  KnotSearchResult searched = search_knots(solver, criterion, search_options(options), rates);
  found.knots = detail::given_direction(canonical, std::move(searched.knots));
  found.report.status = searched.cancelled ? SplineFitStatus::cancelled : SplineFitStatus::complete;
  found.report.generations = searched.generations;
  found.report.evaluations = searched.evaluations;
  return found;
}

core::Result<void> check_points(std::span<const Point2> points, int order) {
  if (points.size() < static_cast<std::size_t>(order)) {
    return core::fail(ErrorCode::bad_input,
                      "a spline of order " + std::to_string(order) + " needs at least " +
                          core::counted(static_cast<std::size_t>(order), "point") + ", got " +
                          std::to_string(points.size()),
                      "give more points, or a smaller order");
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

/// Points in order of their parameters.
struct OrderedPoints {
  std::vector<Point2> points;
  std::vector<double> parameters;
  std::vector<double> weights;
};

/// Indices of the values in increasing order, equal ones as they came.
std::vector<std::size_t> increasing(std::span<const double> values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  return order;
}

OrderedPoints ordered(std::span<const Point2> points, const std::vector<double>& parameters,
                      const std::vector<double>& weights) {
  OrderedPoints result;
  for (const std::size_t i : increasing(parameters)) {
    result.points.push_back(points[i]);
    result.parameters.push_back(parameters[i]);
    if (!weights.empty()) result.weights.push_back(weights[i]);
  }
  return result;
}

constexpr double kOverlap = 0.1;  // of a loop, continued beyond both ends

/// A loop with its last tenth before its start and its first tenth after its end; parameters
/// again in [0, 1].
OrderedPoints overlapped(const OrderedPoints& loop) {
  OrderedPoints result;
  for (const double shift : {-1.0, 0.0, 1.0}) {
    for (std::size_t i = 0; i < loop.points.size(); ++i) {
      const double t = loop.parameters[i] + shift;
      if (t < -kOverlap || t > 1 + kOverlap) continue;
      result.points.push_back(loop.points[i]);
      result.parameters.push_back((t + kOverlap) / (1 + 2 * kOverlap));
      if (!loop.weights.empty()) result.weights.push_back(loop.weights[i]);
    }
  }
  return result;
}

/// Knots of the overlapped loop as knots of one turn, in [0, 1).
std::vector<double> one_turn(const std::vector<double>& knots) {
  std::vector<double> result;
  for (const double t : knots) {
    const double u = t * (1 + 2 * kOverlap) - kOverlap;
    if (u >= 0 && u < 1) result.push_back(u < 1e-9 ? 0 : u);
  }
  return result;
}

double weight_of(const OrderedPoints& run) {
  return detail::sum_of_weights({run.parameters, {}, run.weights});
}

/// The points counted from `origin`, coordinates in columns.
SplineData planar_data(const OrderedPoints& run, Point2 origin) {
  SplineData data{run.parameters, {{}, {}}, run.weights};
  for (const Point2& p : run.points) {
    data.columns[0].push_back(p.x - origin.x);
    data.columns[1].push_back(p.y - origin.y);
  }
  return data;
}

curve::BSpline2 planar_curve(const LeastSquaresSpline& spline, Point2 origin) {
  curve::BSpline2 curve;
  curve.degree = spline.order - 1;
  curve.knots = spline.knots;
  for (std::size_t i = 0; i < spline.coefficients[0].size(); ++i) {
    const core::Vector2 v{spline.coefficients[0][i], spline.coefficients[1][i]};
    curve.control.push_back(origin + v);
  }
  return curve;
}

/// A function's values in the order of their abscissae.
SplineData function_data(std::span<const double> x, std::span<const double> y,
                         const std::vector<double>& weights) {
  SplineData data{{}, {{}}, {}};
  for (const std::size_t i : increasing(x)) {
    data.parameters.push_back(x[i]);
    data.columns[0].push_back(y[i]);
    if (!weights.empty()) data.weights.push_back(weights[i]);
  }
  return data;
}

core::Result<void> check_values(std::span<const double> x, std::span<const double> y, int order) {
  if (x.size() != y.size()) {
    return core::fail(ErrorCode::bad_input, "as many y as x are needed", "give one y for each x");
  }
  std::vector<Point2> points;
  for (std::size_t i = 0; i < x.size(); ++i) points.push_back({x[i], y[i]});
  return check_points(points, order);
}

core::Result<void> check_range(core::Interval range, std::span<const double> y,
                               const std::optional<core::Interval>& wanted) {
  const auto [least, most] = std::minmax_element(y.begin(), y.end());
  if (!(range.low < range.high) || !std::isfinite(core::length(range)) ||
      !std::isfinite((*most - *least) * (*most - *least) * static_cast<double>(y.size()))) {
    return core::fail(ErrorCode::bad_input, "x are all equal, or x or y too far apart",
                      "check the values and their unit");
  }
  if (wanted && !(wanted->low <= range.low && range.high <= wanted->high))
    return core::fail(ErrorCode::bad_input, "the interval does not hold all data",
                      "give one from " + core::number_text(range.low, 9) + " or less to " +
                          core::number_text(range.high, 9) + " or more",
                      "interval");
  return {};
}

}  // namespace

SplineFitOptions SplineFitOptions::for_fairing() {
  SplineFitOptions options;
  options.order = 5;
  options.parameter = Parametrization::smooth_chord;
  options.population = 30;
  options.generations = 30;
  options.trials = 1;
  options.smart_start = true;
  options.polish_rounds = 10;
  options.condense_above = 800;
  options.resolution = 1e-6;
  options.unite = 2;  // "not worth more than a bare mention" [Kass 1995]
  return options;
}

core::Result<SplineFit> fit_spline(std::span<const Point2> points, std::span<const double> weights,
                                   const SplineFitOptions& options) {
  return fit_spline(points, weights, options, GeneticRates{});
}

core::Result<SplineFit> fit_spline(std::span<const Point2> points, std::span<const double> weights,
                                   const SplineFitOptions& options, const GeneticRates& rates) {
  if (auto ok = check(options); !ok) return std::unexpected(ok.error());
  if (auto ok = check_points(points, options.order); !ok) return std::unexpected(ok.error());
  const auto w = all_weights(points.size(), weights, options.must_pass);
  if (!w) return std::unexpected(w.error());
  std::vector<Point2> path(points.begin(), points.end());
  if (options.closed) path.push_back(points.front());
  SplineFit fit;
  fit.parameters = parametrize(path, options.parameter);
  if (fit.parameters.empty()) {
    return core::fail(
        ErrorCode::bad_input,
        "the points are all equal, or too far apart for their distances to be numbers",
        "check the points and their unit");
  }
  fit.parameters.resize(points.size());
  const OrderedPoints run = ordered(points, fit.parameters, *w);
  const OrderedPoints searched = options.closed ? overlapped(run) : run;
  const OrderedPoints given = ordered(points, fit.parameters, {weights.begin(), weights.end()});
  const auto found =
      find_knots(detail::canonical_curve(searched.points, searched.parameters, searched.weights),
                 weight_of(options.closed ? overlapped(given) : given),
                 curve_rounding(points, options.rounding), options, rates);
  if (!found) return std::unexpected(found.error());
  const SplineData data = planar_data(run, points.front());
  std::vector<detail::ToPass> to_pass;
  for (const std::size_t i : options.must_pass) {
    const core::Vector2 from = points[i] - points.front();
    to_pass.push_back({fit.parameters[i], {from.x, from.y}, i});
  }
  const auto through = detail::passing(
      [&](const std::vector<double>& knots) {
        return options.closed ? detail::closed_fit(data, knots, options.order)
                              : detail::final_fit(data, {0, 1}, knots, options.order);
      },
      options.closed ? one_turn(found->knots) : found->knots, data, options.closed, to_pass);
  if (!through) return std::unexpected(through.error());
  const auto& spline = *through;
  if (!spline) {
    return too_few_places(options.order);
  }
  fit.interior_knots = detail::interior_of(*spline);
  fit.curve = planar_curve(*spline, points.front());
  const detail::Misfit m = detail::misfit(*spline, planar_data(given, points.front()));
  fit.sse = m.sse;
  fit.rms = m.rms;
  fit.deviation = m.largest;
  BayesCriterion criterion = found->criterion;
  criterion.count = static_cast<double>(points.size());
  fit.bic = criterion.value(fit.sse, fit.interior_knots.size());
  fit.report = found->report;
  return fit;
}

core::Result<FunctionFit> fit_function(std::span<const double> x, std::span<const double> y,
                                       std::span<const double> weights,
                                       const SplineFitOptions& options) {
  return fit_function(x, y, weights, options, SplineSettings{});
}

core::Result<FunctionFit> fit_function(std::span<const double> x, std::span<const double> y,
                                       std::span<const double> weights,
                                       const SplineFitOptions& options,
                                       const SplineSettings& settings) {
  if (auto ok = check(options); !ok) return std::unexpected(ok.error());
  if (auto ok = check_values(x, y, options.order); !ok) return std::unexpected(ok.error());
  const auto w = all_weights(x.size(), weights, options.must_pass);
  if (!w) return std::unexpected(w.error());
  const SplineData data = function_data(x, y, *w);
  const core::Interval range{data.parameters.front(), data.parameters.back()};
  if (auto ok = check_range(range, y, settings.interval); !ok) return std::unexpected(ok.error());
  const double rounding = options.rounding > 0 ? options.rounding : detail::decimal_rounding(y);
  const SplineData given = function_data(x, y, {weights.begin(), weights.end()});
  const auto found =
      find_knots(detail::canonical_function(data.parameters, data.columns[0], data.weights),
                 detail::sum_of_weights(given), rounding, options, settings.rates);
  if (!found) return std::unexpected(found.error());
  std::vector<double> knots;
  for (const double t : found->knots) knots.push_back(core::at(range, t));
  std::erase_if(knots, [&](double t) { return !(t > range.low && t < range.high); });
  std::vector<detail::ToPass> to_pass;
  for (const std::size_t i : options.must_pass) to_pass.push_back({x[i], {y[i]}, i});
  const auto through = detail::passing(
      [&](const std::vector<double>& more) {
        return detail::final_fit(data, settings.interval.value_or(range), more, options.order);
      },
      knots, data, false, to_pass);
  if (!through) return std::unexpected(through.error());
  const auto& spline = *through;
  if (!spline) {
    return core::fail(ErrorCode::bad_input, "too few different x for a spline of this order",
                      "give more of them, or a smaller order");
  }
  const detail::Misfit m = detail::misfit(*spline, given);
  FunctionFit fit{*spline, detail::interior_of(*spline), m.sse, 0, m.largest, m.rms, found->report};
  fit.spline.sum_of_squares = m.sse;
  fit.bic = found->criterion.value(fit.sse, fit.interior_knots.size());
  return fit;
}

}  // namespace keyline::fit
