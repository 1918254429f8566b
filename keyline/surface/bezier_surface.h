#pragma once

#include <vector>

#include "keyline/core/error.h"
#include "keyline/curve/bezier.h"
#include "keyline/surface/jet.h"
#include "keyline/surface/net.h"

namespace keyline::surface {

/// Tensor product Bézier patch of degrees (net.rows - 1, net.columns - 1) over [0, 1] x [0, 1],
/// rational where weights are given: S(u, v) = sum B_i(u) B_j(v) net.at(i, j).
///
/// Functions that take a surface require it to be valid in the sense of validate(): the counts
/// are checked (InvalidInput is thrown), the numbers are not.
struct BezierSurface {
  Net net;
  std::vector<double> weights;  ///< in the order of net.points, or empty: polynomial
  friend bool operator==(const BezierSurface&, const BezierSurface&) = default;
};

inline bool is_rational(const BezierSurface& s) { return !s.weights.empty(); }

/// What validate(Net) asks, and degrees in 1 … 30 (path "points").
core::Result<void> validate(const BezierSurface& s);

/// u and v are clamped to [0, 1].
core::Point3 evaluate(const BezierSurface& s, double u, double v);
SurfaceJet jet(const BezierSurface& s, double u, double v);

/// The same surface with its degrees raised (at most to curve::kMaxBezierDegree).
BezierSurface elevate_degree(const BezierSurface& s, int by_u, int by_v);

/// S(u, v) with u and v exchanged; with u run backwards.
BezierSurface transposed(const BezierSurface& s);
BezierSurface reversed_u(const BezierSurface& s);

/// Curve of constant u (along v) and of constant v (along u).
curve::Bezier3 iso_u(const BezierSurface& s, double u);
curve::Bezier3 iso_v(const BezierSurface& s, double v);

}  // namespace keyline::surface
