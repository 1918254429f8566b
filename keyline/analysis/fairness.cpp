#include "keyline/analysis/fairness.h"

#include <algorithm>
#include <cmath>

#include "keyline/analysis/integrate.h"
#include "keyline/analysis/split.h"

namespace keyline::analysis {

Fairness fairness(const CurveView& curve) {
  constexpr int kPanels = 256;  // of the quadrature, spread over the curve's breaks
  const std::vector<double> ends = detail::panel_ends(curve.breaks(), {0, 1}, kPanels, 2);
  const auto integral = [&](auto f) {
    return detail::integrate(
        [&](double t) {
          const curve::Jet2 jet = curve.jet_at(t);
          const double value = f(jet) * curve::speed(jet);
          return std::isfinite(value) ? value : 0;
        },
        ends);
  };
  Fairness f;
  f.length = integral([](const curve::Jet2&) { return 1.0; });
  f.total_turning = integral([](const curve::Jet2& j) { return curve::curvature(j); });
  f.absolute_turning = integral([](const curve::Jet2& j) { return std::abs(curve::curvature(j)); });
  f.bending_energy =
      integral([](const curve::Jet2& j) { return std::pow(curve::curvature(j), 2); });
  f.variation_energy =
      integral([](const curve::Jet2& j) { return std::pow(curve::curvature_rate(j), 2); });
  const Split split = split_monotone(curve);
  f.inflections = static_cast<int>(split.inflections.size());
  f.extrema = static_cast<int>(split.extrema.size());
  f.corners = static_cast<int>(split.corners.size());
  for (std::size_t i = 0; i < split.pieces.size(); ++i) {
    const auto [low, high] =
        std::minmax(split.pieces[i].curvature_start, split.pieces[i].curvature_end);
    f.curvature_min = i == 0 ? low : std::min(f.curvature_min, low);
    f.curvature_max = i == 0 ? high : std::max(f.curvature_max, high);
  }
  return f;
}

}  // namespace keyline::analysis
