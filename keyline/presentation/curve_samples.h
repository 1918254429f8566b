#pragma once

#include <vector>

#include "keyline/analysis/profile.h"
#include "keyline/analysis/split.h"
#include "keyline/document/planar_curve.h"
#include "keyline/fairing/fair.h"
#include "keyline/figure/curve_charts.h"

/// Curves as figures and diagrams need them: samples in order along their length.
namespace keyline::presentation::detail {

/// All members of the answer end to end; a joint at every piece's start, pieces named from 0, kept
/// parts of the given curve named "kept".
figure::SampledCurve faired_samples(const fairing::FairResult& result);

/// The splines through the points, each stretched to the length of the chain that replaces it and
/// put beside it, so that both can be compared at one arc length. Empty where there is no spline.
figure::SampledCurve spline_samples(const fairing::FairResult& result);

/// The part of sampled curvature between two arc lengths; fewer than two samples where there is
/// none.
analysis::CurvatureProfile profile_between(const figure::SampledCurve& curve, double from,
                                           double to);

/// Any path with joints at the ends of the analysed pieces, which are named from 0.
figure::SampledCurve path_samples(const document::Path& path,
                                  const std::vector<analysis::MonotonePiece>& pieces);

/// Points and their feet on the sampled curve, thinned to at most `most`: of every stretch of
/// neighbours the one farthest off. offsets as in FairResult.
figure::Overlay deviations(const std::vector<core::Point2>& points,
                           const std::vector<double>& offsets, const figure::SampledCurve& curve,
                           std::size_t most);

}  // namespace keyline::presentation::detail
