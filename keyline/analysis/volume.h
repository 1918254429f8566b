#pragma once

#include "keyline/analysis/profile.h"

namespace keyline::analysis {

/// Signed area between the part [t.low, t.high] of a curve and its chord: the volume of [Fairing]
/// (Fig. 2), negative where the curve bulges to the left of its chord (turns right), positive
/// where it turns left; a closed curve run counter-clockwise gives the area it encloses. Parts on
/// both sides of the chord cancel: take the volume of each part between inflections instead.
///
/// Accuracy: Green's theorem with an eight-point Gauss rule on `panels` panels (at least one per
/// stretch between breakpoints): exact to rounding for polynomial curves up to degree 8.
double signed_volume(const CurveView& curve, core::Interval t = {0, 1}, int panels = 64);

/// |signed_volume|, the paper's volume of a piece of monotone curvature.
double volume(const CurveView& curve, core::Interval t = {0, 1}, int panels = 64);

template <curve::PlanarCurve C>
double signed_volume(const C& c, core::Interval t = {0, 1}) {
  return signed_volume(view(c), t);
}
template <curve::PlanarCurve C>
double volume(const C& c, core::Interval t = {0, 1}) {
  return volume(view(c), t);
}

}  // namespace keyline::analysis
