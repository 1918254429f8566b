// A curve between two points with given directions, C-shaped, up to so many degrees from the chord:
// time, share solved and share with monotone curvature, beside OCCT's FairCurve_MinimalVariation.
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include <benchmark/benchmark.h>

#include "keyline/core/angle.h"
#include "keyline/lac/hermite/hermite.h"

#include "fair_curve_peer.h"

namespace keyline {
namespace {

struct Directions {
  double from = 0;
  double to = 0;
};

std::vector<Directions> requests(double degrees) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0.02, 1);
  std::vector<Directions> all(200);
  for (Directions& d : all)
    d = {unit(random) * degrees * core::kPi / 180, -unit(random) * degrees * core::kPi / 180};
  return all;
}

/// Curvature at 801 places neither rises nor falls back by more than rounding and noise.
bool is_monotone(const std::function<double(double)>& curvature) {
  std::vector<double> all;
  double size = 0;
  for (int i = 0; i <= 800; ++i) {
    all.push_back(curvature(i / 800.0));
    size = std::max(size, std::abs(all.back()));
  }
  bool rises = false;
  bool falls = false;
  for (std::size_t i = 1; i < all.size(); ++i) {
    rises = rises || all[i] - all[i - 1] > 1e-6 * size;
    falls = falls || all[i] - all[i - 1] < -1e-6 * size;
  }
  return !(rises && falls);
}

void count(benchmark::State& state, int solved, int monotone) {
  state.counters["solved"] = solved / 200.0;
  state.counters["monotone"] = monotone / 200.0;
}

void curve_between_directions(benchmark::State& state) {
  const auto all = requests(static_cast<double>(state.range(0)));
  const auto solve = [](const Directions& d) {
    return lac::solve_g1_directions({{0, 0}, d.from}, {{1, 0}, d.to}, -1);
  };
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(solve(all[i++ % all.size()]));
  int solved = 0;
  int monotone = 0;
  for (const Directions& d : all) {
    const auto s = solve(d);
    solved += s.has_value();
    monotone += s && is_monotone([&](double t) { return lac::curvature(s->segment, t); });
  }
  count(state, solved, monotone);
}

void peer_between_directions(benchmark::State& state) {
  const auto all = requests(static_cast<double>(state.range(0)));
  std::size_t i = 0;
  for (auto _ : state) {
    const Directions& d = all[i++ % all.size()];
    benchmark::DoNotOptimize(fair_curve(d.from, d.to));
  }
  int solved = 0;
  int monotone = 0;
  double off = 0;
  for (const Directions& d : all) {
    const auto s = fair_curve(d.from, d.to);
    solved += s.has_value();
    if (!s) continue;
    const auto at = [&](double t) { return curve::curvature(jet(*s, t)); };
    monotone += is_monotone(at);
    off = std::max({off, std::abs(curve::tangent_angle(jet(*s, 0)) - d.from),
                    std::abs(curve::tangent_angle(jet(*s, 1)) - d.to)});
  }
  count(state, solved, monotone);
  state.counters["direction_error"] = off;
}

BENCHMARK(curve_between_directions)->Arg(20)->Arg(40)->Arg(80);
BENCHMARK(peer_between_directions)
    ->Name("curve_between_directions/peer:OCCT FairCurve")
    ->Arg(20)
    ->Arg(40)
    ->Arg(80)
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace keyline
