#pragma once

#include "keyline/core/pose.h"
#include "keyline/lac/chain/chain.h"

namespace keyline::fairing::detail {

/// What a chain's end is brought to.
struct Target {
  core::Pose2 pose;
  bool direction = false;  ///< also the direction, not the position alone
  bool start_direction_free = false;
  bool start_curvature_free = false;
  bool end_curvature_free = false;
};

/// Changes lengths and curvatures, each by as small a share of itself as will do, so that the
/// chain laid out from its start ends on the target: Newton's method with the least change. Slopes,
/// lines, arcs and the common curvature at the seam of a closed chain are kept; direction and
/// curvature at the start and curvature at the end unless the target frees them. For targets close
/// to the present end.
/// Returns how far the end is off afterwards (distance plus turning times the length).
double meet_target(lac::Chain& chain, const Target& target);

}  // namespace keyline::fairing::detail
