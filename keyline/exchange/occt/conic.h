#pragma once

#include <optional>

#include "keyline/core/point.h"

namespace keyline::exchange::occt {

/// a x^2 + b x y + c y^2 + d x + e y + f = 0.
struct Conic {
  double a = 0;
  double b = 0;
  double c = 0;
  double d = 0;
  double e = 0;
  double f = 0;
};

enum class ConicKind { ellipse, hyperbola, parabola };

/// A conic in a frame of its own: an ellipse about the origin, the longer axis along x; a hyperbola
/// about it, the branch at x > 0, or a parabola with its apex there, open to x > 0, both with an
/// arc towards greater y.
struct StandardConic {
  Conic conic;
  core::Vector2 x;  ///< the frame's axes, of length 1
  core::Vector2 y;
  core::Point2 origin;

  core::Point2 local(core::Point2 p) const {
    const core::Vector2 v = p - origin;
    return {v.x * x.x + v.y * x.y, v.x * y.x + v.y * y.y};
  }
};

/// The kind by b^2 - 4 a c, to rounding.
ConicKind kind_of(const Conic& conic);

/// Of an arc between two points; from the first on, an ellipse goes counter-clockwise. As a
/// parabola a conic is taken for the one next to it. Returns: empty for what is no curve of that
/// kind, as two lines are.
std::optional<StandardConic> standard_conic(const Conic& conic, ConicKind kind, core::Point2 first,
                                            core::Point2 last);

}  // namespace keyline::exchange::occt
