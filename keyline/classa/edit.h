#pragma once

#include <optional>
#include <vector>

#include "keyline/classa/cav.h"
#include "keyline/curve/bezier.h"

namespace keyline::classa {

/// What stays while (alpha, s) is moved by hand.
enum class Hold {
  ends_and_tangent,  ///< both ends and the start tangent: one freedom is left, and the target is
                     ///< moved to the nearest place in the plane that can be reached
  ends,              ///< both ends; the start tangent follows
  start,             ///< start and start tangent; the end follows, as near to the old as it can
};
constexpr auto choices(const Hold*) {
  return core::words<Hold>(
      {{Hold::ends_and_tangent, "ends-and-tangent"}, {Hold::ends, "ends"}, {Hold::start, "start"}});
}

struct EditOptions {
  CavOptions cav;
  std::optional<ControlMatrix> target = {};  ///< alpha >= 0; empty: the minimum-energy point
  Hold hold = Hold::ends_and_tangent;        ///< for a target by hand
  double amount = 1;                         ///< 0 the given curve … 1 the target
};

struct EditResult {
  curve::Bezier2 curve;  ///< in the direction and of the degree of the given one
  CurveValue before;
  CurveValue after;                ///< measured against the same minimum as `before`
  ControlMatrix target;            ///< the place the slide ends at
  std::vector<core::Point2> path;  ///< (alpha, s) from the given place (types 1-3) to the target
};

/// Slides a curve towards a place of the alpha-s plane, continuously in `amount`.
///
/// A curve of type 1-3 keeps one matrix all the way: alpha and the allowed end move evenly, s and
/// beta follow so that the end is met. One of type 4 or 5 slides by its control points. Start point
/// and start tangent (of the direction it is read in, cav.h) stay; the end stays within the end
/// tolerance, which for a target is 0 unless given. To the minimum and with hold ends_and_tangent
/// this holds for every amount.
///
/// Errors: as of cav(); bad_input for an amount outside [0, 1], a target with alpha outside
/// [0, alpha_max] or s outside the range of s; undrawable where there is no minimum, or no place
/// that holds what is to be held.
core::Result<EditResult> edit(const curve::Bezier2& c, const EditOptions& options = {});

struct SpaceEditResult {
  curve::Bezier3 curve;  ///< in the plane of the given one, start and end where they were
  EditResult flat;       ///< in that plane, the start of the given curve at the origin
};
/// The same for a curve in space. One that lies in no plane (within options.cav.tolerance of its
/// size) slides by its control points to the plane curve of its conditions (cav.h): `flat.curve` is
/// that curve, where the slide ends.
core::Result<SpaceEditResult> edit(const curve::Bezier3& c, const EditOptions& options = {});

}  // namespace keyline::classa
