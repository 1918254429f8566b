#pragma once

#include <optional>
#include <string>
#include <vector>

#include "keyline/classa/minimum_energy.h"
#include "keyline/surface/conditions.h"

/// Internals of room surface: one network curve and the curve of least energy in its place.
namespace keyline::surface::detail {

using Curve = std::vector<core::Point3>;

/// A curve with what is asked of it. `from_end`: its edges are to grow towards its first point, so
/// that its last point and the tangent there are what its minimum starts from.
struct CurveTask {
  Curve control;
  bool from_end = false;
  CurveCondition condition = {};
  std::optional<double> end_tolerance = 0;  ///< where the condition has none
  double alpha_max = classa::kDefaultAlphaMax;
};

/// Least-energy problem of a curve with these ends and this start tangent, under its condition.
core::Result<classa::EnergyMinimum> minimum_of(const CurveTask& task);

/// The same with the ranges widened by as little as it takes to find one.
std::optional<classa::EnergyMinimum> nearest_minimum(const CurveTask& task);

/// The curve of least energy from the first point along its tangent to the last; empty where there
/// is none.
Curve least_energy_curve(const CurveTask& task);

/// Why there is none, with the nearest that exists.
std::string why_no_minimum(const CurveTask& task);

}  // namespace keyline::surface::detail
