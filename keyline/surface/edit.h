#pragma once

#include <optional>
#include <string>
#include <vector>

#include "keyline/core/describe.h"
#include "keyline/core/error.h"
#include "keyline/core/progress.h"
#include "keyline/surface/conditions.h"
#include "keyline/surface/network.h"

namespace keyline::surface {

/// What an edit leaves where it is: the corner b00 with the tangent directions of A1 and A5 there;
/// the four corners; the corners, each boundary curve moving as it alone asks for, so that the
/// neighbour's moves with it and joints stay closed; all four boundary curves.
enum class Keep { start, corners, joints, boundary };
constexpr auto choices(const Keep*) {
  return core::words<Keep>({{Keep::start, "start"},
                            {Keep::corners, "corners"},
                            {Keep::joints, "joints"},
                            {Keep::boundary, "boundary"}});
}

struct EditOptions {
  Keep keep = Keep::start;
  double amount = 1;                 ///< 0 the given net … 1 the target, control points between
  std::optional<double> limit = {};  ///< largest departure (a bound), in the surface's unit
  /// Where no target lies within the limit: as far towards the nearest as it allows; or as given.
  bool part_of_the_way = true;
  std::optional<double> end_tolerance = 0;  ///< of each curve's minimum, as in CavOptions; with 0 a
                                            ///< curve at its own minimum scores 0 exactly
  double alpha_max = classa::kDefaultAlphaMax;
  std::vector<CurveCondition> conditions = {};  ///< per network curve; see conditions.h
  core::Progress progress = {};
};

/// One target that was found, SAV against departure at amount 1.
struct TradeOff {
  std::string name;
  double departure = 0;
  double sav = 0;
  /// Of several patches: by how much zebra stripes then turn at joints, in the mean (ZebraBreaks).
  std::optional<double> stripe_turn = {};
};

/// A target that was not found, or does not meet a condition: the curve it fails for, and why.
struct MissedTarget {
  std::string target;
  std::string curve;
  std::string why;
};

struct EditResult {
  BezierSurface surface;  ///< of lower degree than given where a bicubic target was taken whole
  SurfaceValue before;
  SurfaceValue after;
  double departure = 0;              ///< of `surface` from the given one, a bound: see departure.h
  double amount = 1;                 ///< as used: less than requested where the limit demands it
  std::string target;                ///< the trade-off that was taken
  std::vector<TradeOff> tradeoff;    ///< by growing departure
  std::vector<MissedTarget> missed;  ///< others
  /// Conditions that `surface` does not meet because it is only part of the way to the target,
  /// which does.
  std::vector<MissedTarget> unmet;
};

/// Editing of [Oya] §4.3: the surface whose network curves are Class A and of least energy.
///
/// Targets: "translational" (start kept), rows and columns translates of A1 and A5, both taken to
/// their minimum; "one matrix", the nearest net all of whose curves have one matrix each; from it
/// in steps to "least energy", in which every one stands at its own minimum (solve_one_matrix);
/// "rows" and "columns", those curves alone taken to their minimum between the ends that are kept
/// (with the other boundary curves, unless these are kept); "boundaries" (joints or corners
/// kept), the four boundary curves at their minimum and the inside blended from them; "one matrix
/// inside", the same with the inside solved so that its curves have one matrix each.
/// Where conditions leave none of these: "conditions", the nearest net in which the curves that
/// have conditions meet them; the others are free. From degree 5 on nets of one matrix
/// per curve do not exist for arbitrary corners; with these kept, the targets of the nearest
/// bicubic patch are added, "bicubic, …". Such a target, taken whole, comes with its own degrees
/// and network curves. The target of least SAV within the limit is taken, the nearer one of equals;
/// where none lies within the limit, the nearest of them as far as the limit allows
/// (part_of_the_way) if SAV does not rise on that part of its way, else the next one; the patch as
/// given where it rises towards all of them. What the limit allows is found to a thousandth: where
/// it ends the way sooner than `amount` does, the departure told is the limit to 0.6 %, as sharp as
/// its bound is (of a limit below 1e-12 of the way, 0). No target and no part of the way to one
/// turns the patch over (turn_over.h).
///
/// Conditions hold for every target (up to 1e-6) and set the minima the values are measured from;
/// a curve that has no minimum within its ranges is valued as without them.
///
/// Errors: as sav and validate(conditions); bad_input for amount outside [0, 1], a limit that is
/// negative or not finite, a row or column with an edge of no length; undrawable where no target
/// was found (within the limit, where the given patch does not meet the conditions), with the
/// curves and conditions that are in the way and the nearest that exists; cancelled.
core::Result<EditResult> edit(const BezierSurface& s, const EditOptions& options = {});

/// The result of an edit of `s` that was moved on to another net of the same degrees: value,
/// departure and unmet conditions are those of `moved`. Errors: as sav.
core::Result<void> move_edit(const BezierSurface& s, const BezierSurface& moved,
                             const EditOptions& options, EditResult& result);

}  // namespace keyline::surface
