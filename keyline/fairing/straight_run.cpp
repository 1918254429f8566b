#include "keyline/fairing/straight_run.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "keyline/core/angle.h"

namespace keyline::fairing::detail {
namespace {

constexpr int kFitSteps = 20;  // of least squares, which ends after a few

double spread_of(const FitPoint& p) { return std::max(p.high, -p.low); }

/// A circle by a pose on it and its curvature, which is exact for the flattest of arcs.
struct Circle {
  core::Point2 at;
  double direction = 0;
  double curvature = 0;
};

/// A point in the frame of a circle's pose.
core::Vector2 in_frame(const Circle& circle, core::Point2 p) {
  const core::Vector2 along = core::unit_vector(circle.direction);
  const core::Vector2 d = p - circle.at;
  return {core::dot(along, d), core::cross(along, d)};
}

/// Square of the distance from the centre over the radius, less one; over the curvature.
double excess(const Circle& circle, core::Vector2 d) {
  return circle.curvature * core::dot(d, d) - 2 * d.y;
}

/// Distance of a point from the circle, positive to its right.
double distance_from(const Circle& circle, core::Vector2 d) {
  const double f = excess(circle, d);
  return f / (1 + std::sqrt(std::max(0.0, 1 + circle.curvature * f)));
}

/// The angle round the circle from its pose to a point's foot.
double angle_to(const Circle& circle, core::Vector2 d) {
  const double k = circle.curvature;
  return std::atan2(k * d.x, 1 - k * d.y);
}

/// The circle through three points, at the second one; empty where they lie on a line.
std::optional<Circle> circle_through(core::Point2 first, core::Point2 second, core::Point2 third) {
  const core::Vector2 a = first - second;
  const core::Vector2 b = third - second;
  const double area = 2 * core::cross(a, b);
  const double aa = core::dot(a, a);
  const double bb = core::dot(b, b);
  if (!(std::abs(area) > kAtSight * std::sqrt(aa * bb))) return std::nullopt;
  const core::Vector2 inwards = core::Vector2{b.y * aa - a.y * bb, a.x * bb - b.x * aa} / area;
  const double sense = area > 0 ? -1 : 1;  // first, second, third to the left
  return Circle{second, core::direction_of(-sense * core::perpendicular_left(inwards)),
                sense / core::norm(inwards)};
}

/// Moved to the least squares of the points' distances.
Circle fitted(Circle circle, const std::vector<FitPoint>& points) {
  for (int step = 0; step < kFitSteps; ++step) {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (const FitPoint& p : points) {
      const core::Vector2 d = in_frame(circle, p.position);
      const double f = excess(circle, d);
      const double root = std::sqrt(std::max(1e-12, 1 + circle.curvature * f));
      const double by = 1 / (2 * root);  // of the distance by the excess
      const double bent = by * core::dot(d, d) - f * f * by / ((1 + root) * (1 + root));
      const Eigen::Vector3d row(2 * by * (1 - circle.curvature * d.y), 2 * by * d.x, bent);
      normal += p.weight * row * row.transpose();
      right -= p.weight * distance_from(circle, d) * row;
    }
    const Eigen::Vector3d by = normal.ldlt().solve(right);
    if (!by.allFinite()) break;
    circle.at = circle.at + by(0) * core::perpendicular_left(core::unit_vector(circle.direction));
    circle.direction += by(1);
    circle.curvature += by(2);
    if (by.norm() < kAtSight) break;
  }
  return circle;
}

double farthest(const Circle& circle, const std::vector<FitPoint>& points) {
  double most = 0;
  for (const FitPoint& p : points)
    most = std::max(most,
                    std::abs(distance_from(circle, in_frame(circle, p.position))) + spread_of(p));
  return most;
}

/// The joint at an angle round the circle from its pose.
FitJoint joint_at(const Circle& circle, double angle) {
  const core::Vector2 along = core::unit_vector(circle.direction);
  const double half = std::sin(angle / 2);
  const core::Vector2 by =
      std::sin(angle) * along + 2 * half * half * core::perpendicular_left(along);
  return {circle.at + by / circle.curvature, circle.direction + angle, circle.curvature};
}

/// Angles round the circle of the points, all one way: by less than half a turn from each to the
/// next, or else by less than a whole turn in all. Empty where points turn back.
std::vector<double> angles_of(const Circle& circle, const std::vector<FitPoint>& points) {
  for (const bool short_way : {true, false}) {
    std::vector<double> angles;
    double sense = short_way ? 0 : std::copysign(1.0, circle.curvature);
    for (const FitPoint& p : points) {
      double angle = angle_to(circle, in_frame(circle, p.position));
      if (!angles.empty()) {
        double step = std::remainder(angle - angles.back(), 2 * core::kPi);
        if (sense == 0) sense = std::copysign(1.0, step);
        if (!short_way && step * sense < 0) step += sense * 2 * core::kPi;
        if (!(step * sense > 0)) break;
        angle = angles.back() + step;
      }
      angles.push_back(angle);
    }
    if (angles.size() < points.size()) continue;
    if (short_way || std::abs(angles.back() - angles.front()) < 2 * core::kPi) return angles;
  }
  return {};
}

}  // namespace

std::optional<FitChain> straight_chain(const std::vector<FitPoint>& points) {
  if (points.size() < 2) return std::nullopt;
  const core::Point2 first = points.front().position;
  const core::Vector2 chord = points.back().position - first;
  const double length = core::norm(chord);
  if (!(length > 0)) return std::nullopt;
  const core::Vector2 along = chord / length;
  FitChain chain;
  double before = -1;
  for (const FitPoint& p : points) {
    const double x = core::dot(along, p.position - first);
    const double aside = std::abs(core::cross(along, p.position - first));
    if (!(x > before) || !(aside + spread_of(p) <= kAtSight)) return std::nullopt;
    chain.feet.push_back({0, x / length});
    before = x;
  }
  const double direction = core::direction_of(chord);
  chain.joints = {{first, direction, 0}, {points.back().position, direction, 0}};
  chain.pieces = {{.length = length, .kind = PieceKind::line}};
  return chain;
}

std::optional<FitChain> arc_chain(const std::vector<FitPoint>& points, double within) {
  if (points.size() < 3) return std::nullopt;
  auto circle = circle_through(points.front().position, points[points.size() / 2].position,
                               points.back().position);
  if (!circle) return std::nullopt;
  const bool exact = farthest(*circle, points) <= kAtSight;
  if (!exact) circle = fitted(*circle, points);
  if (!(farthest(*circle, points) <= within) || circle->curvature == 0) return std::nullopt;
  const std::vector<double> angles = angles_of(*circle, points);
  if (angles.empty()) return std::nullopt;
  const double turning = angles.back() - angles.front();
  FitChain chain;
  for (const double angle : angles) chain.feet.push_back({0, (angle - angles.front()) / turning});
  chain.joints = {joint_at(*circle, angles.front()), joint_at(*circle, angles.back())};
  if (exact) {
    chain.joints[0].position = points.front().position;
    chain.joints[1].position = points.back().position;
  }
  if (turning * circle->curvature < 0)  // more than a turn: three points tell the other sense
    for (FitJoint& joint : chain.joints) {
      joint.direction += core::kPi;
      joint.curvature = -joint.curvature;
    }
  chain.pieces = {{.length = std::abs(turning / circle->curvature), .kind = PieceKind::arc}};
  return chain;
}

}  // namespace keyline::fairing::detail
