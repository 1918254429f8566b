// Log-aesthetic segments as Béziers: what an export and a dragged quasi-log-aesthetic curve cost.
#include <cmath>

#include <benchmark/benchmark.h>

#include "keyline/curve/conversion.h"
#include "keyline/lac/cad/cad.h"
#include "keyline/lac/quasi/quasi.h"

namespace keyline {
namespace {

/// Involute of a circle turning by 2 radians, the radius from 0.5 to 2.
lac::Segment involute() { return *lac::standard_segment(2, 0.75, {0, 2}); }

// Argument: tolerance 10^-n. Counter: pieces.
void cubics_of_involute(benchmark::State& state) {
  const lac::Segment s = involute();
  const double tolerance = std::pow(10, -static_cast<double>(state.range(0)));
  std::size_t pieces = 0;
  for (auto _ : state) {
    const auto b = lac::to_beziers(s, {3, tolerance, state.range(1) == 1});
    pieces = b->pieces.size();
    benchmark::DoNotOptimize(b);
  }
  state.counters["pieces"] = static_cast<double>(pieces);
}

void cubics_of_clothoid(benchmark::State& state) {
  const lac::Segment s{{}, -1, 2, 0, 1.5};
  const double tolerance = std::pow(10, -static_cast<double>(state.range(0)));
  std::size_t pieces = 0;
  for (auto _ : state) {
    const auto b = lac::to_beziers(s, {3, tolerance, true});
    pieces = b->pieces.size();
    benchmark::DoNotOptimize(b);
  }
  state.counters["pieces"] = static_cast<double>(pieces);
}

// The conversion of room curve, which knows nothing of log-aesthetic curves.
void general_cubics_of_involute(benchmark::State& state) {
  const lac::Segment s = involute();
  const double tolerance = std::pow(10, -static_cast<double>(state.range(0)));
  std::size_t pieces = 0;
  for (auto _ : state) {
    const auto b = curve::approximate_by_cubics(s, tolerance);
    pieces = b.pieces.size();
    benchmark::DoNotOptimize(b);
  }
  state.counters["pieces"] = static_cast<double>(pieces);
}

// Argument: degree. Everything: three points to curve, graph, certificate and bound.
void quasi_curve(benchmark::State& state) {
  const lac::QuasiOptions options{lac::QuasiForm::taylor_angle, static_cast<int>(state.range(0))};
  for (auto _ : state)
    benchmark::DoNotOptimize(lac::quasi_log_aesthetic({0, 0}, {2, 0}, {3, 1.5}, 0.5, options));
}

void best_curve(benchmark::State& state) {
  const lac::QuasiOptions options{lac::QuasiForm::best, static_cast<int>(state.range(0))};
  for (auto _ : state)
    benchmark::DoNotOptimize(lac::quasi_log_aesthetic({0, 0}, {2, 0}, {3, 1.5}, 0.5, options));
}

BENCHMARK(cubics_of_involute)->Args({4, 0})->Args({6, 0})->Args({4, 1})->Args({6, 1});
BENCHMARK(cubics_of_clothoid)->Arg(4)->Arg(6);
BENCHMARK(general_cubics_of_involute)->Arg(4)->Arg(6);
BENCHMARK(quasi_curve)->Arg(6)->Arg(20);
BENCHMARK(best_curve)->Arg(6)->Arg(20);

}  // namespace
}  // namespace keyline
