#include "keyline/classa/plane_of.h"

#include <algorithm>
#include <cmath>

#include "keyline/core/axis.h"

namespace keyline::classa::detail {

using core::Point3;
using core::Vector3;

namespace {

template <class Length>
Vector3 longest(std::span<const Point3> points, const Length& length) {
  Vector3 best;
  double most = -1;
  for (const Point3& p : points) {
    const Vector3 v = p - points.front();
    if (length(v) > most) {
      most = length(v);
      best = v;
    }
  }
  return best;
}

}  // namespace

Flattened flatten(std::span<const Point3> points) {
  Flattened flat;
  if (points.empty()) return flat;
  const Vector3 span = longest(points, [](Vector3 v) { return norm(v); });
  flat.size = norm(span);
  const Vector3 x = flat.size > 0 ? span / flat.size : Vector3{1, 0, 0};
  const auto beside = [&x](Vector3 v) { return v - dot(v, x) * x; };
  const Vector3 off = beside(longest(points, [&](Vector3 v) { return norm(beside(v)); }));
  const bool line = norm(off) <= 1e-14 * flat.size;
  const Vector3 y = line ? core::any_normal(x) : off / norm(off);
  const Vector3 z = cross(x, y);
  flat.origin = points.front();
  flat.x = x;
  flat.y = y;
  for (const Point3& p : points) {
    const Vector3 v = p - points.front();
    flat.points.push_back({dot(v, x), dot(v, y)});
    flat.off_plane = std::max(flat.off_plane, std::abs(dot(v, z)));
  }
  return flat;
}

}  // namespace keyline::classa::detail
