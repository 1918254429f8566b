#pragma once

#include <optional>

#include "keyline/core/interval.h"
#include "keyline/lac/chain/chain.h"
#include "keyline/lac/space/compound_family.h"

/// Internals: compound rhythm in a plane between two directions, an inflection allowed.
namespace keyline::lac::detail::space {

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
/// the one that turns least, to either side. The rate at the joint relative to curvature there
/// decides the shape, the turning then the size; what is left is one equation, that of the start's
/// direction, whose roots are looked for along all rates. Where the curve turns as much to either
/// side as to the other any size turns alike: there the size leads and the rate follows. The
/// mirrored and the reversed problem get the same curve. Ends are met to 1e-13. About 1 ms.
PlaneSearch solve_compound_plane(double from, double to, const PlaneRhythm& rhythm);

}  // namespace keyline::lac::detail::space
