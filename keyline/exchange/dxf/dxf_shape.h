#pragma once

#include <variant>
#include <vector>

#include "keyline/core/error.h"
#include "keyline/curve/bezier.h"
#include "keyline/curve/bspline.h"
#include "keyline/curve/polyline.h"
#include "keyline/document/document.h"
#include "keyline/exchange/dxf/affine3.h"

namespace keyline::exchange::detail {

/// Part of an ellipse: center + cos(t) major + sin(t) minor for t from `from` to `to`.
struct EllipseArc {
  core::Point3 center;
  core::Vector3 major;
  core::Vector3 minor;
  double from = 0;
  double to = 0;
};

/// Geometry of one DXF entity. Béziers are end to end.
using DxfShape =
    std::variant<curve::Polyline3, EllipseArc, std::vector<curve::Bezier3>, curve::BSpline3>;

DxfShape mapped(const DxfShape& shape, const Affine3& map);
std::size_t point_count(const DxfShape& shape);
bool is_finite(const DxfShape& shape);

/// The shape as a planar path where it lies in z = 0 (to 1e-12 of its size), else as one space
/// curve. A circular arc in the plane becomes one log-aesthetic piece; other ellipses rational
/// quadratics of at most a quarter turn each.
/// Fails: where the curve is not valid (validate()), for example of a size no double divides by.
core::Result<void> add_shape(document::Document& document, const DxfShape& shape, bool closed,
                             document::Label label);

/// Frame of an entity's own coordinates, given the extrusion direction (AutoCAD's arbitrary axis
/// algorithm); the identity for (0, 0, 1) and where the direction is none.
Affine3 extrusion_frame(core::Vector3 direction);

/// A vertex of a polyline and the bulge of the edge behind it: tan(turn / 4).
struct BulgeVertex {
  core::Point3 point;
  double bulge = 0;
};
/// Straight and circular edges as rational quadratics of at most a quarter turn; a Polyline3 where
/// no edge is bent. Repeated points are dropped.
DxfShape polyline_shape(const std::vector<BulgeVertex>& vertices, bool closed);

/// The cubic spline with continuous second derivative through points, parameter by chord length
/// (AutoCAD's own for fit points); end tangents as given (directions), natural where zero;
/// periodic where closed. Precondition: two or more points, no two neighbours equal.
std::vector<curve::Bezier3> fit_point_spline(std::vector<core::Point3> points, core::Vector3 start,
                                             core::Vector3 end, bool closed);

}  // namespace keyline::exchange::detail
