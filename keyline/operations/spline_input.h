#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "keyline/core/error.h"
#include "keyline/curve/bspline.h"

namespace keyline::operations {

/// Any curve value of the public interface as one B-spline in space.
struct SplineInput {
  curve::BSpline3 curve;
  double deviation = 0;  ///< bound of the distance from the given curve; 0: exact
  bool planar = true;    ///< all z are 0
};

/// Polylines, Béziers and B-splines exactly, with points [x, y] or [x, y, z]; log-aesthetic curves,
/// in the plane or in space, within `tolerance` (> 0); a path as its members end to end.
/// Errors name the place in the value.
core::Result<SplineInput> spline_from_json(const nlohmann::json& j, const std::string& where,
                                           double tolerance);

/// A size to measure tolerances by: largest difference of two coordinates in the value's points,
/// or the length of a log-aesthetic curve. 1 where there is none.
double size_of_curve_json(const nlohmann::json& j);

}  // namespace keyline::operations
