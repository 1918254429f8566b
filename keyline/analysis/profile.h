#pragma once

#include <vector>

#include "keyline/core/error.h"
#include "keyline/core/interval.h"
#include "keyline/curve/concept.h"
#include "keyline/curve/jet.h"
#include "keyline/curve/length.h"
#include "keyline/curve/view.h"

namespace keyline::analysis {

/// A planar curve as the analysis sees it, whatever its type.
using CurveView = curve::PlanarView;

/// A view of c, which must outlive it.
template <curve::PlanarCurve C>
CurveView view(const C& c) {
  return CurveView(c);
}
inline CurveView view(const CurveView& v) { return v; }

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

/// A view with its arc length, tabulated once (curve/length.h) to 1e-12 of the whole.
class ArcLengthTable {
 public:
  explicit ArcLengthTable(const CurveView& curve)
      : curve_(curve), map_(curve::arc_length_map(curve)) {}

  double length() const { return curve::total_length(map_); }
  /// Arc length from t = 0 to t, t clamped to [0, 1].
  double length_at(double t) const { return curve::length_at_parameter(curve_, map_, t); }
  /// Parameter at arc length s, s clamped to [0, length()].
  double parameter_at(double s) const { return curve::parameter_at_length(curve_, map_, s); }

 private:
  CurveView curve_;
  curve::ArcLengthMap map_;
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
