#include "keyline/classa/nearest_space.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "keyline/core/axis.h"
#include "keyline/core/extent.h"
#include "keyline/curve/closest_point.h"
#include "keyline/curve/length.h"

namespace keyline::classa {

using core::Point2;
using core::Point3;
using core::Vector3;

namespace {

constexpr int kSamples = 65;

/// Axes of a plane through the start: x along the chord, y within it, z its normal.
struct Plane {
  Point3 origin;
  Vector3 x, y, z;

  Point2 flattened(Point3 p) const { return {dot(p - origin, x), dot(p - origin, y)}; }
  Point3 lifted(Point2 p) const { return origin + (p.x * x + p.y * y); }
};

/// The direction across the chord in which the points spread most, the smaller eigenvalue's at
/// right angles to it: both from one angle, as across the chord there are only two dimensions.
Plane plane_through_ends(const std::vector<Point3>& points) {
  Plane plane{points.front(), points.back() - points.front(), {}, {}};
  plane.x = plane.x / norm(plane.x);
  const Vector3 a = core::any_normal(plane.x);
  const Vector3 b = cross(plane.x, a);
  double aa = 0, ab = 0, bb = 0;
  for (const Point3& p : points) {
    const double da = dot(p - plane.origin, a);
    const double db = dot(p - plane.origin, b);
    aa += da * da;
    ab += da * db;
    bb += db * db;
  }
  const double angle = core::principal_angle(aa, ab, bb);
  plane.y = std::cos(angle) * a + std::sin(angle) * b;
  plane.z = cross(plane.x, plane.y);
  return plane;
}

/// Largest distance of the given curve's samples from a curve in the plane.
double farthest_from_flat(const curve::Bezier3& given, const curve::Bezier2& flat,
                          const Plane& plane) {
  double most = 0;
  for (const double t : equal_length_parameters(given, kSamples, 1e-9)) {
    const Point3 p = evaluate(given, t);
    const double within = curve::closest_point(flat, plane.flattened(p)).distance;
    most = std::max(most, std::hypot(within, dot(p - plane.origin, plane.z)));
  }
  return most;
}

/// Distance of a point from a curve in space: the nearest of a table, then Newton's method on the
/// tangent.
double distance_from(const curve::Bezier3& c, const std::vector<Point3>& table, Point3 p) {
  const auto nearer = [&p](const Point3& a, const Point3& b) { return norm(a - p) < norm(b - p); };
  const auto nearest = std::min_element(table.begin(), table.end(), nearer);
  double t = static_cast<double>(nearest - table.begin()) / static_cast<double>(table.size() - 1);
  double least = distance(*nearest, p);
  for (int i = 0; i < 4; ++i) {
    const auto j = jet(c, t);
    const double square = dot(j.first, j.first);
    if (!(square > 0)) break;
    t = std::clamp(t + dot(p - j.point, j.first) / square, 0.0, 1.0);
    least = std::min(least, distance(evaluate(c, t), p));
  }
  return least;
}

double farthest_from_given(const curve::Bezier3& from, const curve::Bezier3& given) {
  constexpr int kTable = 256;
  std::vector<Point3> table;
  for (int i = 0; i <= kTable; ++i) table.push_back(evaluate(given, i / double{kTable}));
  double most = 0;
  for (const double t : equal_length_parameters(from, kSamples, 1e-9))
    most = std::max(most, distance_from(given, table, evaluate(from, t)));
  return most;
}

}  // namespace

std::optional<NearestSpaceCurve> nearest_matrix_curve(const curve::Bezier3& given,
                                                      const NearestOptions& options) {
  const double size = core::reach(given.control);
  if (!(distance(given.control.front(), given.control.back()) > 1e-9 * size)) return std::nullopt;
  const Plane plane = plane_through_ends(given.control);
  curve::Bezier2 seen;
  for (const Point3& p : given.control) seen.control.push_back(plane.flattened(p));
  auto flat = nearest_matrix_curve(seen, options);
  if (!flat) return std::nullopt;
  NearestSpaceCurve result{std::move(*flat), {}, 0};
  for (const Point2& p : result.flat.curve.control) result.curve.control.push_back(plane.lifted(p));
  result.distance = std::max(farthest_from_flat(given, result.flat.curve, plane),
                             farthest_from_given(result.curve, given));
  return result;
}

std::optional<NearestValue> nearest_value(const curve::Bezier3& given, const CavOptions& options) {
  const core::Interval s{std::min(options.s.low, 1.0), std::max(options.s.high, 1.0)};
  auto nearest = nearest_matrix_curve(given, {options.alpha_max, s});
  if (!nearest) return std::nullopt;
  NearestValue result{std::move(*nearest), {}};
  CavOptions own = options;
  own.minimum.reset();
  if (auto value = cav(result.nearest.flat.curve, own)) result.value = std::move(*value);
  return result;
}

}  // namespace keyline::classa
