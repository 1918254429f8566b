#pragma once

#include <vector>

#include "keyline/curve/concept.h"
#include "keyline/curve/polyline.h"

namespace keyline::curve {

namespace detail {

/// Speed of a curve without its type.
struct SpeedView {
  const void* curve;
  double (*speed)(const void*, double);
  double operator()(double t) const { return speed(curve, t); }
};
template <ParametricCurve C>
SpeedView speed_of(const C& c) {
  return {&c,
          [](const void* self, double t) { return speed(jet(*static_cast<const C*>(self), t)); }};
}

double integrate_speed(const SpeedView& v, const std::vector<double>& breaks, double t0, double t1,
                       double tolerance);

}  // namespace detail

/// Arc length from t0 to t1 (negative if t1 < t0), to `tolerance` times the result (never better
/// than rounding): 10-point Gauss rules, each accepted where it agrees with its two halves; the
/// real error is usually orders smaller. Cusps cost subdivisions, not accuracy.
template <ParametricCurve C>
double arc_length(const C& c, double t0 = 0, double t1 = 1, double tolerance = 1e-12) {
  return detail::integrate_speed(detail::speed_of(c), breakpoints(c), t0, t1, tolerance);
}
/// Exact to rounding; the tolerance is not needed.
template <class P>
double arc_length(const Polyline<P>& c, double t0 = 0, double t1 = 1, double tolerance = 0);

/// Arc length as a function of the parameter, ready to be inverted many times: panels
/// [t[i], t[i+1]] on which the 10-point Gauss rule meets the tolerance, s[i] the length up to t[i].
struct ArcLengthMap {
  std::vector<double> t;
  std::vector<double> s;
  std::vector<bool> even;  ///< panels along which the speed is the same to rounding
};
inline double total_length(const ArcLengthMap& map) { return map.s.back(); }

namespace detail {
ArcLengthMap map_lengths(const SpeedView& v, const std::vector<double>& breaks, double tolerance);
double invert_length(const SpeedView& v, const ArcLengthMap& map, double s);
double length_at(const SpeedView& v, const ArcLengthMap& map, double t);
}  // namespace detail

/// Tolerance relative to the whole length.
template <ParametricCurve C>
ArcLengthMap arc_length_map(const C& c, double tolerance = 1e-12) {
  return detail::map_lengths(detail::speed_of(c), breakpoints(c), tolerance);
}
/// Arc length from the start to t, by the curve's map.
template <ParametricCurve C>
double length_at_parameter(const C& c, const ArcLengthMap& map, double t) {
  return detail::length_at(detail::speed_of(c), map, t);
}
/// Parameter at which the arc length from the start is s, clamped to [0, whole length].
template <ParametricCurve C>
double parameter_at_length(const C& c, const ArcLengthMap& map, double s) {
  return detail::invert_length(detail::speed_of(c), map, s);
}
/// The same for a single question; arc length at the answer is s within tolerance * length.
template <ParametricCurve C>
double parameter_at_length(const C& c, double s, double tolerance = 1e-12) {
  return parameter_at_length(c, arc_length_map(c, tolerance), s);
}
template <class P>
double parameter_at_length(const Polyline<P>& c, double s, double tolerance = 0);

/// Parameters of n >= 2 points equally spaced in arc length, first 0 and last 1.
template <ParametricCurve C>
std::vector<double> equal_length_parameters(const C& c, int n, double tolerance = 1e-12) {
  const ArcLengthMap map = arc_length_map(c, tolerance);
  std::vector<double> t;
  for (int i = 0; i < n; ++i)
    t.push_back(i + 1 == n ? 1.0 : parameter_at_length(c, map, total_length(map) * i / (n - 1)));
  return t;
}

}  // namespace keyline::curve
