#pragma once

#include <mutex>
#include <optional>
#include <vector>

#include "keyline/fairing/chain_search.h"
#include "keyline/fairing/run.h"
#include "keyline/fairing/run_frame.h"

/// The shortest chain of a run, and the chain that reproduces its points.
namespace keyline::fairing::detail {

enum class Sought { exact, shortest };

/// What was sought of a run and found, by what it depends on: no smoothness and no border, so where
/// one smoothness after another is tried it is sought once. Several threads may ask at a time.
class FoundBefore {
 public:
  std::optional<RunResult> find(Sought sought, const Run& run, double tolerance) const;
  void keep(Sought sought, const Run& run, double tolerance, const RunResult& result);

 private:
  struct Found {
    Sought sought;
    Run run;
    double tolerance;
    RunResult result;
  };
  mutable std::mutex mutex_;
  std::vector<Found> found_;
};

/// What a run's chain has to keep, its length taken for 1.
Acceptance acceptance_of(const Run& run, const RunOptions& options);

/// Points that a chain reproduces to rounding get that chain, whatever the tolerance allows; false
/// where there is none, and the result is what was tried. The search begins with few pieces, as a
/// loose tolerance gives them, and with no more points than tell them.
bool solve_exact(RunResult& result, const Run& run, const RunFrame& frame,
                 const curve::BSpline2& spline, const RunOptions& options);

/// The search, once more with a tighter tolerance where polishing loses what it had found; and
/// where errors that are no noise (traced pixels) leave trends with any chain, without regard to
/// them.
void solve_shortest(RunResult& result, const Run& run, const RunFrame& frame,
                    const curve::BSpline2& spline, const RunOptions& options);

/// As many pieces as are wanted: the shortest chain with its longest pieces parted, or merged from
/// many where fewer are wanted, which leaves the tolerance.
void solve_counted(RunResult& result, const Run& run, const RunFrame& frame,
                   const curve::BSpline2& spline, const RunOptions& options);

}  // namespace keyline::fairing::detail
