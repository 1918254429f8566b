#include "keyline/analysis/volume.h"

#include <cmath>

#include "keyline/analysis/integrate.h"

namespace keyline::analysis {

double signed_volume(const CurveView& curve, core::Interval t, int panels) {
  const core::Point2 start = curve.jet(t.low).point;
  const auto doubled_sector = [&](double at) {
    const curve::Jet2 j = curve.jet(at);
    return core::cross(j.point - start, j.first);
  };
  // The chord runs through the start, so it adds nothing to the contour integral.
  return detail::integrate(doubled_sector, detail::panel_ends(curve.breakpoints, t, panels)) / 2;
}

double volume(const CurveView& curve, core::Interval t, int panels) {
  return std::abs(signed_volume(curve, t, panels));
}

}  // namespace keyline::analysis
