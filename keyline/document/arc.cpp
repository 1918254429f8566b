#include "keyline/document/arc.h"

#include <cmath>

#include "keyline/core/angle.h"

namespace keyline::document {

namespace {

constexpr double kTolerance = 1e-12;

}  // namespace

core::Point2 point_on(const Arc& arc, double angle) {
  return arc.center + arc.radius * core::Vector2{std::cos(angle), std::sin(angle)};
}

std::optional<Arc> as_arc(const lac::Segment& s) {
  if (s.curvature_start != s.curvature_end || s.curvature_start == 0 ||
      !std::isfinite(s.curvature_start))
    return std::nullopt;
  const double radius = 1 / s.curvature_start;
  const double turn = s.length * s.curvature_start;
  if (std::abs(turn) > 2 * core::kPi * (1 + kTolerance)) return std::nullopt;
  const core::Vector2 left{-std::sin(s.start.direction), std::cos(s.start.direction)};
  const double start = s.start.direction - std::copysign(core::kPi / 2, radius);
  return Arc{s.start.position + radius * left, std::abs(radius), core::wrap_angle(start), turn};
}

std::optional<Arc> as_arc(const curve::Bezier2& c) {
  if (c.control.size() != 3 || c.weights.size() != 3) return std::nullopt;
  const core::Vector2 a = c.control[1] - c.control[0];
  const core::Vector2 b = c.control[2] - c.control[1];
  const double la = norm(a);
  const double lb = norm(b);
  const double turn = core::angle_between(a, b);
  const double weight = c.weights[1] / std::sqrt(c.weights[0] * c.weights[2]);
  const bool even = std::abs(c.weights[0] / c.weights[2] - 1) < kTolerance;
  if (!(la > 0) || std::abs(la - lb) > kTolerance * la || !even || turn == 0 ||
      std::abs(weight - std::cos(turn / 2)) > kTolerance)
    return std::nullopt;
  const double radius = la / std::tan(std::abs(turn) / 2);
  const double side = turn > 0 ? 1 : -1;
  const core::Point2 center = c.control[0] + side * radius / la * core::perpendicular_left(a);
  return Arc{center, radius, core::direction_of(c.control[0] - center), turn};
}

bool is_line(const lac::Segment& s) { return s.curvature_start == 0 && s.curvature_end == 0; }

bool is_line(const curve::Bezier2& c) { return c.control.size() == 2; }

lac::Chain chain_of(const Arc& arc) {
  const double side = arc.turn > 0 ? 1 : -1;
  lac::Chain chain;
  chain.start = {point_on(arc, arc.start), core::wrap_angle(arc.start + side * core::kPi / 2)};
  const double curvature = side / arc.radius;
  chain.pieces.push_back({-1, std::abs(arc.turn) * arc.radius, curvature, curvature});
  chain.closed = std::abs(arc.turn) >= 2 * core::kPi * (1 - kTolerance);
  return chain;
}

std::optional<Arc> joined(const Arc& first, const Arc& second) {
  const double size = kTolerance * (first.radius + norm(first.center - core::Point2{}));
  const double turn = first.turn + second.turn;
  const bool same = distance(first.center, second.center) <= 4 * size &&
                    std::abs(first.radius - second.radius) <= 4 * size &&
                    first.turn * second.turn > 0 &&
                    std::abs(turn) <= 2 * core::kPi * (1 + kTolerance);
  const auto gap =
      distance(point_on(first, first.start + first.turn), point_on(second, second.start));
  if (!same || gap > 8 * size) return std::nullopt;
  return Arc{first.center, first.radius, first.start, turn};
}

}  // namespace keyline::document
