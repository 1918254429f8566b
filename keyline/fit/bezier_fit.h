#pragma once

#include <span>
#include <vector>

#include "keyline/core/error.h"
#include "keyline/core/point.h"
#include "keyline/curve/bezier.h"
#include "keyline/curve/concept.h"

namespace keyline::fit {

struct BezierFitOptions {
  double tolerance = 1e-3;  ///< largest distance of a sample from the curve, in the data's unit
  int lowest_degree = 3;    ///< >= 3
  int highest_degree = 8;   ///< <= 12
  int iterations = 30;      ///< of reparametrisation per degree
};

struct BezierFit {
  curve::Bezier2 curve;
  double deviation = 0;  ///< largest distance of a sample from its foot on the curve
  bool within = false;   ///< deviation <= tolerance; otherwise the best of all degrees tried
  std::vector<double> parameters;  ///< foot of each sample
};

/// Bézier curve of the lowest degree that stays within the tolerance of the samples, starting at
/// the first and ending at the last of them with the given unit tangents (in the direction of
/// travel). Feet and curve are found in turn ([Hoschek 1988]), with feet free to slide
/// (tangent distance minimisation), the lengths of the end handles kept positive.
///
/// bad_input: fewer than two samples, numbers not finite, equal ends of all samples, a zero
/// tangent, degrees out of range.
core::Result<BezierFit> fit_bezier(std::span<const core::Point2> samples,
                                   core::Vector2 start_tangent, core::Vector2 end_tangent,
                                   const BezierFitOptions& options = {});

/// The same for any planar curve with a speed at its ends, through samples even in its parameter;
/// the deviation is measured at them.
template <curve::PlanarCurve C>
core::Result<BezierFit> fit_bezier(const C& c, const BezierFitOptions& options = {},
                                   int samples = 200) {
  std::vector<core::Point2> points;
  for (int i = 0; i <= samples; ++i)
    points.push_back(evaluate(c, static_cast<double>(i) / samples));
  return fit_bezier(points, jet(c, 0.0).first, jet(c, 1.0).first, options);
}

}  // namespace keyline::fit
