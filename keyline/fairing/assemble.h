#pragma once

#include <optional>
#include <vector>

#include "keyline/fairing/fair.h"
#include "keyline/fairing/region.h"
#include "keyline/fairing/run.h"

/// Putting solved runs together into the answer.
namespace keyline::fairing::detail {

/// Adds a run's pieces, of which some read as `asked`, and its points' offsets.
void add_run(FairResult& result, const RunResult& solved, const Run& run, int curve, double start,
             const std::vector<int>& asked);

/// Largest and mean square deviation of the offsets collected, and whether they pass. Points whose
/// offset is not a number are of no run.
void measure_deviation(FairResult& result);

/// Curves in order, joints between and inside them. Members: see RegionPlan; empty: all the runs.
void assemble(FairResult& result, const std::vector<RunResult>& solved,
              const AnswerMembers& members);

/// Notes something of the k-th of so many runs; a lone one is the curve and is not named.
void note_of_run(FairResult& result, std::size_t k, std::size_t runs, const std::string& text);

/// Tells pieces whose slopes are none of those asked for: through an inflection few pass, and the
/// shortest chain, where it stands in for the calmest, heeds no range.
void note_slopes(FairResult& result, core::Interval slopes);

/// How the chain of the k-th of so many runs was found.
void note_run(FairResult& result, const RunResult& run, std::size_t k, std::size_t runs);

}  // namespace keyline::fairing::detail
