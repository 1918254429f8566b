#pragma once

#include "keyline/analysis/profile.h"

namespace keyline::analysis {

/// Signed area between the part [t.low, t.high] of a curve and its chord: positive where the curve
/// turns left, so that a closed curve run counter-clockwise gives the area it encloses. Areas on
/// the two sides of the chord cancel.
///
/// Accuracy: 1e-13 of what the line from the start to the curve sweeps, by Green's theorem with an
/// eight-point Gauss rule on panels that are halved until their halves agree with them: exact to
/// rounding for polynomial curves up to degree 8.
double signed_volume(const CurveView& curve, core::Interval t = {0, 1});

/// The volume of [Fairing] (Fig. 2): the area between a curve and its chord, never negative.
/// Where the curve crosses the line through its chord, the parts count each for themselves, so
/// that an S does not cancel. Reversing the curve changes nothing.
double volume(const CurveView& curve, core::Interval t = {0, 1});

template <curve::PlanarCurve C>
double signed_volume(const C& c, core::Interval t = {0, 1}) {
  return signed_volume(view(c), t);
}
template <curve::PlanarCurve C>
double volume(const C& c, core::Interval t = {0, 1}) {
  return volume(view(c), t);
}

}  // namespace keyline::analysis
