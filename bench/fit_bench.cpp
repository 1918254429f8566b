// Least squares with given knots (peer: fit.py) and the search for knots.
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include <benchmark/benchmark.h>

#include "keyline/core/interval.h"
#include "keyline/core/point.h"
#include "keyline/fit/fit_spline.h"
#include "keyline/fit/least_squares_spline.h"

namespace keyline {
namespace {

core::Point2 wave(double t) { return {1200 * t, 100 * std::sin(3 * t) + 8 * std::cos(11 * t)}; }

fit::SplineData wave_data(std::size_t count, int columns) {
  fit::SplineData data;
  data.columns.resize(static_cast<std::size_t>(columns));
  for (std::size_t i = 0; i < count; ++i) {
    const double t = static_cast<double>(i) / static_cast<double>(count - 1);
    data.parameters.push_back(t);
    data.columns.back().push_back(wave(t).y);
    if (columns == 2) data.columns.front().push_back(wave(t).x);
  }
  return data;
}

void fit_given_knots(benchmark::State& state, int columns) {
  constexpr int kKnots = 20;
  std::vector<double> knots;
  for (int i = 1; i <= kKnots; ++i) knots.push_back(static_cast<double>(i) / (kKnots + 1));
  const auto count = static_cast<std::size_t>(state.range(0));
  fit::SplineSolver solver(wave_data(count, columns), core::Interval{0, 1}, 4);
  for (auto _ : state) {
    benchmark::DoNotOptimize(solver.solve(knots));
    benchmark::DoNotOptimize(solver.coefficient(0, 0));
  }
}

void least_squares_function(benchmark::State& state) { fit_given_knots(state, 1); }
void least_squares_curve(benchmark::State& state) { fit_given_knots(state, 2); }

// The whole search with the defaults of fit.spline, one trial.
void knot_search(benchmark::State& state) {
  std::vector<core::Point2> points;
  const auto count = static_cast<int>(state.range(0));
  for (int i = 0; i < count; ++i) points.push_back(wave(static_cast<double>(i) / (count - 1)));
  fit::SplineFitOptions options;
  options.trials = 1;
  options.rounding = 0.1;
  for (auto _ : state) benchmark::DoNotOptimize(fit::fit_spline(points, {}, options));
}

// The spline step of fair, with its budget.
void fair_spline(benchmark::State& state) {
  std::vector<core::Point2> points;
  const auto count = static_cast<int>(state.range(0));
  for (int i = 0; i < count; ++i) points.push_back(wave(static_cast<double>(i) / (count - 1)));
  const auto options = fit::SplineFitOptions::for_fairing();
  for (auto _ : state) benchmark::DoNotOptimize(fit::fit_spline(points, {}, options));
}

BENCHMARK(fair_spline)
    ->RangeMultiplier(10)
    ->Range(100, 100000)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(least_squares_function)->Arg(49)->Arg(1000)->Arg(10000);
BENCHMARK(least_squares_curve)->Arg(49)->Arg(1000)->Arg(10000);
BENCHMARK(knot_search)->Arg(49)->Arg(1000)->Unit(benchmark::kMillisecond)->Iterations(1);

}  // namespace
}  // namespace keyline
