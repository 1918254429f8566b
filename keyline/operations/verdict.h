#pragma once

#include "keyline/analysis/analyze.h"
#include "keyline/core/describe.h"
#include "keyline/curve/monotone.h"

/// "yes", "no", "undecided" in results.
namespace keyline::operations {

enum class Verdict { yes, no, undecided };
constexpr auto choices(const Verdict*) {
  return core::words<Verdict>(
      {{Verdict::yes, "yes"}, {Verdict::no, "no"}, {Verdict::undecided, "undecided"}});
}

constexpr Verdict verdict_of(curve::MonotoneVerdict::Answer answer) {
  using Answer = curve::MonotoneVerdict::Answer;
  return answer == Answer::yes  ? Verdict::yes
         : answer == Answer::no ? Verdict::no
                                : Verdict::undecided;
}

constexpr Verdict verdict_of(analysis::MonotoneAnswer::Value answer) {
  using Value = analysis::MonotoneAnswer::Value;
  return answer == Value::yes  ? Verdict::yes
         : answer == Value::no ? Verdict::no
                               : Verdict::undecided;
}

}  // namespace keyline::operations
