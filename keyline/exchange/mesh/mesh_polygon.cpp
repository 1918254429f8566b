#include "keyline/exchange/mesh/mesh_polygon.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace keyline::exchange::detail {
namespace {

using core::Point2;
using core::Point3;
using core::Vector3;

using Corners = std::span<const std::uint32_t>;

void add_fan(Mesh& mesh, Corners corners) {
  for (std::size_t i = 2; i < corners.size(); ++i)
    mesh.triangles.push_back({corners[0], corners[i - 1], corners[i]});
}

/// Twice the triangle of the fan about the first corner that ends at corner i, as a vector.
Vector3 fan_area(const Mesh& mesh, Corners corners, std::size_t i) {
  const Point3 first = mesh.points[corners[0]];
  return cross(mesh.points[corners[i - 1]] - first, mesh.points[corners[i]] - first);
}

/// Twice the area of a triangle, positive where it turns counterclockwise.
double area(Point2 a, Point2 b, Point2 c) { return cross(b - a, c - a); }

/// A face in its plane, counterclockwise, and what is left of it as ears are cut off.
class Ears {
 public:
  Ears(Mesh& mesh, Corners corners, Vector3 normal) : mesh_(mesh), corners_(corners) {
    const std::size_t n = corners.size();
    const Point3 first = mesh.points[corners[0]];
    ring_.resize(n);
    for (std::size_t i = 0; i < n; ++i)
      ring_[i] = {along(mesh.points[corners[i]] - first, normal), (i + n - 1) % n, (i + 1) % n};
    for (std::size_t i = 0; i < n; ++i) ring_[i].bends = bends(i);
    for (std::size_t i = 0; i < n; ++i) ring_[i].ear = is_ear(i);
  }

  void cut() {
    std::size_t left = ring_.size();
    std::size_t at = 0;
    for (std::size_t passed = 0; left > 3 && passed < left;) {
      const std::size_t tip = at;
      const std::size_t before = ring_[tip].before;
      const std::size_t after = ring_[tip].after;
      ++passed;
      at = after;
      if (!ring_[tip].ear) continue;
      mesh_.triangles.push_back({corners_[before], corners_[tip], corners_[after]});
      ring_[before].after = after;
      ring_[after].before = before;
      // Of the other corners none becomes an ear by this, and none ceases to be one.
      for (const std::size_t beside : {before, after}) ring_[beside].bends = bends(beside);
      for (const std::size_t beside : {before, after}) ring_[beside].ear = is_ear(beside);
      at = ring_[after].after;  // not all about the same corner
      --left;
      passed = 0;
    }
    std::vector<std::uint32_t> rest;
    for (; rest.size() < left; at = ring_[at].after) rest.push_back(corners_[at]);
    add_fan(mesh_, rest);
  }

 private:
  struct Corner {
    Point2 p;
    std::size_t before = 0;
    std::size_t after = 0;
    bool bends = false;  ///< inwards: turns left
    bool ear = false;
  };

  /// Seen along the axis nearest to the normal, from the side on which it turns counterclockwise.
  static Point2 along(Vector3 v, Vector3 normal) {
    const Vector3 size{std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)};
    if (size.z >= size.x && size.z >= size.y)
      return normal.z > 0 ? Point2{v.x, v.y} : Point2{v.y, v.x};
    if (size.y >= size.x) return normal.y > 0 ? Point2{v.z, v.x} : Point2{v.x, v.z};
    return normal.x > 0 ? Point2{v.y, v.z} : Point2{v.z, v.y};
  }

  bool bends(std::size_t i) const {
    const Corner& c = ring_[i];
    return area(ring_[c.before].p, c.p, ring_[c.after].p) > 0;
  }

  /// Whether the triangle of a corner and its neighbours is free of others. Only corners that do
  /// not bend inwards can be the deepest in it; those at the place of its own are where a cut leads
  /// to a hole and back.
  bool is_ear(std::size_t i) const {
    if (!ring_[i].bends) return false;
    const Point2 b = ring_[i].p;
    const Point2 a = ring_[ring_[i].before].p;
    const Point2 c = ring_[ring_[i].after].p;
    const std::size_t end = ring_[i].before;
    for (std::size_t j = ring_[ring_[i].after].after; j != end; j = ring_[j].after) {
      const Point2 p = ring_[j].p;
      if (ring_[j].bends || p == a || p == b || p == c) continue;
      if (area(a, b, p) >= 0 && area(b, c, p) >= 0 && area(c, a, p) >= 0) return false;
    }
    return true;
  }

  Mesh& mesh_;
  Corners corners_;
  std::vector<Corner> ring_;
};

}  // namespace

bool add_polygon(Mesh& mesh, Corners corners) {
  Vector3 normal;
  for (std::size_t i = 2; i < corners.size(); ++i) normal = normal + fan_area(mesh, corners, i);
  bool overlaps = false;
  for (std::size_t i = 2; i < corners.size() && !overlaps; ++i)
    overlaps = dot(fan_area(mesh, corners, i), normal) < 0;
  const bool cut = overlaps && corners.size() <= kMostCorners;
  if (cut)
    Ears(mesh, corners, normal).cut();
  else
    add_fan(mesh, corners);
  return cut || !overlaps;
}

}  // namespace keyline::exchange::detail
