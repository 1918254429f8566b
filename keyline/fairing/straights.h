#pragma once

#include <vector>

#include "keyline/fairing/dense_curve.h"

namespace keyline::fairing::detail {

/// Nodes between which the points stand on a straight line.
struct Straight {
  int first = 0;
  int last = 0;
};

/// Stretches of a curve whose points cannot be told from points on a line with this noise, longest
/// first taken, none across another: the mean square of their distances from the line of least
/// squares is within two standard errors of the noise's. Not those that any curve has about an
/// inflection: bent like the curve a quarter of its length beyond its ends, or as much as it turns
/// by on the way there, a stretch would have to bow by sixty times the noise. (Curvature that grows
/// evenly through zero passes as a line up to a bow of twenty.) An open curve may be straight as a
/// whole.
///
/// points: in order along the curve, feet in curve.feet; noise in their unit, above 0.
std::vector<Straight> straight_stretches(const DenseCurve& curve,
                                         const std::vector<FitPoint>& points, double noise);

/// The curve with lines there, a share of each left at its ends for the bend to grow in; the rest
/// free.
DenseCurve with_lines(const DenseCurve& curve, const std::vector<Straight>& lines, double share);

}  // namespace keyline::fairing::detail
