#pragma once

#include <optional>

#include "keyline/core/interval.h"
#include "keyline/lac/chain/chain.h"

/// Internals: compound rhythm in a plane between two directions, an inflection allowed.
namespace keyline::lac::detail::space {

struct PlaneRhythm {
  double alpha0 = -1, alpha1 = 1;
  double length_share = 0.5;  ///< of the whole length in the first piece
};

struct PlaneSearch {
  std::optional<Chain> found;  ///< chord of length 1 along x
  /// Start directions against the chord that curves of this turning without an inflection have;
  /// empty (low > high) where directions need an inflection.
  core::Interval without_inflection{1, -1};
  /// Whether any curve of the rhythm has an inflection: of one piece it takes a rate at the joint
  /// that the other may not bear.
  bool may_inflect = false;
  int iterations = 0;
};

/// Two pieces with curvature and its rate equal at the joint, that leave the start of a chord along
/// x at `from` and reach its end at `to`, radians in (-pi, pi], turning by to - from. Of several
/// the one that turns least, to either side. Everything but the size follows from the rate at the
/// joint relative to curvature there: without an inflection one equation, with one two for rate and
/// size, both looked for over all of them. The mirrored and the reversed problem get the same
/// curve. Ends are met to 1e-13. 5 to 20 ms.
PlaneSearch solve_compound_plane(double from, double to, const PlaneRhythm& rhythm);

}  // namespace keyline::lac::detail::space
