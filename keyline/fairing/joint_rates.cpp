#include "keyline/fairing/joint_rates.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "keyline/core/text.h"
#include "keyline/fairing/assemble.h"
#include "keyline/fairing/rate_joints.h"
#include "keyline/fairing/run_again.h"
#include "keyline/fairing/settle.h"
#include "keyline/fairing/symmetric_run.h"

namespace keyline::fairing::detail {
namespace {

constexpr double kOneRate = 1e-2;  // of the larger rate: as analysis tells G3 joints

/// The run with that chain in place of its own.
RunResult with_chain(const RunResult& result, const FitChain& chain) {
  RunResult joined = result;
  joined.fit = chain;
  joined.chain = lay_out(chain, joined.to_canonical, joined.reversed);
  return joined;
}

/// What a run would lose by another chain.
std::optional<RateLoss> lost_by(const RunResult& joined, const RunResult& result, const Run& run,
                                const RunOptions& options) {
  if (!(largest_offset(joined, run) <= options.tolerance)) return RateLoss::tolerance;
  if (passed_most(joined, run) > passed_most(result, run)) return RateLoss::bounds;
  if (waves_of({joined}) > waves_of({result})) return RateLoss::waves;
  return std::nullopt;
}

/// Not within where the chain stays as it is.
RateReport make_one(RunResult& result, const Run& run, const RunOptions& options) {
  if (result.dense.joints.empty()) return {};
  FitChain chain = result.fit;
  const RateReport report =
      join_rates(chain, result.points,
                 {.tolerance = kBandShare * result.accept.tolerance,
                  .slopes = options.slopes,
                  .loses =
                      [&](const FitChain& one) {
                        return lost_by(with_chain(result, one), result, run, options);
                      },
                  .progress = options.progress});
  if (!report.within) return report;
  result = with_chain(result, chain);
  result.joined = true;
  return report;
}

}  // namespace

std::string held_from_within(const std::vector<RunResult>& solved) {
  if (std::ranges::any_of(solved, &RunResult::joined))
    return "that joints are to be of one rate within the tolerance";
  return "the points' noise, which keeps it near them";
}

void count_rates(JointRates& count, const std::vector<lac::Segment>& segments, bool closed) {
  const std::size_t n = segments.size();
  if (n < 2) return;
  for (std::size_t i = 0; i + (closed ? 0 : 1) < n; ++i) {
    const double before = lac::curvature_rate(segments[i], 1);
    const double after = lac::curvature_rate(segments[(i + 1) % n], 0);
    if (std::abs(after - before) <= kOneRate * std::max(std::abs(before), std::abs(after)))
      ++count.g3;
    else
      ++(before * after < 0 ? count.turns : count.jumps);
  }
}

namespace {

/// How far a wish for G3 joints was met.
void note_joints(FairResult& result, const std::vector<RunResult>& solved) {
  JointRates rates;
  for (const RunResult& run : solved)
    count_rates(rates, lac::segments(run.chain), run.chain.closed);
  const auto all = static_cast<std::size_t>(rates.g3 + rates.turns + rates.jumps);
  result.notes.push_back(
      fmt::format("of {} {} {} G3; at {} curvature turns, where none can be; {} more could be, but "
                  "one rate was "
                  "not found there within the tolerance and the range of slopes",
                  core::counted(all, "joint"), rates.g3, rates.g3 == 1 ? "is" : "are", rates.turns,
                  rates.jumps));
}

const char* words_of(RateLoss loss) {
  switch (loss) {
    case RateLoss::slopes:
      return "their slopes do not come to one rate";
    case RateLoss::tolerance:
      return "one rate there leaves the tolerance";
    case RateLoss::variation:
      return "one rate there costs twice the variation";
    case RateLoss::waves:
      return "one rate there takes another wave";
    case RateLoss::bounds:
      return "one rate there passes a bound";
  }
  return "";
}

/// Which joints stay G2, as shares of the run's length, and why.
void note_stay(FairResult& result, const RunResult& run, std::size_t k, std::size_t runs,
               const RateReport& report) {
  std::vector<double> at{0};
  for (const FitPiece& piece : run.fit.pieces) at.push_back(at.back() + piece.length);
  constexpr std::array kLosses{RateLoss::slopes, RateLoss::tolerance, RateLoss::variation,
                               RateLoss::waves, RateLoss::bounds};
  for (const RateLoss loss : kLosses) {
    std::vector<double> places;
    for (const RateReport::Stay& stay : report.stay) {
      const double share = at[stay.piece] / at.back();
      if (stay.loss == loss) places.push_back(100 * (run.reversed ? 1 - share : share));
    }
    if (places.empty()) continue;
    std::ranges::sort(places);
    note_of_run(result, k, runs,
                fmt::format("G2 stays at {:.1f} % of its length: {}", fmt::join(places, ", "),
                            words_of(loss)));
  }
}

}  // namespace

void make_rates_one(FairResult& result, std::vector<RunResult>& solved,
                    const std::vector<Run>& runs, const OptionsOf& options) {
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const RunOptions own = options(k);
    if (own.joints == JointOrder::g2) continue;
    const RateReport report = make_one(solved[k], runs[k], own);
    const std::string pieces = core::counted(solved[k].chain.pieces.size(), "piece");
    note_of_run(result, k, runs.size(),
                report.within
                    ? pieces + " for G3 joints"
                    : "no chain with more G3 joints was found within the tolerance, with no "
                      "more waves and less than twice the variation: they stay as they are");
    if (report.within) note_stay(result, solved[k], k, runs.size(), report);
  }
  if (!runs.empty() && options(0).joints == JointOrder::g3) note_joints(result, solved);
}

}  // namespace keyline::fairing::detail
