#include "keyline/fairing/between_points.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace keyline::fairing::detail {
namespace {

core::Point2 blend(core::Point2 a, core::Point2 b, double u) { return a + u * (b - a); }

/// Point of the centripetal Catmull-Rom curve between p[1] and p[2] (Barry and Goldman's pyramid).
core::Point2 between(const std::array<core::Point2, 4>& p, double u) {
  std::array<double, 4> t{};
  for (std::size_t i = 1; i < 4; ++i)
    t[i] = t[i - 1] + std::sqrt(std::max(1e-12, core::distance(p[i - 1], p[i])));
  const double at = t[1] + u * (t[2] - t[1]);
  const auto on = [&](core::Point2 a, core::Point2 b, double ta, double tb) {
    return blend(a, b, (at - ta) / (tb - ta));
  };
  const core::Point2 a = on(p[0], p[1], t[0], t[1]);
  const core::Point2 b = on(p[1], p[2], t[1], t[2]);
  const core::Point2 c = on(p[2], p[3], t[2], t[3]);
  return on(on(a, b, t[0], t[2]), on(b, c, t[1], t[3]), t[1], t[2]);
}

}  // namespace

core::Point2 between_points(const std::vector<core::Point2>& points, bool closed, std::size_t i,
                            double u) {
  const std::size_t n = points.size();
  const auto at = [&](std::size_t k) { return points[k % n]; };
  const bool first = !closed && i == 0;
  const bool last = !closed && i + 2 == n;
  const core::Point2 before = first ? at(0) + (at(0) - at(1)) : at(i + n - 1);
  const core::Point2 after = last ? at(n - 1) + (at(n - 1) - at(n - 2)) : at(i + 2);
  return between({before, at(i), at(i + 1), after}, u);
}

}  // namespace keyline::fairing::detail
