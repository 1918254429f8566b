#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "keyline/fairing/dense_curve.h"

/// Where a curve's curvature turns, and how large the swings between its turns are.
namespace keyline::fairing::detail {

/// Nodes of the curve where curvature turns, alternately highest and lowest, every swing between
/// neighbours (and to the ends of an open curve) at least `least`.
std::vector<int> extrema_of(const DenseCurve& curve, double least);

/// The same where a thousandth of the curvature's range counts as a swing: its turns.
std::vector<int> turns_of(const DenseCurve& curve);

/// The same where a swing is seen in a comb (analysis::kSeenWave).
std::vector<int> seen_turns_of(const DenseCurve& curve);

/// Waves that are seen in the curve's comb (see analysis::comb_figures).
int seen_waves(const DenseCurve& curve);

/// A swing of curvature that may go: which extrema bound it.
struct Removal {
  /// How far the curve departs sideways where the curvature that runs on without the swing is the
  /// nearest one (mean squares over arc length) and all else stays. Of a sine: its amplitude.
  double sideways = HUGE_VAL;
  double share = 0;  ///< of the length
  std::size_t first = 0;
  std::size_t count = 0;                              ///< 1 at an end, else 2
  std::size_t points = static_cast<std::size_t>(-1);  ///< whose feet lie on it
};

/// The swings between neighbouring extrema and, of an open curve, from its ends to the next one;
/// least sideways first.
std::vector<Removal> removals(const DenseCurve& curve, const std::vector<int>& extrema);

/// The extrema without those that bound any of these swings.
std::vector<int> without(const std::vector<int>& extrema, const std::vector<Removal>& gone);

/// Senses of the cells for extrema at these nodes, alternately as the curve has them.
void set_senses(DenseCurve& curve, const std::vector<int>& extrema);

/// Extrema of a solved curve moved on: where curvature is kept from running on beyond one, it is
/// level on that side alone (its rate below a hundredth of its range over the length), and the
/// extremum belongs to the other end of what is level, short of the next one.
std::vector<int> moved_on(const DenseCurve& curve, const std::vector<int>& extrema);

}  // namespace keyline::fairing::detail
