#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "keyline/classa/cav.h"
#include "keyline/core/describe.h"
#include "keyline/core/error.h"
#include "keyline/core/interval.h"
#include "keyline/surface/network.h"

namespace keyline::surface {

/// What a designer asks of a network curve when a patch is edited ([Oya] §4.3, "given conditions
/// per network curve"). What is left empty falls back to the condition for every curve, then to the
/// edit's own choice.
struct CurveCondition {
  std::string curve = {};                    ///< "A1"…; empty: every curve
  std::optional<core::Interval> alpha = {};  ///< radians, within [0, alpha_max]
  std::optional<core::Interval> s = {};      ///< of edges as they grow; as they stand with `branch`
  std::optional<double> end_tolerance = {};  ///< of its minimum, a length
  /// Edges grow (s >= 1/cos alpha) or fall (s <= cos alpha) from the first control point on, which
  /// is the one of b00's side. Empty: the way the edit finds them growing, s >= 1.
  std::optional<classa::Branch> branch = {};
  /// Whether the direction of its first edge stays. Empty: as EditOptions::keep says, which is
  /// no, but for A1 and the first column where the start is kept.
  std::optional<bool> tangent = {};
  static constexpr auto describe() {
    using Condition = CurveCondition;
    return core::fields(
        core::field<&Condition::curve>(
            "of the network, \"A1\", \"A2\", ...; every one unless given"),
        core::field<&Condition::alpha>("where its rotation may lie").in("radian"),
        core::field<&Condition::s>("where its scale may lie"),
        core::field<&Condition::end_tolerance>("of its minimum")
            .in("length")
            .within(core::at_least(0)),
        core::field<&Condition::branch>("growing (s >= 1/cos alpha) or falling (s <= cos alpha)"),
        core::field<&Condition::tangent>("whether its start direction stays"));
  }
  static constexpr std::string_view kTextForm =
      "CURVE:NAME=VALUE,..., for example A1:s=1.1..1.4,alpha=0..0.3,end=0.1,branch=falling,"
      "tangent=kept; without A1: of all";
  static core::Result<CurveCondition> from_text(std::string_view text);
};

/// bad_input for a curve that the net does not have or that is named twice, ranges that are empty,
/// alpha outside [0, alpha_max], s out of [0.01, 100], end_tolerance negative or not smaller than
/// the chord of one of its curves. Paths such as
/// "conditions[1].s".
core::Result<void> validate(std::span<const CurveCondition> conditions, const Net& net,
                            double alpha_max);

/// One for each network curve, in their order, what is general filled in.
std::vector<CurveCondition> conditions_by_curve(std::span<const CurveCondition> conditions,
                                                const Net& net);

/// How a curve is valued under its condition: the ranges of its minimum, the direction it is read
/// in, the end tolerance.
classa::CavOptions cav_options(const CurveCondition& condition, classa::CavOptions general);

/// Why the curve does not meet its condition; empty where it does, to 1e-6. `given` is the curve
/// as it was before the edit.
std::optional<std::string> unmet(const NetworkCurve& curve, const NetworkCurve& given,
                                 const CurveCondition& condition, double alpha_max);

/// "alpha in [0, 0.3] and s in [1.1, 1.4]": the ranges a condition sets.
std::string ranges_text(const CurveCondition& condition);

}  // namespace keyline::surface
