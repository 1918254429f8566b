#pragma once

#include <variant>
#include <vector>

#include "keyline/core/error.h"
#include "keyline/document/arc.h"
#include "keyline/document/planar_curve.h"

namespace keyline::exchange {

struct CadLine {
  core::Point2 from;
  core::Point2 to;
};

/// The curves CAD systems know. Polylines have two or more different points.
using CadPart = std::variant<CadLine, document::Arc, curve::Polyline2, curve::BSpline2>;

struct CadParts {
  std::vector<CadPart> parts;  ///< in the order of the path
  double deviation = 0;        ///< bound of the distance from it
};

/// A path as CAD curves, as few as possible: lines, arcs, polylines and splines exactly (Béziers
/// that go on smoothly as one spline), log-aesthetic curves that are neither line nor arc as cubic
/// splines within `tolerance` (lac::to_bspline). Corners part.
/// Fails: as lac::to_bspline does.
core::Result<CadParts> cad_parts(const document::Path& path, double tolerance);

/// A run of straight and circular edges; bulge is tan(turn / 4) of the edge behind its vertex.
struct BulgedPolyline {
  struct Vertex {
    core::Point2 point;
    double bulge = 0;
  };
  std::vector<Vertex> vertices;
  bool closed = false;
  double deviation = 0;
};

/// The same parts as one polyline within `tolerance`; arcs stay exact. The bound for cubic
/// stretches is h^2 / 8 times their largest second derivative.
BulgedPolyline bulged_polyline(const CadParts& parts, bool closed, double tolerance);

}  // namespace keyline::exchange
