#pragma once

#include <functional>
#include <vector>

#include "keyline/core/error.h"
#include "keyline/core/interval.h"
#include "keyline/curve/concept.h"
#include "keyline/curve/jet.h"

namespace keyline::analysis {

/// A planar curve as the analysis sees it: its jets by parameter and the parameters at which its
/// smoothness may drop. Any type that models curve::PlanarCurve becomes one through view().
struct CurveView {
  std::function<curve::Jet2(double)> jet;
  std::vector<double> breakpoints;  ///< 0 = b0 < b1 < … < bn = 1
};

/// A view of c, which must outlive it.
template <curve::PlanarCurve C>
CurveView view(const C& c) {
  return {[&c](double t) -> curve::Jet2 { return jet(c, t); }, breakpoints(c)};
}

/// What a curve does along its length, and all that graphs, diagrams and rhythms are made of.
///
/// arc_length grows, in the curve's unit; curvature is signed; curvature_rate is dkappa/ds;
/// turning is the tangent angle, unwrapped, less its value at the first sample. Where curvature
/// jumps, two samples share one arc length. curvature_rate and turning may be left empty: then
/// they are computed from the curvature (see complete()).
struct CurvatureProfile {
  std::vector<double> arc_length;
  std::vector<double> curvature;
  std::vector<double> curvature_rate;
  std::vector<double> turning;
};

/// Refuses a profile of fewer than two samples, of no length, of columns that differ in size, of
/// numbers that are not finite, or of arc lengths that fall. Result: the profile with empty
/// columns filled in (rate by differences, turning by the trapezoidal rule).
core::Result<CurvatureProfile> complete(CurvatureProfile profile);

/// The same curve travelled the other way; the profile must be complete.
CurvatureProfile reversed(const CurvatureProfile& profile);

/// Arc length of a view, tabulated once, and its inverse.
///
/// Accuracy: eight-point Gauss rule on at least 256 panels that end at the breakpoints; about
/// 1e-12 of the length where the curve is smooth between breakpoints and has no cusp.
class ArcLengthTable {
 public:
  explicit ArcLengthTable(const CurveView& curve);

  double length() const { return lengths_.back(); }
  /// Arc length from t = 0 to t, t clamped to [0, 1].
  double length_at(double t) const;
  /// Parameter at arc length s, s clamped to [0, length()].
  double parameter_at(double s) const;

 private:
  CurveView curve_;
  std::vector<double> parameters_;  // panel ends
  std::vector<double> lengths_;     // arc length at them
};

/// n >= 2 samples at equal steps of arc length over [t.low, t.high], ends included; curvature is
/// taken from inside the interval at both ends. Values that are not finite (cusps) are replaced
/// by their nearest finite neighbour.
CurvatureProfile sample_profile(const CurveView& curve, const ArcLengthTable& table,
                                core::Interval t, int n);

/// sample_profile over a whole curve.
template <curve::PlanarCurve C>
CurvatureProfile curvature_profile(const C& c, int n = 1001) {
  const CurveView v = view(c);
  return sample_profile(v, ArcLengthTable(v), {0, 1}, n);
}

}  // namespace keyline::analysis
