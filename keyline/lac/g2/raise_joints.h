#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "keyline/core/describe.h"
#include "keyline/core/error.h"
#include "keyline/core/interval.h"
#include "keyline/lac/chain/chain.h"

/// G3 between neighbours ([Fairing] 5): docs/design/g2-chains.md.
namespace keyline::lac {

/// What became of a joint.
enum class JointFate {
  raised,
  already,       ///< G3 as given
  turn,          ///< curvature rises on one side and falls on the other
  constant,      ///< one side is an arc or a straight line
  jump,          ///< the curvatures of both sides differ
  cusp,          ///< the radius of curvature of a side comes to 0
  not_found,     ///< no pieces with these ends were found
  beyond_limit,  ///< they would depart by more than is allowed
};
constexpr auto choices(const JointFate*) {
  using enum JointFate;
  return core::words<JointFate>({{raised, "raised"},
                                 {already, "already"},
                                 {turn, "turn"},
                                 {constant, "constant"},
                                 {jump, "jump"},
                                 {cusp, "cusp"},
                                 {not_found, "not-found"},
                                 {beyond_limit, "beyond-limit"}});
}

struct RaisedJoint {
  std::size_t piece = 0;  ///< of the given chain, that starts at the joint
  core::Point2 place;     ///< in the new chain
  JointFate fate = JointFate::already;
  std::array<double, 2> rate_before{};  ///< of curvature by arc length, before and after the joint
  std::array<double, 2> rate_after{};   ///< in the new chain
};

/// What stays where it is: every joint, which takes three pieces for one, or but the ends of each
/// run of pieces, which takes no new piece and leaves curvature calmer.
enum class HeldJoints { joints, ends };
constexpr auto choices(const HeldJoints*) {
  return core::words<HeldJoints>({{HeldJoints::joints, "joints"}, {HeldJoints::ends, "ends"}});
}

struct RaiseOptions {
  HeldJoints hold = HeldJoints::ends;
  std::optional<double> limit;  ///< largest departure from the given chain
  static constexpr auto describe() {
    return core::fields(
        core::field<&RaiseOptions::hold>(
            "what keeps its place, direction and curvature: the ends of each stretch on which "
            "curvature rises or falls, or all joints, with three pieces in place of one"),
        core::field<&RaiseOptions::limit>("largest departure; joints that need more stay as given")
            .in("length")
            .within(core::kPositive));
  }
};

struct RaiseSolution {
  Chain chain;
  std::vector<RaisedJoint> joints;  ///< inner ones in order; of a closed chain the closing one last
  double departure = 0;             ///< bound of the distance from the given chain, both ways
};

/// The chain with its joints made G3 wherever that is possible. Ends held: the pieces change as
/// they are. Joints held: pieces beside such joints are replaced by three each, joined G3
/// themselves (four where curvature is 0 at a joint or three do not do). What is held keeps place,
/// direction and curvature; curvature still rises where it rose and falls where it fell. A
/// log-aesthetic piece has a rate of curvature that never vanishes: where curvature turns, or an
/// arc begins, no choice of pieces is G3.
///
/// Method: along a piece the logarithm of the rate is linear in that of curvature, so a G3 chain is
/// a broken line in that graph; its slopes and lengths are found by Newton's method of least change
/// while the gaps between the rates go to 0 step by step, from cuts of which the one that
/// departs least is taken.
///
/// Accuracy: rates of both sides within 1e-9 of themselves, places within 1e-12 of the length.
/// Fails (bad_input): a chain that is not valid.
core::Result<RaiseSolution> raise_joints(const Chain& chain, const RaiseOptions& options = {});

}  // namespace keyline::lac
