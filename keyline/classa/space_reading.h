#pragma once

#include <vector>

#include "keyline/classa/cav.h"
#include "keyline/core/point.h"

namespace keyline::classa::detail {

/// A curve that lies in no plane, with the conditions of its minimum: those of a plane curve, in
/// the plane that its start tangent and its chord span. Torsion costs energy and meets no condition
/// of [Oya] 3.2, so that the curve of least energy with this start, tangent and end lies there.
struct SpaceReading {
  std::vector<core::Point3> control;  ///< in the direction it is read in
  bool reversed = false;
  EnergyConditions conditions;  ///< x along the start tangent, the chord to the left of it
  core::Vector3 x = {1, 0, 0};
  core::Vector3 y = {0, 1, 0};

  /// A point of the plane, the start at its origin.
  core::Point3 lifted(core::Point2 p) const { return control.front() + (p.x * x + p.y * y); }
};

/// Preconditions: at least two control points, not all of them one.
SpaceReading read_in_space(std::vector<core::Point3> control, const CavOptions& options);

}  // namespace keyline::classa::detail
