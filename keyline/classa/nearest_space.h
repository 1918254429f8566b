#pragma once

#include <optional>

#include "keyline/classa/cav.h"
#include "keyline/classa/nearest.h"
#include "keyline/curve/bezier.h"

namespace keyline::classa {

/// A planar curve with one matrix that stands for a curve in space without.
struct NearestSpaceCurve {
  NearestCurve flat;     ///< laid into its plane, its start at the origin
  curve::Bezier3 curve;  ///< where it lies in space
  double distance = 0;   ///< largest distance between the two curves, either way, at samples
};

/// In the plane through the ends that is nearest to the control points (least squares), the curve
/// with one matrix nearest to the given one as seen along the normal of that plane. Empty for a
/// curve of degree 1, without length, or whose ends coincide.
std::optional<NearestSpaceCurve> nearest_matrix_curve(const curve::Bezier3& given,
                                                      const NearestOptions& options = {});

/// The nearest curve and its value, with conditions of its own, after the same options.
struct NearestValue {
  NearestSpaceCurve nearest;
  std::optional<CurveValue> value;  ///< empty where it has none
};
std::optional<NearestValue> nearest_value(const curve::Bezier3& given, const CavOptions& options);

}  // namespace keyline::classa
