// What python.py does in one call from Python, done from C++: 100,000 segments, a million
// curvatures.

#include <random>

#include <benchmark/benchmark.h>

#include "keyline/lac/chain/chain_sampler.h"
#include "keyline/lac/hermite/hermite.h"

namespace {

using namespace keyline;

void segments(benchmark::State& state) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> jitter(-0.1, 0.1);
  std::vector<lac::G1Problem> problems;
  for (int i = 0; i < 100'000; ++i)
    problems.push_back({{0, 0}, {2 + jitter(random), jitter(random)}, {3.2, 1.2}, -1});
  std::vector<lac::G1Outcome> outcomes(problems.size());
  for (auto _ : state) {
    lac::solve_g1(problems, outcomes);
    benchmark::ClobberMemory();
  }
}
BENCHMARK(segments)->Name("python_segments/100000")->Unit(benchmark::kMillisecond);

void curvatures(benchmark::State& state) {
  const lac::ChainSampler sampler({{}, {{0.5, 3, 0.2, 2}}, false});
  std::vector<double> at(1'000'000);
  for (std::size_t i = 0; i < at.size(); ++i) at[i] = 3.0 * static_cast<double>(i) / 1e6;
  std::vector<double> values(at.size());
  for (auto _ : state) {
    sampler.curvatures(at, values);
    benchmark::ClobberMemory();
  }
}
BENCHMARK(curvatures)->Name("python_curvatures/1000000")->Unit(benchmark::kMillisecond);

}  // namespace
