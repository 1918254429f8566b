// G1 and compound solves: thread CPU time per solve as mean and as 99th percentile, over problems
// drawn evenly from the drawable region (turning 0.05 to 2.8).
#include <algorithm>
#include <cmath>
#include <ctime>
#include <random>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>

#include "keyline/lac/hermite/compound.h"
#include "keyline/lac/hermite/hermite.h"
#include "keyline/lac/hermite/region.h"

namespace keyline {
namespace {

using core::Point2;

struct Problem {
  Point2 middle;
  double alpha = -1;
};

Point2 middle_of(double theta, double psi) {
  // Triangle on the chord from (0, 0) to (1, 0) with angles psi and theta - psi, below it.
  const double side = std::sin(theta - psi) / std::sin(theta);
  return {side * std::cos(psi), -side * std::sin(psi)};
}

/// `spread` 0: alpha = -1; else even in [-spread, spread].
std::vector<Problem> problems(double spread) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Problem> all(1024);
  for (Problem& p : all) {
    p.alpha = spread == 0 ? -1 : spread * (2 * unit(random) - 1);
    const double theta = 0.05 + 2.75 * unit(random);
    const core::Interval region = lac::drawable_region(p.alpha, theta);
    p.middle = middle_of(theta, core::at(region, 0.02 + 0.96 * unit(random)));
  }
  return all;
}

double thread_nanoseconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e9 * static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec);
}

/// Times of one solve over the problems, each the least of ten repetitions of a run of 16 equal
/// solves, sorted.
template <class F>
std::vector<double> sorted_times(std::size_t count, F&& solve) {
  std::vector<double> times(count);
  for (std::size_t i = 0; i < count; ++i) {
    double best = 1e18;
    for (int repeat = 0; repeat < 10; ++repeat) {
      const double before = thread_nanoseconds();
      for (int k = 0; k < 16; ++k) solve(i);
      best = std::min(best, (thread_nanoseconds() - before) / 16);
    }
    times[i] = best;
  }
  std::sort(times.begin(), times.end());
  return times;
}

// Argument: 0 for alpha = -1, else alpha random in [-argument, argument].
void g1_solve(benchmark::State& state) {
  const std::vector<Problem> all = problems(static_cast<double>(state.range(0)));
  const auto solve = [&](std::size_t i) {
    const Problem& p = all[i];
    benchmark::DoNotOptimize(lac::solve_g1({0, 0}, p.middle, {1, 0}, p.alpha));
  };
  std::size_t i = 0;
  for (auto _ : state) solve(i++ & 1023);
  const std::vector<double> times = sorted_times(all.size(), solve);
  state.counters["median_ns"] = times[times.size() / 2];
  state.counters["p99_ns"] = times[times.size() * 99 / 100];
}
BENCHMARK(g1_solve)->Arg(0)->Arg(4);

// As g1_solve, all problems in one call; the time shown is that of one problem.
void g1_solve_batch(benchmark::State& state) {
  std::vector<lac::G1Problem> all;
  for (const Problem& p : problems(static_cast<double>(state.range(0)))) {
    all.push_back({{0, 0}, p.middle, {1, 0}, p.alpha});
  }
  std::vector<lac::G1Outcome> outcomes(all.size());
  while (state.KeepRunningBatch(static_cast<benchmark::IterationCount>(all.size()))) {
    lac::solve_g1(all, outcomes);
    benchmark::ClobberMemory();
  }
}
BENCHMARK(g1_solve_batch)->Arg(0)->Arg(4);

void compound_solve(benchmark::State& state) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<std::pair<lac::CompoundRhythm, Point2>> all(1024);
  for (auto& [rhythm, middle] : all) {
    rhythm = {3 - 6 * unit(random), 3 - 6 * unit(random), 0.1 + 0.8 * unit(random)};
    const double theta = 0.05 + 2.75 * unit(random);
    const core::Interval region = lac::drawable_region(rhythm, theta);
    middle = middle_of(theta, core::at(region, 0.02 + 0.96 * unit(random)));
  }
  std::size_t i = 0;
  for (auto _ : state) {
    const auto& [rhythm, middle] = all[i++ & 1023];
    benchmark::DoNotOptimize(lac::solve_compound({0, 0}, middle, {1, 0}, rhythm));
  }
}
BENCHMARK(compound_solve);

void directions_solve(benchmark::State& state) {
  double direction = 0.3;
  for (auto _ : state) {
    benchmark::DoNotOptimize(lac::solve_g1_directions({{0, 0}, direction}, {{1, 0}, 0.8}, -1.5));
    direction = 1.1 - direction;
  }
}
BENCHMARK(directions_solve);

}  // namespace
}  // namespace keyline
