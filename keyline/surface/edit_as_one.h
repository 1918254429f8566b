#pragma once

#include "keyline/surface/edit_patches.h"

/// Internals of room surface: several patches edited as one problem.
namespace keyline::surface::detail {

struct AsOneTask {
  std::span<const BezierSurface> given;
  const EditOptions& options;
  int threads = 1;
  const EdgeTolerance& tolerance;
  HoldJoints hold = HoldJoints::zebra;
};

/// edit() for every patch, each for itself.
std::vector<PatchEdit> edit_each(std::span<const BezierSurface> patches, const EditOptions& options,
                                 int threads);

/// `all` has patches edited each for itself and the joints; it gets the patches edited with their
/// joints held.
void edit_as_one(const AsOneTask& task, PatchesEdit& all);

}  // namespace keyline::surface::detail
