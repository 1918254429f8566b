#include "keyline/fairing/until_fair.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "keyline/acquire/noise.h"

namespace keyline::fairing::detail {
namespace {

struct Try {
  double smoothness;
  double from, to;  // of the progress
};
// From the noise on twice as far each time. The first step lets the mean square grow by about a
// tenth, as much as the noise may be told wrongly: more than the least that is fair leaves points
// for nothing. Where they do not tell their noise, two wide steps do.
constexpr std::array<Try, 5> kTries{{{kNearAsNoise, 0, 0.7},
                                     {0.5625, 0.7, 0.8},
                                     {0.625, 0.8, 0.9},
                                     {0.75, 0.9, 0.95},
                                     {1, 0.95, 1}}};
constexpr double kWide = 0.75;  // the first of the two wide steps

/// The largest root of the offsets' mean square that leaves a curve nearer to the shape than one of
/// its points is: errors and the curve's own departure add in squares, and that is no more than the
/// noise, or than what the tolerance holds beyond the errors. Farther off only a fair answer
/// counts.
double most_rms(const acquire::KeyLine& line, const FairResult& result) {
  const std::size_t n = line.points.size();
  const double left = std::max(0.0, result.tolerance - noise_factor(n) * result.noise);
  return std::hypot(std::numbers::sqrt2 * result.noise, left);
}

/// How far an answer is from fair, the worse the greater.
std::tuple<bool, int, double, double> unfairness(const FairResult& result) {
  const FairFigures& f = result.fairness;
  if (f.fair) return {!result.within_tolerance, 0, 0, 0};
  return {!result.within_tolerance, f.waves_over, f.times, f.answer.energy};
}

core::Result<FairResult> judged(const acquire::KeyLine& line, core::Result<FairResult> found,
                                const FairResult* before, int threads) {
  if (found)
    found->fairness = fair_figures(line, *found, before ? &before->fairness : nullptr, threads);
  return found;
}

void tell(FairResult& result) {
  if (result.fairness.fair)
    result.notes.push_back(
        fmt::format("smoothness {} in place of {}: nearer to its points the answer is not fair",
                    result.smoothness, kNearAsNoise));
  else
    result.notes.push_back(
        fmt::format("smoothness {}: no answer up to a smoothness of 1 is fair", result.smoothness));
}

/// The pieces that are to be read otherwise are those of the answer without that wish.
core::Result<FairResult> read_otherwise(const acquire::KeyLine& line, const FairOptions& options,
                                        const Solve& solve) {
  FairOptions plain = options;
  plain.interpretations.clear();
  plain.progress = core::part_of(options.progress, 0, 0.7);
  const auto seen = until_fair(line, plain, solve);
  if (!seen || seen->cancelled) return seen;
  FairOptions asked = options;
  asked.smoothness = seen->smoothness;
  asked.progress = core::part_of(options.progress, 0.7, 1);
  auto found = judged(line, solve(asked, &*seen), &*seen, options.threads);
  if (found && found->smoothness > kNearAsNoise)
    found->notes.push_back(
        fmt::format("smoothness {}, as without the interpretation asked for", found->smoothness));
  return found;
}

}  // namespace

core::Result<FairResult> until_fair(const acquire::KeyLine& line, const FairOptions& options,
                                    const Solve& solve) {
  const bool calmest = options.criterion == Criterion::least_variation && options.pieces == 0;
  if (options.smoothness || !calmest)
    return judged(line, solve(options, nullptr), nullptr, options.threads);
  if (!options.interpretations.empty()) return read_otherwise(line, options, solve);
  const bool told = acquire::noise_stays(line.points, line.closed, line.noise);
  std::optional<FairResult> best;
  std::optional<core::Result<FairResult>> ahead;  // the last one, solved for before its turn
  const auto solved = [&](const Try& one) {
    if (ahead && one.smoothness == kTries.back().smoothness) return std::move(*ahead);
    FairOptions asked = options;
    asked.smoothness = one.smoothness;
    asked.progress = core::part_of(options.progress, one.from, one.to);
    return solve(asked, best ? &*best : nullptr);
  };
  // The most smoothness leaves the most room: what does not come out there does not between.
  const auto calmest_is_missed = [&] {
    ahead = solved({kTries.back().smoothness, 0.7, 0.8});
    return !*ahead || (*ahead)->calm_missed || (*ahead)->cancelled;
  };
  for (const Try& one : kTries) {
    if (!told && one.smoothness > kNearAsNoise && one.smoothness < kWide) continue;
    const FairResult* before = best ? &*best : nullptr;
    auto found = judged(line, solved(one), before, options.threads);
    if (!found && !best) return found;
    if (!found || (found->cancelled && best)) break;
    const bool near = !told || found->rms_deviation <= most_rms(line, *found);
    const bool worth = near || found->fairness.fair;
    if (!best || (worth && unfairness(*found) < unfairness(*best))) best = std::move(*found);
    if (best->fairness.fair || best->cancelled || !best->smoothness_counts) break;
    if (!before && best->calm_missed && calmest_is_missed()) break;
  }
  if (!best->fairness.fair || best->smoothness > kNearAsNoise) tell(*best);
  return std::move(*best);
}

}  // namespace keyline::fairing::detail
