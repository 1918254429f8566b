// Class A: value of a curve, minimum-energy search, strain energy; and beside OCCT's fair curves
// between the same ends with the same directions: time, share with monotone curvature, energy.
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <benchmark/benchmark.h>

#include "keyline/classa/cav.h"
#include "keyline/classa/edit.h"
#include "keyline/classa/strain_energy.h"
#include "keyline/core/angle.h"
#include "keyline/curve/monotone.h"

#ifdef KEYLINE_BENCH_OCCT
#include "fair_curve_peer.h"
#endif

namespace keyline {
namespace {

curve::Bezier2 given_curve(int degree) {
  return classa::to_bezier({{0, 0}, {1, 2}, 1, {1.5 / degree, 1.05}, degree});
}

// Argument: degree.
void curve_aesthetic_value(benchmark::State& state) {
  const auto c = given_curve(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(classa::cav(c));
}

// A curve of several matrices: no place in the plane, but a minimum of its own.
void curve_aesthetic_value_type_4(benchmark::State& state) {
  auto c = given_curve(static_cast<int>(state.range(0)));
  c.control[1].x += 0.2;
  for (auto _ : state) benchmark::DoNotOptimize(classa::cav(c));
}

void edit_to_minimum(benchmark::State& state) {
  const auto c = given_curve(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(classa::edit(c));
}

void strain_energy(benchmark::State& state) {
  const auto c = given_curve(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(classa::strain_energy(c));
}

/// Ends (0, 0) and (1, 0), start directions up to so many degrees below the chord, end exact.
std::vector<classa::EnergyConditions> problems(int degrees) {
  std::mt19937 random(2015);
  std::uniform_real_distribution<double> unit(0.05, 1);
  std::vector<classa::EnergyConditions> all(200);
  for (auto& c : all) c.tangent = core::unit_vector(-unit(random) * degrees * core::kPi / 180);
  return all;
}

/// Argument: largest angle between start tangent and chord, degrees.
void minimum_energy_curve(benchmark::State& state) {
  const auto all = problems(static_cast<int>(state.range(0)));
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(classa::minimum_energy(all[i++ % all.size()]));
  int solved = 0;
  int monotone = 0;
  for (const auto& c : all) {
    const auto m = classa::minimum_energy(c);
    if (!m) continue;
    ++solved;
    const classa::MatrixCurve made{{0, 0}, c.tangent, m->beta, {m->alpha, m->s}, c.degree};
    // A minimum on the boundary of Class A is monotone up to rounding alone.
    const auto verdict = curve::certify_monotone_curvature(classa::to_bezier(made));
    monotone += verdict.answer == curve::MonotoneVerdict::yes || verdict.backward < 1e-9;
  }
  state.counters["solved"] = solved / 200.0;
  state.counters["monotone"] = monotone / 200.0;
}

BENCHMARK(curve_aesthetic_value)->Arg(3)->Arg(6)->Unit(benchmark::kMicrosecond);
BENCHMARK(curve_aesthetic_value_type_4)->Arg(3)->Unit(benchmark::kMicrosecond);
BENCHMARK(edit_to_minimum)->Arg(3)->Unit(benchmark::kMicrosecond);
BENCHMARK(strain_energy)->Arg(3)->Arg(6)->Unit(benchmark::kMicrosecond);
BENCHMARK(minimum_energy_curve)->Arg(20)->Arg(40)->Unit(benchmark::kMicrosecond);

#ifdef KEYLINE_BENCH_OCCT
struct Pair {
  double from, to, energy;
};

/// The directions of our minima at both ends, and their energies.
std::vector<Pair> same_ends(int degrees) {
  std::vector<Pair> pairs;
  for (const auto& c : problems(degrees)) {
    const auto m = classa::minimum_energy(c);
    const double from = core::direction_of(c.tangent);
    if (m) pairs.push_back({from, from + (c.degree - 1) * m->alpha, m->energy});
  }
  return pairs;
}

/// Second argument: 0 least variation of curvature, 1 least energy of bending.
void peer_of_minimum_energy(benchmark::State& state, double physical_ratio) {
  const auto pairs = same_ends(static_cast<int>(state.range(0)));
  std::size_t i = 0;
  for (auto _ : state) {
    const Pair& p = pairs[i++ % pairs.size()];
    benchmark::DoNotOptimize(fair_curve(p.from, p.to, physical_ratio));
  }
  int solved = 0;
  int monotone = 0;
  double share = 0;
  for (const Pair& p : pairs) {
    const auto c = fair_curve(p.from, p.to, physical_ratio);
    if (!c) continue;
    ++solved;
    const auto verdict = curve::certify_monotone_curvature(*c, 1e-6);
    monotone += verdict.answer == curve::MonotoneVerdict::yes || verdict.backward < 1e-6;
    share += classa::strain_energy(*c) / p.energy;
  }
  state.counters["solved"] = solved / static_cast<double>(pairs.size());
  state.counters["monotone"] = monotone / static_cast<double>(pairs.size());
  state.counters["energy_over_ours"] = share / std::max(solved, 1);
}

BENCHMARK_CAPTURE(peer_of_minimum_energy, variation, 0.0)
    ->Name("minimum_energy_curve/peer:OCCT MinimalVariation")
    ->Arg(20)
    ->Arg(40)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(peer_of_minimum_energy, bending, 1.0)
    ->Name("minimum_energy_curve/peer:OCCT bending")
    ->Arg(20)
    ->Arg(40)
    ->Unit(benchmark::kMicrosecond);
#endif

}  // namespace
}  // namespace keyline
