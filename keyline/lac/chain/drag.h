#pragma once

#include <cstddef>

#include "keyline/core/error.h"
#include "keyline/lac/chain/chain.h"

/// Editing a chain by dragging one of its points while the slopes stay.
namespace keyline::lac {

struct DragOptions {
  bool hold_end_curvatures = false;  ///< as well as the poses of both ends
};

struct DragSolution {
  Chain chain;            ///< has a joint at the dragged point, and pieces of the slopes it had
  std::size_t joint = 0;  ///< which: the start of this piece (pieces.size(): the end)
  double change = 0;      ///< root of the sum of squares of what changed, see drag
  int iterations = 0;
};

/// The chain with the point at parameter t moved to target. Both end poses are held (of an end that
/// is dragged itself, only the direction); curvature stays continuous where it was, and a closed
/// chain stays closed, its pose at the start held. Of all such chains the one whose joint
/// curvatures (times the mean length of the pieces; where a neighbour has alpha >= 0, in their
/// logarithms) and logarithms of lengths change least in the sum of squares.
///
/// Accuracy: 1e-12 of the chain's length, 1e-12 rad.
/// Fails: bad_input; undrawable where there are not enough pieces for what is held; not_converged
/// with the share of the way that could be gone in the hint.
core::Result<DragSolution> drag(const Chain& chain, double t, core::Point2 target,
                                const DragOptions& options = {});

}  // namespace keyline::lac
