#include "keyline/fairing/until_fair.h"

#include <algorithm>
#include <array>
#include <optional>
#include <tuple>
#include <utility>

#include <fmt/format.h>

namespace keyline::fairing::detail {
namespace {

struct Try {
  double smoothness;
  double from, to;  // of the progress
};
constexpr std::array<Try, 3> kTries{{{kNearAsNoise, 0, 0.8}, {0.75, 0.8, 0.9}, {1, 0.9, 1}}};

/// How far an answer is from fair, the worse the greater.
std::tuple<bool, int, double, double> unfairness(const FairResult& result) {
  const FairFigures& f = result.fairness;
  const analysis::CombFigures& rival = f.rival();
  if (f.fair) return {!result.within_tolerance, 0, 0, 0};
  return {!result.within_tolerance, std::max(0, f.answer.waves - rival.waves),
          std::max(f.answer.energy / rival.energy, f.answer.jolt / rival.jolt), f.answer.energy};
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

}  // namespace

core::Result<FairResult> until_fair(
    const acquire::KeyLine& line, const FairOptions& options,
    const std::function<core::Result<FairResult>(const FairOptions&, const FairResult* before)>&
        solve) {
  const bool calmest = options.criterion == Criterion::least_variation && options.pieces == 0;
  if (options.smoothness || !calmest)
    return judged(line, solve(options, nullptr), nullptr, options.threads);
  std::optional<FairResult> best;
  for (const Try& one : kTries) {
    FairOptions asked = options;
    asked.smoothness = one.smoothness;
    asked.progress = core::part_of(options.progress, one.from, one.to);
    const FairResult* before = best ? &*best : nullptr;
    auto found = judged(line, solve(asked, before), before, options.threads);
    if (!found && !best) return found;
    if (!found || (found->cancelled && best)) break;
    if (!best || unfairness(*found) < unfairness(*best)) best = std::move(*found);
    if (best->fairness.fair || best->cancelled || !best->smoothness_counts) break;
  }
  if (!best->fairness.fair || best->smoothness > kNearAsNoise) tell(*best);
  return std::move(*best);
}

}  // namespace keyline::fairing::detail
