#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "keyline/acquire/key_line.h"
#include "keyline/analysis/comb_figures.h"
#include "keyline/core/describe.h"
#include "keyline/curve/bspline.h"

namespace keyline::fairing {

struct FairResult;

/// How fair an answer is: its comb in figures, beside what others make of the same points. Of
/// several members waves are added up; of energy and jolt the worst counts. Parts that are kept as
/// given are not judged.
struct FairFigures {
  analysis::CombFigures answer;  ///< of its faired parts
  analysis::CombFigures spline;  ///< of step 2
  /// Of the smoothest quintic splines within the tolerance, one for each member between corners,
  /// with no more waves than those of few knots; not where parts are kept as given.
  std::optional<analysis::CombFigures> smoothing_spline;
  std::vector<analysis::CombFigures> rivals;  ///< what each member is held against; may be empty
  std::size_t unfair = 0;  ///< members that are not as calm, as far as that can be seen
  int waves_over = 0;      ///< of these, beyond their rivals'
  double times = 0;        ///< the most by which energy or jolt of one exceeds its rival's
  bool fair = false;
  static constexpr auto describe() {
    return core::fields(
        core::field<&FairFigures::answer>("of the answer's comb, where it was faired"),
        core::field<&FairFigures::spline>("of the spline through the points"),
        core::field<&FairFigures::smoothing_spline>(
            "of the smoothest quintic splines within the tolerance, one between corners each; not "
            "where parts are kept as given"),
        core::field<&FairFigures::fair>(
            "every part between corners has no more waves than its spline (or the one through the "
            "points), energy and jolt at most half as much again, or twice as much where it has "
            "fewer; or single pieces that reproduce the points to rounding"));
  }
  /// What the answer is held against.
  const analysis::CombFigures& rival() const {
    return smoothing_spline ? *smoothing_spline : spline;
  }
};

/// Every member is held against its own rival, for a tight bend elsewhere would hide what it has
/// too much; one that is an arc to a tenth of the tolerance (see unseen_energy) is calm. `before`:
/// of the same line, tolerance and splines with another answer, whose rivals are its too.
FairFigures fair_figures(const acquire::KeyLine& line, const FairResult& result,
                         const FairFigures* before = nullptr, int threads = 0);

/// Near-steps and needles of the answer's chains, by arc length from the start of the whole.
std::vector<analysis::CombMark> comb_marks(const FairResult& result);

}  // namespace keyline::fairing
