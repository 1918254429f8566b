#pragma once

#include <array>

#include "keyline/core/describe.h"

/// What the operations from three handles share.
namespace keyline::operations {

using Handles = std::array<core::Point2, 3>;
inline constexpr const char* kHandles = "P0, P1, P2: ends P0 and P2, tangents along P0P1 and P1P2";
inline constexpr const char* kSlope = "slope of the logarithmic curvature graph; any number";

/// How a curve solves the triangle of its handles.
struct HandlesSolution {
  double theta = 0;
  double chord_angle = 0;
  bool reversed = false;
  static constexpr auto describe() {
    return core::fields(
        core::field<&HandlesSolution::theta>("the turning from P0P1 to P1P2, signed").in("radian"),
        core::field<&HandlesSolution::chord_angle>("from the start tangent to the chord")
            .in("radian"),
        core::field<&HandlesSolution::reversed>("whether the radius falls from P0 to P2"));
  }
};

}  // namespace keyline::operations
