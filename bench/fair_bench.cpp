// The main job end to end (acquire and fair), against the number of points: how cost grows.
#include <cmath>

#include <benchmark/benchmark.h>

#include "keyline/acquire/acquire.h"
#include "keyline/fairing/fair.h"
#include "keyline/lac/chain/chain.h"
#include "keyline/numeric/random.h"

namespace keyline {
namespace {

/// A bonnet, windscreen and roof of six pieces with scanner noise of a ten-thousandth.
acquire::RawCurve scan(std::size_t count) {
  const lac::Chain truth{{{0, 0}, 0.5},
                         {{0.5, 400, -0.0008, -0.0022},
                          {-1, 60, -0.0022, 0.012},
                          {-1, 50, 0.012, -0.0012},
                          {0.7, 300, -0.0012, -0.0006},
                          {-1, 250, -0.0006, -0.0025},
                          {-1, 150, -0.0025, -0.0005}},
                         false};
  numeric::Random random(7);
  acquire::RawCurve raw;
  for (const core::Point2 p : lac::sample(truth, static_cast<int>(count)))
    raw.points.push_back({p.x + 0.1 * random.normal(), p.y + 0.1 * random.normal(), 0});
  return raw;
}

void fair_points(benchmark::State& state) {
  const acquire::RawCurve raw = scan(static_cast<std::size_t>(state.range(0)));
  for (auto _ : state) {
    const auto line = acquire::acquire_key_line(raw);
    benchmark::DoNotOptimize(fairing::fair(*line));
  }
}

BENCHMARK(fair_points)
    ->Name("fair")
    ->RangeMultiplier(10)
    ->Range(100, 100000)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->Iterations(1)
    ->UseRealTime();

}  // namespace
}  // namespace keyline
