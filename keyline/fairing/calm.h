#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "keyline/fairing/least_variation.h"

namespace keyline::fairing::detail {

/// What a wave less may cost, times the energy: waves come first.
inline constexpr double kWaveWorth = 2;

struct CalmOptions {
  BandOptions band;
  double most_rms = HUGE_VAL;  ///< a wave stays where the offsets without it are larger
  /// No more turns than these, whatever the offsets and the energy, as long as the tolerance holds.
  std::optional<int> most_turns = {};
  double worth = 1.5;  ///< a wave stays where the energy without it is more than so many times
  /// Bends to the other side stay where the energy without them all is more than so many times.
  double bend_worth = 1;
  int threads = 1;  ///< that single waves are tried on; the answer does not depend on it
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
/// by `worth`. Then bends to the other side (counter_bends.h), in the same way: the sum of squares
/// may rise by sixteen times the mean one for all of them, four standard errors of one number, or
/// to `most_rms`.
Calmed calm(DenseCurve& curve, const std::vector<FitPoint>& points, const CalmOptions& options);

/// The calm curve for points that pull otherwise, with the turns it has and springs of that weight.
BandReport calm_again(DenseCurve& curve, const std::vector<FitPoint>& points, double spring,
                      const CalmOptions& options);

}  // namespace keyline::fairing::detail
