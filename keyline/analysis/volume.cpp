#include "keyline/analysis/volume.h"

#include <cmath>

#include "keyline/analysis/integrate.h"
#include "keyline/numeric/roots.h"

namespace keyline::analysis {
namespace {

/// Area swept between [a, b] of the curve and the point `from`.
double sector(const CurveView& curve, core::Point2 from, core::Interval t, int panels) {
  const auto doubled = [&](double at) {
    const curve::Jet2 j = curve.jet_at(at);
    return core::cross(j.point - from, j.first);
  };
  return detail::integrate(doubled, detail::panel_ends(curve.breaks(), t, panels)) / 2;
}

/// Parameters at which the curve crosses the line through its chord, and both ends.
std::vector<double> chord_crossings(const CurveView& curve, core::Interval t, int panels) {
  const core::Point2 start = curve.jet_at(t.low).point;
  const core::Vector2 chord = curve.jet_at(t.high).point - start;
  // Over the distances from both ends, where the curve lies on the line: one crossed next to an end
  // shows by the tangent there.
  const auto side = [&](double at) {
    const curve::Jet2 j = curve.jet_at(at);
    const double width = t.high - t.low;
    if (at == t.low) return core::cross(chord, j.first) / width;
    if (at == t.high) return -core::cross(chord, j.first) / width;
    return core::cross(chord, j.point - start) / ((at - t.low) * (t.high - at));
  };
  const std::vector<double> ends = detail::panel_ends(curve.breaks(), t, 4 * panels);
  std::vector<double> crossings = {t.low};
  double before = 0;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const double now = side(ends[i]);
    if (before * now < 0) {
      const auto root = numeric::bracketed_root(side, ends[i - 1], ends[i], 0);
      if (root) crossings.push_back(*root);
    }
    if (now != 0) before = now;
  }
  crossings.push_back(t.high);
  return crossings;
}

}  // namespace

double signed_volume(const CurveView& curve, core::Interval t, int panels) {
  // The chord runs through the start, so it adds nothing to the contour integral.
  return sector(curve, curve.jet_at(t.low).point, t, panels);
}

double volume(const CurveView& curve, core::Interval t, int panels) {
  const core::Point2 start = curve.jet_at(t.low).point;
  const std::vector<double> ends = chord_crossings(curve, t, panels);
  double sum = 0;
  for (std::size_t i = 1; i < ends.size(); ++i)
    sum += std::abs(sector(curve, start, {ends[i - 1], ends[i]}, panels));
  return sum;
}

}  // namespace keyline::analysis
