// Surfaces under a designer's hand: value, edit and pictures of one bicubic patch.
#include <cmath>

#include <benchmark/benchmark.h>

#include "keyline/surface/closest_point.h"
#include "keyline/surface/edit.h"
#include "keyline/surface/interrogate.h"
#include "keyline/surface/network.h"

namespace keyline::surface {
namespace {

BezierSurface distorted_patch() {
  Net net{4, 4, {}};
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      const double a = 1.7 * i + 2.9 * j;
      net.points.push_back({100.0 * i + 4 * std::sin(a), 70.0 * j + 4 * std::cos(1.3 * a),
                            4.0 * i * i + 5.0 * j * j + 5 * std::sin(2.1 * a)});
    }
  return {net, {}};
}

/// All eight curves have one matrix each: types 1 to 3.
BezierSurface one_matrix_patch() { return edit(distorted_patch()).value().surface; }

void evaluate_jet(benchmark::State& state) {
  const BezierSurface s = distorted_patch();
  double u = 0.3;
  for (auto _ : state) {
    benchmark::DoNotOptimize(jet(s, u, 0.4));
    u = 1 - u;
  }
}

void sav_of_bicubic(benchmark::State& state) {
  const BezierSurface s = state.range(0) == 0 ? distorted_patch() : one_matrix_patch();
  for (auto _ : state) benchmark::DoNotOptimize(sav(s));
}

void edit_bicubic(benchmark::State& state) {
  const BezierSurface s = distorted_patch();
  EditOptions options;
  options.keep = static_cast<Keep>(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(edit(s, options));
}

// Argument: points along each side.
void zebra_field(benchmark::State& state) {
  const Surface s = distorted_patch();
  const int n = static_cast<int>(state.range(0));
  for (auto _ : state)
    benchmark::DoNotOptimize(interrogate(sample_grid(s, n, n, 1), FieldKind::zebra));
}

void gaussian_field(benchmark::State& state) {
  const Surface s = distorted_patch();
  const int n = static_cast<int>(state.range(0));
  for (auto _ : state)
    benchmark::DoNotOptimize(interrogate(sample_grid(s, n, n, 1), FieldKind::gaussian));
}

void closest_point(benchmark::State& state) {
  const Surface s = distorted_patch();
  const ClosestPoint nearest(s);
  double x = 120;
  for (auto _ : state) {
    benchmark::DoNotOptimize(nearest({x, 90, 40}));
    x = 240 - x + 1e-9;
  }
}

BENCHMARK(evaluate_jet);
BENCHMARK(sav_of_bicubic)->Arg(0)->Arg(1);
BENCHMARK(edit_bicubic)->Arg(0)->Arg(1)->Arg(2);
BENCHMARK(zebra_field)->Arg(64)->Arg(512);
BENCHMARK(gaussian_field)->Arg(512);
BENCHMARK(closest_point);

}  // namespace
}  // namespace keyline::surface
