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

/// Several patches edited one by one, and what that does to their joints.
struct PatchesEdit {
  std::vector<PatchEdit> patches;       ///< in the order given
  std::vector<BezierSurface> surfaces;  ///< of all patches, edited or as given
  std::vector<PatchJoint> joints;       ///< of the patches as given
  JointSummary before;
  JointSummary after;
  double departure = 0;  ///< largest of all
};

/// edit() for every patch, shared among threads (<= 0: all of the machine's; the result does not
/// depend on how many). Patches do not know of one another: with Keep::boundary joints stay
/// where they are to the last digit, with Keep::joints they move and stay closed (unless conditions
/// of single curves say otherwise), with less kept they may open; tangent planes across them change
/// in all cases. `before` and `after` say by how much. Joints are edges that lie within ten times
/// tolerance.gap of one another. Errors: the first patch's where no patch could be edited;
/// unsupported for a rational patch; cancelled.
core::Result<PatchesEdit> edit_patches(std::span<const BezierSurface> patches,
                                       const EditOptions& options = {}, int threads = 1,
                                       const EdgeTolerance& tolerance = {});

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
                                       int threads = 1, const EdgeTolerance& tolerance = {});

/// SAV of every patch before the edit, and after.
std::vector<PatchValue> values_before(const SurfaceEdit& edit);
std::vector<PatchValue> values_after(const SurfaceEdit& edit);

}  // namespace keyline::surface
