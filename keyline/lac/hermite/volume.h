#pragma once

#include "keyline/core/error.h"
#include "keyline/core/pose.h"
#include "keyline/lac/chain/chain.h"
#include "keyline/lac/hermite/clamped.h"
#include "keyline/lac/hermite/compound.h"
#include "keyline/lac/hermite/hermite.h"

/// A curve by its volume, the area between it and its chord ([Fairing] §2.2 and step 5).
namespace keyline::lac {

/// Signed area between a segment and its chord: positive for a curve that turns left, as
/// analysis::signed_volume. Accuracy 1e-12 of the larger of the area and its square length / 100.
double chord_area(const Segment& segment);
double chord_area(const Chain& chain);

/// Volumes that can be reached with given ends, direction and slope.
struct VolumeRange {
  double smallest = 0;
  double largest = 0;  ///< may be infinite in principle; then the largest found, up to a turning at
                       ///< the end just short of pi from the chord
};

struct VolumeSolution {
  G1Chain solution;
  double volume = 0;
  VolumeRange reachable;
};

/// The segment of slope alpha from start to end that leaves along start.direction and has the given
/// area (0 or more) over its chord; it lies on one side of it, the side the direction points to.
/// The area grows with the end direction's angle from the chord, so there is one or none; for
/// alpha < 0 it may inflect where no other curve reaches as far.
///
/// Accuracy: area 1e-11 relative, ends as solve_g1_directions_chain, whose two pieces it has where
/// one's curvatures would leave the doubles.
/// Fails: bad_input (not finite, start = end, volume negative); undrawable, with the nearest
/// volumes that can be reached in the hint. A direction along the chord has volume 0 only.
core::Result<VolumeSolution> solve_volume(const core::Pose2& start, core::Point2 end, double alpha,
                                          double volume);

struct CompoundVolumeSolution {
  CompoundSolution solution;
  double volume = 0;
  VolumeRange reachable;
};

/// The same with a compound rhythm, so that each of the five types of [Fairing] 2.2 has any volume
/// that it reaches: C-shaped, turning by less than pi in all, which bounds the reachable volumes.
/// Fails as above, and as solve_compound for a bad rhythm.
core::Result<CompoundVolumeSolution> solve_volume(const core::Pose2& start, core::Point2 end,
                                                  const CompoundRhythm& rhythm, double volume);

}  // namespace keyline::lac
