#pragma once

#include <optional>
#include <span>
#include <vector>

#include "keyline/surface/edit.h"
#include "keyline/surface/joints.h"

namespace keyline::surface {

/// What became of one patch of several: an edit, or why there is none and it stays as given.
struct PatchEdit {
  std::optional<EditResult> result;
  core::Failure why = {};
};

/// What of the joints stays: nothing but what Keep says; the tangent planes of joints that have one
/// in common; their curvature too, where that is in common; and that, and no stripe of a zebra
/// turns farther at any joint than it did, whatever of its curvature is in common.
enum class HoldJoints { free, g1, g2, zebra };

/// Order of joints that counts as lost where it is lower after an edit; of joints let go 0, that
/// their edges meet.
int order_of(HoldJoints hold);

/// Several patches edited as one problem, and what that does to their joints.
struct PatchesEdit {
  std::vector<PatchEdit> patches;       ///< in the order given
  std::vector<BezierSurface> surfaces;  ///< of all patches, edited or as given
  std::vector<PatchJoint> joints;       ///< of the patches as given
  JointSummary before;
  JointSummary after;
  std::size_t lost = 0;    ///< joints whose order is lower now, of orders up to order_of(hold)
  std::size_t folded = 0;  ///< patches whose normal turns over (turn_over.h)
  std::size_t turned = 0;  ///< joints at which a zebra turns farther (turned_farther)
  double fold_growth = 0;  ///< largest, of joints that meet before and after, radians
  double departure = 0;    ///< largest of all
  double sav_apart = 0;  ///< sum over the patches each edited for itself: what holding joints costs
  double sav_before = 0;                ///< sum over the patches as given
  double sav_after = 0;                 ///< … as edited
  std::vector<TradeOff> tradeoff = {};  ///< with joints held: nets that were found, by departure
};

/// edit() for every patch, shared among threads (<= 0: all of the machine's; the result does not
/// depend on how many), then the nearest nets to all of these that hold the joints (hold_joints),
/// and again from there, as long as the sum of SAV falls; of the way there as much as leaves the
/// least SAV within the limit. Beside that nets are looked for in which as many curves as can be
/// have one matrix each while all joints hold (`tradeoff`; not where single curves have
/// conditions); with Keep::joints corners in which patches meet may move with them there. The least
/// SAV within the limit is taken. Where a joint could not be held otherwise it stays where it is,
/// and so does a patch that would turn over (turn_over.h); nets in which a joint is of lower order
/// or a fold sharper all the same, by more than tolerance.angle, or (HoldJoints::zebra) a zebra
/// turns farther, are not taken. Patches of which
/// the SAV cannot be lowered that way may rise for the others' sake. HoldJoints::free: patches do
/// not know of one another: with Keep::boundary joints stay where they are to the last digit, with
/// Keep::joints they move and stay closed (unless conditions of single curves say otherwise), with
/// less kept they may open; tangent planes across them change. Keep::start keeps the corner b00 of
/// every patch, its tangents as far as the joints let it. `before` and `after` say by how much.
/// Joints are edges that lie within ten times the gap of one another, which unless set is a share
/// of the size of all patches (joints.h). Errors: the first patch's where no patch could be edited;
/// unsupported for a rational patch; cancelled.
core::Result<PatchesEdit> edit_patches(std::span<const BezierSurface> patches,
                                       const EditOptions& options = {}, int threads = 1,
                                       const EdgeTolerance& tolerance = {},
                                       HoldJoints hold = HoldJoints::zebra);

/// A surface with its Bézier patches edited.
struct SurfaceEdit {
  PatchGrid grid;      ///< of the surface as given
  PatchesEdit edited;  ///< patches in the order of the grid
  /// The edited surface as one of the kind it was; empty where its patches no longer meet.
  std::optional<Surface> whole;
};

/// edit_patches() of the surface's patches; several come back as one B-spline surface with inner
/// knots of full multiplicity where their edges still coincide (to 1e-9 of its size).
core::Result<SurfaceEdit> edit_surface(const Surface& s, const EditOptions& options = {},
                                       int threads = 1, const EdgeTolerance& tolerance = {},
                                       HoldJoints hold = HoldJoints::zebra);

/// edit_patches() of all patches of several surfaces, joints between them included.
/// Patches of rational surfaces stay where they are. The PatchesEdit of each has its own patches
/// alone, `sav_apart` of it is not known and stands at what is reached; `together` (where given)
/// gets that of all.
core::Result<std::vector<SurfaceEdit>> edit_surfaces(std::span<const Surface> surfaces,
                                                     const EditOptions& options = {},
                                                     int threads = 1,
                                                     const EdgeTolerance& tolerance = {},
                                                     HoldJoints hold = HoldJoints::zebra,
                                                     PatchesEdit* together = nullptr);

/// SAV of every patch before the edit, and after.
std::vector<PatchValue> values_before(const SurfaceEdit& edit);
std::vector<PatchValue> values_after(const SurfaceEdit& edit);

}  // namespace keyline::surface
