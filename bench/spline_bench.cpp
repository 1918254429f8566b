// G2 splines of log-aesthetic pieces through points; the peer (spline.py) is libspiro.
#include <cmath>
#include <cstdint>
#include <vector>

#include <benchmark/benchmark.h>

#include "keyline/lac/g2/g2_hermite.h"
#include "keyline/lac/g2/spline.h"

namespace keyline {
namespace {

/// A gently wavy row of points; spline.py uses the same.
std::vector<core::Point2> wavy_points(int count) {
  std::vector<core::Point2> points;
  for (int i = 0; i < count; ++i) {
    points.push_back({1.0 * i, 0.8 * std::sin(0.9 * i) + 0.2 * std::cos(2.3 * i)});
  }
  return points;
}

void spline_of_slope(benchmark::State& state, double alpha) {
  const auto points = wavy_points(static_cast<int>(state.range(0)));
  lac::SplineOptions options;
  options.alpha = {alpha};
  for (auto _ : state) {
    const auto spline = lac::solve_spline(points, options);
    if (!spline) state.SkipWithError(spline.error().message.c_str());
    benchmark::DoNotOptimize(spline);
  }
}

void clothoid_spline(benchmark::State& state) { spline_of_slope(state, -1); }
void spline_slope_minus_2(benchmark::State& state) { spline_of_slope(state, -2); }
void spline_slope_half(benchmark::State& state) { spline_of_slope(state, 0.5); }

// Argument: slope in tenths.
void g2_hermite(benchmark::State& state) {
  const double alpha = static_cast<double>(state.range(0)) / 10;
  const lac::CurvatureElement start{{{0, 0}, -0.6}, 0.3};
  const lac::CurvatureElement end{{{1, 0}, 0.7}, 1.4};
  for (auto _ : state) benchmark::DoNotOptimize(lac::solve_g2(start, end, alpha));
}

BENCHMARK(clothoid_spline)->Arg(10)->Arg(1000);
BENCHMARK(spline_slope_minus_2)->Arg(10)->Arg(1000);
BENCHMARK(spline_slope_half)->Arg(10)->Arg(1000);
BENCHMARK(g2_hermite)->Arg(-10)->Arg(-20)->Arg(5);

}  // namespace
}  // namespace keyline
