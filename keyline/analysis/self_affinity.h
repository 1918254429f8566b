#pragma once

#include <optional>

#include "keyline/analysis/profile.h"

namespace keyline::analysis {

/// How far a piece is from being self-affine ([Fairing] Fig. 7: what remains of the curve when its
/// beginning is cut off corresponds to the parent curve).
///
/// The piece is read along growing radius and its first half cut off. Length and radius of the rest
/// are scaled, each by a factor of its own, until it lies best on the parent; deviation is the root
/// mean square of what remains between their log radii. Log-aesthetic curves have 0: their gradient
/// is constant, and no other curve has that for every cut. The scale of `length` and of `radius`
/// map the rest onto the parent.
struct SelfAffinity {
  double deviation = 0;
  double length_scale = 1;
  double radius_scale = 1;
};

/// Of a piece of monotone curvature that keeps its sign; the profile must be complete. Size, pose
/// and direction change nothing but rounding. Samples where the radius is infinite are left out.
/// Empty where the radius does not change (straight, arc) or fewer than 8 samples remain.
std::optional<SelfAffinity> self_affinity(const CurvatureProfile& piece);

}  // namespace keyline::analysis
