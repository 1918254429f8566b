#pragma once

#include <concepts>
#include <vector>

#include "keyline/core/point.h"
#include "keyline/curve/jet.h"

namespace keyline::curve {

/// What every planar curve type offers, found by argument-dependent lookup beside the type:
///
///   core::Point2 evaluate(const C&, double t)      point at t in [0, 1]
///   curve::Jet2 jet(const C&, double t)            the same with derivatives in t
///   std::vector<double> breakpoints(const C&)      0 = b0 < b1 < … < bn = 1, the parameters where
///                                                  a derivative may jump; smooth in between
///
/// At an interior breakpoint both functions take the side of growing t; the other side is what
/// they give at std::nextafter(t, 0). Parameters outside [0, 1] are clamped.
template <class C>
concept PlanarCurve = requires(const C& c, double t) {
  { evaluate(c, t) } -> std::same_as<core::Point2>;
  { jet(c, t) } -> std::same_as<Jet2>;
  { breakpoints(c) } -> std::same_as<std::vector<double>>;
};

/// The same in space.
template <class C>
concept SpaceCurve = requires(const C& c, double t) {
  { evaluate(c, t) } -> std::same_as<core::Point3>;
  { jet(c, t) } -> std::same_as<Jet3>;
  { breakpoints(c) } -> std::same_as<std::vector<double>>;
};

template <class C>
concept ParametricCurve = PlanarCurve<C> || SpaceCurve<C>;

/// Point type of a curve type.
template <ParametricCurve C>
using PointOf = decltype(evaluate(std::declval<const C&>(), 0.0));

/// Curvature and friends straight from the curve (see jet.h for what happens at cusps).
template <PlanarCurve C>
double tangent_angle(const C& c, double t) {
  return tangent_angle(jet(c, t));
}
template <ParametricCurve C>
double curvature(const C& c, double t) {
  return curvature(jet(c, t));
}
template <PlanarCurve C>
double curvature_rate(const C& c, double t) {
  return curvature_rate(jet(c, t));
}
/// Point of the evolute: centre of the osculating circle; not finite at inflections.
template <PlanarCurve C>
core::Point2 evolute(const C& c, double t) {
  return centre_of_curvature(jet(c, t));
}

/// Points at n >= 2 equally spaced parameters from 0 to 1.
template <ParametricCurve C>
std::vector<PointOf<C>> sample(const C& c, int n) {
  std::vector<PointOf<C>> points;
  points.reserve(n > 0 ? n : 0);
  for (int i = 0; i < n; ++i) points.push_back(evaluate(c, n > 1 ? i / (n - 1.0) : 0.0));
  return points;
}

}  // namespace keyline::curve
