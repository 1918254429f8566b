#pragma once

#include <array>
#include <optional>
#include <vector>

#include "keyline/core/error.h"
#include "keyline/surface/bezier_surface.h"
#include "keyline/surface/jet.h"
#include "keyline/surface/net.h"

namespace keyline::surface {

/// Tensor product B-spline surface, rational (NURBS) where weights are given. Index 0 of degree
/// and knots belongs to u (rows of the net), index 1 to v. Knot vectors are full, clamped or not,
/// as in curve::BSpline: net.rows + degree[0] + 1 and net.columns + degree[1] + 1 knots.
///
/// Functions take u, v in [0, 1], mapped linearly to the knot domains, and derivatives are by
/// them; at a knot they take the side of growing u and v. They require a surface that is valid in
/// the sense of validate(): the counts are checked (InvalidInput is thrown), the numbers are not.
struct BSplineSurface {
  std::array<int, 2> degree{3, 3};
  std::array<std::vector<double>, 2> knots;
  Net net;
  std::vector<double> weights;  ///< in the order of net.points, or empty: polynomial
  friend bool operator==(const BSplineSurface&, const BSplineSurface&) = default;
};

inline bool is_rational(const BSplineSurface& s) { return !s.weights.empty(); }

/// What validate(Net) asks, and of degrees and knots what curve::validate asks of a B-spline
/// curve, with paths such as "degree[1]" or "knots[0][3]".
core::Result<void> validate(const BSplineSurface& s);

/// u and v are clamped to [0, 1].
core::Point3 evaluate(const BSplineSurface& s, double u, double v);
SurfaceJet jet(const BSplineSurface& s, double u, double v);

/// The distinct knots of the domain, as u or v in [0, 1].
std::vector<double> breakpoints_u(const BSplineSurface& s);
std::vector<double> breakpoints_v(const BSplineSurface& s);

/// The same surface with its degrees raised.
BSplineSurface elevate_degree(const BSplineSurface& s, int by_u, int by_v);

/// S(u, v) with u and v exchanged.
BSplineSurface transposed(const BSplineSurface& s);

/// Bézier patches of the same degrees, one for each pair of non-empty knot spans.
struct PatchGrid {
  int rows = 0;                        ///< spans in u
  int columns = 0;                     ///< spans in v
  std::vector<BezierSurface> patches;  ///< row after row
};
PatchGrid to_beziers(const BSplineSurface& s);

/// The patches of a grid as one B-spline surface over these breakpoints, every inner one a knot of
/// full multiplicity (as many as the degree). Empty where edges of neighbours differ by more than
/// `gap` in a control point, degrees differ, a patch is rational, or the breakpoints are not those
/// of the grid, growing from 0 to 1.
std::optional<BSplineSurface> joined(const PatchGrid& grid, const std::vector<double>& u,
                                     const std::vector<double>& v, double gap);

/// The same surface as a B-spline without inner knots.
BSplineSurface to_bspline(const BezierSurface& s);

}  // namespace keyline::surface
