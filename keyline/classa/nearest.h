#pragma once

#include <optional>

#include "keyline/classa/control_matrix.h"
#include "keyline/core/interval.h"
#include "keyline/curve/bezier.h"

namespace keyline::classa {

struct NearestOptions {
  double alpha_max = 1.0982;       ///< radians, in (0, pi/2)
  core::Interval s = {0.01, 100};  ///< holds 1
};

/// A curve with one matrix that stands for one without.
struct NearestCurve {
  ControlMatrix matrix;  ///< alpha positive to the left
  curve::Bezier2 curve;  ///< same degree and ends as the given one
  double distance = 0;   ///< largest distance between the two curves, either way, at samples
  double rms = 0;        ///< of the distances of the given curve's samples: what is least
};

/// The curve with one matrix that has the ends of the given one and lies nearest to it: least sum
/// of squared distances of 65 points even in its arc length, by Levenberg-Marquardt from the best
/// places of a grid over the plane. The tangents at the ends are free, so that turning the curve
/// round changes nothing. Empty for a curve of degree 1, without length, or whose ends coincide.
std::optional<NearestCurve> nearest_matrix_curve(const curve::Bezier2& given,
                                                 const NearestOptions& options = {});

}  // namespace keyline::classa
