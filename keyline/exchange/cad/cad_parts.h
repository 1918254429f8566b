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

/// Where a part starts and ends.
core::Point2 start_of(const CadPart& part);
core::Point2 end_of(const CadPart& part);

/// True for two or more parts each of which starts where the one before ends, to 1e-9 of their
/// size: they can be written as one thing.
bool is_chain(const CadParts& parts);

/// True where every part is straight or circular.
bool is_bulged(const CadParts& parts);

/// A chain as one spline without weights, a knot of multiplicity `degree` at every joint: arcs and
/// rational splines as cubics within `tolerance`, all else exactly. The deviation counts both that
/// and that of the parts. Precondition: is_chain().
struct ChainSpline {
  curve::BSpline2 curve;
  double deviation = 0;
};
ChainSpline chain_spline(const CadParts& parts, double tolerance);

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
