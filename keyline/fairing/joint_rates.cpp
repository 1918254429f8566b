#include "keyline/fairing/joint_rates.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "keyline/core/text.h"
#include "keyline/fairing/rate_joints.h"
#include "keyline/fairing/run_again.h"
#include "keyline/fairing/settle.h"
#include "keyline/fairing/symmetric_run.h"

namespace keyline::fairing::detail {
namespace {

constexpr double kOneRate = 1e-2;  // of the larger rate: as analysis tells G3 joints

/// False where the chain stays as it is.
bool make_one(RunResult& result, const Run& run, const RunOptions& options) {
  if (result.dense.joints.empty()) return false;
  RunResult joined = result;
  const RateReport report = join_rates(joined.fit, joined.points,
                                       {.tolerance = kBandShare * result.accept.tolerance,
                                        .slopes = options.slopes,
                                        .progress = options.progress});
  if (!report.within) return false;
  joined.chain = lay_out(joined.fit, joined.to_canonical, joined.reversed);
  if (!(largest_offset(joined, run) <= options.tolerance)) return false;
  if (passed_most(joined, run) > passed_most(result, run)) return false;
  if (waves_of({joined}) > waves_of({result})) return false;
  result = std::move(joined);
  result.joined = true;
  return true;
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

}  // namespace

void make_rates_one(FairResult& result, std::vector<RunResult>& solved,
                    const std::vector<Run>& runs, const OptionsOf& options) {
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const RunOptions own = options(k);
    if (own.joints == JointOrder::g2) continue;
    const bool done = make_one(solved[k], runs[k], own);
    const std::string pieces = core::counted(solved[k].chain.pieces.size(), "piece");
    result.notes.push_back(
        fmt::format("run {}: {}", k,
                    done ? pieces + " for G3 joints"
                         : "no chain with more G3 joints was found within the tolerance, with no "
                           "more waves and less than twice the variation: they stay as they are"));
  }
  if (!runs.empty() && options(0).joints == JointOrder::g3) note_joints(result, solved);
}

}  // namespace keyline::fairing::detail
