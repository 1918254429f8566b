// Solving and sampling one log-aesthetic segment: what happens while a handle is dragged.
#include <cmath>

#include <benchmark/benchmark.h>

#include "keyline/core/point.h"
#include "keyline/lac/hermite/hermite.h"
#include "keyline/lac/segment/segment.h"

namespace keyline {
namespace {

// Argument: slope in tenths.
void solve_segment(benchmark::State& state) {
  const double alpha = static_cast<double>(state.range(0)) / 10;
  double y = 1.5;
  for (auto _ : state) {
    benchmark::DoNotOptimize(lac::solve_g1({0, 0}, {2, 0}, {3, y}, alpha));
    y = 3.0 - y + 1e-9;  // another problem every time
  }
}

// Argument: number of points.
void sample_segment(benchmark::State& state) {
  const lac::Segment segment{{{0, 0}, 0.1}, -0.5, 3.0, 0.1, 1.2};
  const int count = static_cast<int>(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(lac::sample(segment, count));
}

BENCHMARK(solve_segment)->Arg(-10)->Arg(0)->Arg(5)->Arg(10)->Arg(20);
BENCHMARK(sample_segment)->Arg(20)->Arg(200);

}  // namespace
}  // namespace keyline
