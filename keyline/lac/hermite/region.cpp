#include "keyline/lac/hermite/region.h"

#include <algorithm>
#include <cmath>

#include "keyline/core/angle.h"
#include "keyline/lac/hermite/chord_kernel.h"
#include "keyline/lac/segment/slope.h"
#include "keyline/numeric/roots.h"

namespace keyline::lac {

core::Interval drawable_region(double alpha, double theta) {
  if (!is_slope(alpha) || !(theta > 0 && theta < core::kPi)) {
    throw core::InvalidInput(
        "drawable_region: alpha must lie between -1e100 and 1e100, theta in (0, pi)");
  }
  const double limit = detail::limit_chord_angle(alpha, theta);
  return {theta - limit, limit};
}

namespace {

/// The slope nearest to alpha with the chord angle psi >= theta/2 in its region. The region grows
/// towards the slopes from 0 to 1, where it is full.
double nearest_alpha(double alpha, double theta, double psi) {
  const double full = alpha < 0 ? 0 : 1;
  const auto excess = [&](double slope) { return detail::limit_chord_angle(slope, theta) - psi; };
  // Near the full slopes the border is reached only in the limit; 1/16 away it is resolved.
  const double near = alpha < 0 ? std::max(alpha, -1.0 / 16) : std::min(alpha, 17.0 / 16);
  if (!(excess(near) > 0)) return full;
  const auto root = numeric::bracketed_root(excess, std::min(alpha, near), std::max(alpha, near),
                                            1e-9 * std::abs(alpha));
  if (!root) return near;
  const double inside = *root + (full - *root) * 1e-6;
  return inside;
}

}  // namespace

NearestDrawable nearest_drawable(double alpha, double theta, double psi) {
  if (!(theta > 0 && theta < 2 * core::kPi)) {
    throw core::InvalidInput("nearest_drawable: theta must lie in (0, 2 pi)");
  }
  const double limit = detail::limit_chord_angle(alpha, theta);
  const core::Interval region{theta - limit, limit};
  const double margin = 1e-6 * (region.high - region.low);
  const bool swapped = psi < theta / 2;
  const double unswapped = swapped ? theta - psi : psi;
  return {std::clamp(psi, region.low + margin, region.high - margin),
          unswapped < region.high ? alpha : nearest_alpha(alpha, theta, unswapped)};
}

}  // namespace keyline::lac
