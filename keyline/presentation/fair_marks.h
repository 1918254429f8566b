#pragma once

#include <string>
#include <vector>

#include "keyline/core/interval.h"
#include "keyline/fairing/fair.h"
#include "keyline/figure/curve_charts.h"

namespace keyline::presentation::detail {

/// What a surfacer would look at again, of every piece: its needles and near-steps, whether it is
/// too short to be seen, whether its slope is as steep as it was allowed to be.
struct PieceMarks {
  int needles = 0;
  int near_steps = 0;
  bool too_short = false;
  bool at_limit = false;
};

/// One for each of the answer's pieces. slopes: the limits in force.
std::vector<PieceMarks> piece_marks(const fairing::FairResult& result, core::Interval slopes);

/// "needle, too short to see"; empty where there is nothing to say.
std::string marks_text(const PieceMarks& marks);

/// The same beside the sampled answer: n a needle, s a near-step, at their places; t a piece too
/// short to be seen, l a slope at its limit, in the pieces' middles.
void add_marks(figure::SampledCurve& sampled, const fairing::FairResult& result,
               core::Interval slopes);

/// What the letters of add_marks() mean.
inline constexpr const char* kMarksCaption =
    "Rings: n a needle, s a near-step (curvature that would pass its whole range within 2 % of the "
    "length), t a piece too short to be seen, l a slope at its limit.";

}  // namespace keyline::presentation::detail
