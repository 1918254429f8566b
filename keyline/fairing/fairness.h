#pragma once

#include <optional>
#include <vector>

#include "keyline/acquire/key_line.h"
#include "keyline/analysis/comb_figures.h"
#include "keyline/core/describe.h"
#include "keyline/curve/bspline.h"

namespace keyline::fairing {

struct FairResult;

/// How fair an answer is: its comb in figures, beside what others make of the same points.
struct FairFigures {
  analysis::CombFigures answer;
  analysis::CombFigures spline;  ///< of step 2
  /// Of the smoothest quintic spline within the tolerance; not where corners part the answer.
  std::optional<analysis::CombFigures> smoothing_spline;
  bool fair = false;
  static constexpr auto describe() {
    return core::fields(
        core::field<&FairFigures::answer>("of the answer's comb"),
        core::field<&FairFigures::spline>("of the spline through the points"),
        core::field<&FairFigures::smoothing_spline>("of the smoothest quintic spline within the "
                                                    "tolerance; not where corners part the answer"),
        core::field<&FairFigures::fair>(
            "no more waves than that spline (or the one through the points), energy and jolt at "
            "most half as much again; or single pieces that reproduce the points to rounding"));
  }
  /// What the answer is held against.
  const analysis::CombFigures& rival() const {
    return smoothing_spline ? *smoothing_spline : spline;
  }
};

/// Waves of all members together, energy and jolt of the worst. `before`: of the same line,
/// tolerance and splines with another answer, whose rivals are its too.
FairFigures fair_figures(const acquire::KeyLine& line, const FairResult& result,
                         const FairFigures* before = nullptr, int threads = 0);

/// Near-steps and needles of the answer's chains, by arc length from the start of the whole.
std::vector<analysis::CombMark> comb_marks(const FairResult& result);

}  // namespace keyline::fairing
