#include "keyline/surface/closest_point.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace keyline::surface {

using core::dot;
using core::Point3;
using core::Vector3;

namespace {

int places_along(std::size_t breakpoints) {
  return static_cast<int>(std::min<std::size_t>(32 * (breakpoints - 1) + 1, 513));
}

JetGrid grid_of(const Surface& s) {
  return sample_grid(s, places_along(breakpoints_u(s).size()),
                     places_along(breakpoints_v(s).size()));
}

double squared(const Vector3& v) { return dot(v, v); }

}  // namespace

std::array<double, 2> foot_step(const SurfaceJet& j, const Vector3& d, double u, double v) {
  const double gu = dot(d, j.u);
  const double gv = dot(d, j.v);
  const bool fixed_u = (u <= 0 && gu > 0) || (u >= 1 && gu < 0);
  const bool fixed_v = (v <= 0 && gv > 0) || (v >= 1 && gv < 0);
  const double a = squared(j.u);
  const double b = dot(j.u, j.v);
  const double c = squared(j.v);
  if (fixed_u && fixed_v) return {0, 0};
  if (fixed_u) return {0, c > 0 ? -gv / c : 0};
  if (fixed_v) return {a > 0 ? -gu / a : 0, 0};
  const double det = a * c - b * b;
  if (!(det > 1e-14 * a * c)) return {a > 0 ? -gu / a : 0, 0};
  return {(b * gv - c * gu) / det, (b * gu - a * gv) / det};
}

ClosestPoint::ClosestPoint(const Surface& s) : surface_(s), grid_(grid_of(s)) {}

SurfacePoint ClosestPoint::operator()(const Point3& p) const {
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < grid_.jets.size(); ++i) {
    const double here = squared(grid_.jets[i].point - p);
    if (here < least) {
      least = here;
      best = i;
    }
  }
  const auto columns = static_cast<std::size_t>(grid_.columns);
  SurfacePoint at;
  const std::size_t row = best / columns;
  at.u = static_cast<double>(row) / (grid_.rows - 1);
  at.v = static_cast<double>(best % columns) / (grid_.columns - 1);
  at.point = grid_.jets[best].point;
  for (int i = 0; i < 40; ++i) {
    const SurfaceJet j = jet(surface_, at.u, at.v);
    auto [du, dv] = foot_step(j, j.point - p, at.u, at.v);
    bool better = false;
    for (double share = 1; share > 1e-3 && !better; share *= 0.5) {
      const double u = std::clamp(at.u + share * du, 0.0, 1.0);
      const double v = std::clamp(at.v + share * dv, 0.0, 1.0);
      const Point3 there = evaluate(surface_, u, v);
      const double d = squared(there - p);
      if (!(d < least)) continue;
      better = least - d > 1e-15 * least;
      least = d;
      at.u = u;
      at.v = v;
      at.point = there;
    }
    if (!better) break;
  }
  at.distance = std::sqrt(least);
  return at;
}

double departure(const Surface& a, const Surface& b, int places) {
  double largest = 0;
  const auto measure = [&](const Surface& from, const Surface& onto) {
    const ClosestPoint nearest(onto);
    for (const SurfaceJet& j : sample_grid(from, places, places).jets)
      largest = std::max(largest, nearest(j.point).distance);
  };
  measure(a, b);
  measure(b, a);
  return largest;
}

}  // namespace keyline::surface
