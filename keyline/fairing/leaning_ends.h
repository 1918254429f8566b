#pragma once

#include <vector>

#include "keyline/fairing/dense_curve.h"
#include "keyline/fairing/residuals.h"

namespace keyline::fairing::detail {

/// A curve of least variation has no rate of curvature at a free end, asked for or not, and where
/// the shape has one it leans to one side of the last points: more in the mean over them than their
/// errors explain. The points of each free end that it leans from pull twice as much afterwards.
/// Returns whether there are any; none on a closed curve, none where the tolerance alone counts
/// (residuals.rms is 0).
///
/// Leaning: of the 1, 2, 4, … points next to the end, to half of all, the sum of the offsets over
/// the root of their number exceeds what the largest of all points' errors may be (noise_factor),
/// and what the tolerance leaves each of them beyond errors. White noise does so at one end in a
/// thousand.
///
/// Source: the multiresolution criterion of [Davies 2001] on windows that begin at the end, met by
///         weights that grow where it is not (as for weighted splines there).
bool pull_leaning_ends(std::vector<FitPoint>& points, DenseCurve curve, const Residuals& residuals);

}  // namespace keyline::fairing::detail
