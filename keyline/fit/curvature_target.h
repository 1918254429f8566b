#pragma once

#include <vector>

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

/// The curvature of the log-aesthetic curve that has the chain's rhythm: between the extrema and
/// inflections of the smoothed curvature every stretch follows a power mean (papers' general
/// formula, κ = M_{-α} in arc length) with the slope α that fits it best; κ is continuous.
/// An answer to what [Sketch] section 8 left open.
std::vector<CurvatureTarget> rhythm_target(const curve::PiecewiseBezier& chain, bool closed);

}  // namespace keyline::fit
