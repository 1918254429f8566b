#include "keyline/exchange/cad/flat_points.h"

#include <algorithm>
#include <cmath>

namespace keyline::exchange::detail {

using core::Point2;
using core::Point3;

bool are_flat(const std::vector<Point3>& points) {
  double size = 0;
  double height = 0;
  for (const Point3& p : points) {
    size = std::max({size, std::abs(p.x), std::abs(p.y)});
    height = std::max(height, std::abs(p.z));
  }
  return height <= kFlat * size;
}

std::vector<Point2> flat(const std::vector<Point3>& points) {
  std::vector<Point2> result;
  for (const Point3& p : points) result.push_back({p.x, p.y});
  return result;
}

std::vector<Point3> lifted(const std::vector<Point2>& points) {
  std::vector<Point3> result;
  for (const Point2 p : points) result.push_back(lifted(p));
  return result;
}

}  // namespace keyline::exchange::detail
