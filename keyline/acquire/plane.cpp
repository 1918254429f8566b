#include "keyline/acquire/plane.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Eigenvalues>

#include "keyline/core/error.h"
#include "keyline/core/polygon.h"

namespace keyline::acquire {
namespace {

core::Vector3 normalized(core::Vector3 v) { return v / core::norm(v); }

core::Vector3 normal_of(const Plane& plane) { return core::cross(plane.axis_x, plane.axis_y); }

PlaneFit measured(const Plane& plane, std::span<const core::Point3> points) {
  PlaneFit fit{plane, 0, 0};
  double sum = 0;
  for (const core::Point3& p : points) {
    const double d = distance_from_plane(plane, p);
    fit.departure = std::max(fit.departure, std::abs(d));
    sum += d * d;
  }
  fit.departure_rms = std::sqrt(sum / static_cast<double>(points.size()));
  return fit;
}

/// Planes parallel to two coordinate axes through c, in order of preference.
std::array<Plane, 3> axis_planes(core::Point3 c) {
  return {Plane{{0, 0, c.z}, {1, 0, 0}, {0, 1, 0}}, Plane{{0, c.y, 0}, {1, 0, 0}, {0, 0, 1}},
          Plane{{c.x, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
}

Plane principal_plane(std::span<const core::Point3> points, core::Point3 c) {
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const core::Point3& p : points) {
    const core::Vector3 d = p - c;
    const Eigen::Vector3d v(d.x, d.y, d.z);
    scatter += v * v.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(scatter);
  const Eigen::Vector3d n = eigen.eigenvectors().col(0);
  const core::Vector3 normal{n.x(), n.y(), n.z()};
  // Upright where possible: the second axis points along z, or along y in a level plane.
  const core::Vector3 up = std::abs(n.z()) < 0.9 ? core::Vector3{0, 0, 1} : core::Vector3{0, 1, 0};
  const core::Vector3 axis_y = normalized(up - core::dot(up, normal) * normal);
  core::Vector3 axis_x = core::cross(axis_y, normal);
  const double main = std::abs(axis_x.x) >= std::abs(axis_x.y) ? axis_x.x : axis_x.y;
  if (main < 0) axis_x = -axis_x;
  return {c, axis_x, axis_y};
}

}  // namespace

core::Point2 to_plane(const Plane& plane, core::Point3 p) {
  const core::Vector3 d = p - plane.origin;
  return {core::dot(d, plane.axis_x), core::dot(d, plane.axis_y)};
}

core::Point3 from_plane(const Plane& plane, core::Point2 p) {
  return plane.origin + (p.x * plane.axis_x + p.y * plane.axis_y);
}

double distance_from_plane(const Plane& plane, core::Point3 p) {
  return core::dot(p - plane.origin, normal_of(plane));
}

PlaneFit fit_plane(std::span<const core::Point3> points) {
  if (points.empty()) throw core::InvalidInput("fit_plane needs at least one point");
  for (const core::Point3& p : points) {
    if (!core::is_finite(p)) throw core::InvalidInput("fit_plane needs finite points");
  }
  const core::Point3 c = core::centroid(points);
  const PlaneFit best = measured(principal_plane(points, c), points);
  double size = 0;
  for (const core::Point3& p : points) size = std::max(size, core::distance(p, c));
  for (const Plane& plane : axis_planes(c)) {
    const PlaneFit fit = measured(plane, points);
    if (fit.departure <= 1.5 * best.departure + 1e-12 * size) return fit;
  }
  return best;
}

}  // namespace keyline::acquire
