#pragma once

#include <cstddef>
#include <vector>

#include "keyline/core/describe.h"
#include "keyline/curve/piecewise_bezier.h"
#include "keyline/fit/curvature_drive.h"

namespace keyline::fit {

/// The chain's curvature after a low-pass filter along the arc length ([Sketch] section 7, step 5).
///
/// cutoff: wavelength that is halved, in the curve's unit; 0: automatic, twice the mean length of a
///         piece (what is shorter comes from the joints, not from the hand), at most the whole.
/// Ends of open chains keep their curvature's trend. Throws InvalidInput for an empty chain.
std::vector<CurvatureTarget> smooth_target(const curve::PiecewiseBezier& chain, bool closed,
                                           double cutoff = 0);

/// The rhythm a target is to have: the curve's own, or one of the three of one slope ([Fairing]
/// Fig. 8), whatever the curve has.
enum class WantedRhythm { own, accelerating, stable, decelerating };
constexpr auto choices(const WantedRhythm*) {
  return core::words<WantedRhythm>({{WantedRhythm::own, "own"},
                                    {WantedRhythm::accelerating, "accelerating"},
                                    {WantedRhythm::stable, "stable"},
                                    {WantedRhythm::decelerating, "decelerating"}});
}

struct RhythmTarget {
  std::vector<CurvatureTarget> places;
  /// Stretches that start or end straight, where no slope but a negative one can: they keep
  /// the best of those where stable or decelerating is wanted.
  std::size_t straight_ended = 0;
};

/// The curvature of the log-aesthetic curve that has the chain's rhythm: between the extrema and
/// inflections of the smoothed curvature every stretch follows a power mean (papers' general
/// formula, κ = M_{-α} in arc length) with the slope α that fits it best of those `wanted` allows:
/// accelerating at most -0.5, stable 0, decelerating at least 0.5 (halfway to the clothoid's and
/// the logarithmic spiral's); κ is continuous. An answer to what [Sketch] section 8 left open.
/// Throws InvalidInput for an empty chain.
RhythmTarget rhythm_target(const curve::PiecewiseBezier& chain, bool closed,
                           WantedRhythm wanted = WantedRhythm::own);

}  // namespace keyline::fit
