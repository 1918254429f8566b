#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "keyline/fairing/least_variation.h"

namespace keyline::fairing::detail {

/// Nodes of the curve where curvature turns, alternately highest and lowest, every swing between
/// neighbours (and to the ends of an open curve) at least `least`.
std::vector<int> extrema_of(const DenseCurve& curve, double least);

/// The same where a thousandth of the curvature's range counts as a swing: its turns.
std::vector<int> turns_of(const DenseCurve& curve);

/// Extrema of a solved curve moved on: where curvature is kept from running on beyond one, it is
/// level on that side alone (its rate below a hundredth of its range over the length), and the
/// extremum belongs to the other end of what is level, short of the next one.
std::vector<int> moved_on(const DenseCurve& curve, const std::vector<int>& extrema);

/// Waves that are seen in the curve's comb (see analysis::comb_figures).
int seen_waves(const DenseCurve& curve);

/// What a wave less may cost, times the energy: waves come first.
inline constexpr double kWaveWorth = 2;

struct CalmOptions {
  BandOptions band;
  double most_rms = HUGE_VAL;  ///< a wave stays where the offsets without it are larger
  /// No more turns than these, whatever the offsets and the energy, as long as the tolerance holds.
  std::optional<int> most_turns = {};
  double worth = 1.5;  ///< a wave stays where the energy without it is more than so many times
  int threads = 1;     ///< that single waves are tried on; the answer does not depend on it
};

/// Waves that a curve is left with.
struct WavesLeft {
  int turns = 0;         ///< of its curvature
  bool untried = false;  ///< some were not tried to be taken out, there were too many
};

struct Calmed {
  BandReport band;
  WavesLeft waves;
};

/// Takes waves of curvature out of the curve of least variation, lowest first, each by solving
/// again without it, as long as the points stay within the tolerance and the energy does not rise
/// by `worth`.
Calmed calm(DenseCurve& curve, const std::vector<FitPoint>& points, const CalmOptions& options);

/// The calm curve for points that pull otherwise, with the turns it has and springs of that weight.
BandReport calm_again(DenseCurve& curve, const std::vector<FitPoint>& points, double spring,
                      const CalmOptions& options);

}  // namespace keyline::fairing::detail
