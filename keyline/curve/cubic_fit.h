#pragma once

#include <array>
#include <span>
#include <utility>

#include "keyline/core/point.h"

/// Internals of room curve: one cubic in place of a row of cubics.
namespace keyline::curve::detail {

/// Planar cubic Bézier curve without allocation.
struct Cubic {
  std::array<core::Point2, 4> control;
};

core::Point2 point_on(const Cubic& c, double u);
core::Vector2 velocity_on(const Cubic& c, double u);
std::pair<Cubic, Cubic> split(const Cubic& c, double u);
Cubic subcurve(const Cubic& c, double u0, double u1);
/// Unit tangents at the ends, also where control points coincide; zero for a point.
core::Vector2 start_tangent(const Cubic& c);
core::Vector2 end_tangent(const Cubic& c);

/// A bound of the largest distance between the row of cubics (each starting where the last ended)
/// and q, in both directions: the row is carried onto q by a piecewise cubic change of parameter,
/// and the differences, of degree 9, are bounded by their Bernstein coefficients. Rigorous up to
/// rounding. No effort is made to sharpen a bound below `wanted`; one above it may be higher still.
double deviation_bound(std::span<const Cubic> row, const Cubic& q, double wanted);

struct CubicFit {
  Cubic cubic;
  double bound = 0;     ///< deviation_bound of it; infinite where the fit clearly misses `wanted`
  double distance = 0;  ///< largest at the samples of the fit
};

/// The cubic with the row's ends and end tangents nearest to it: handle lengths by Gauss-Newton on
/// normal distances, then reweighted towards the smallest maximum where that may decide whether
/// `wanted` is met. The row is tangent-continuous. `ends` says how the row shares out its parameter
/// range: ends[i] in (0, 1] is where row[i] ends. A row cut from one cubic gives that cubic back.
CubicFit fit_cubic(std::span<const Cubic> row, std::span<const double> ends, double wanted);

}  // namespace keyline::curve::detail
