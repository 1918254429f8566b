#include "keyline/fairing/straight_run.h"

#include <algorithm>
#include <cmath>

#include "keyline/core/angle.h"

namespace keyline::fairing::detail {
namespace {

// Of the length: what a point's own digits put it off the line.
constexpr double kRounding = 1e-12;

double spread_of(const FitPoint& p) { return std::max(p.high, -p.low); }

/// Centre of the circle through three points, from the first; empty where they lie on a line.
std::optional<core::Vector2> centre_from(core::Point2 first, core::Point2 second,
                                         core::Point2 third) {
  const core::Vector2 a = second - first;
  const core::Vector2 b = third - first;
  const double area = 2 * core::cross(a, b);
  if (!(std::abs(area) > kRounding * core::norm(a) * core::norm(b))) return std::nullopt;
  const double aa = core::dot(a, a);
  const double bb = core::dot(b, b);
  return core::Vector2{(b.y * aa - a.y * bb) / area, (a.x * bb - b.x * aa) / area};
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
    if (!(x > before) || !(aside + spread_of(p) <= kRounding)) return std::nullopt;
    chain.feet.push_back({0, x / length});
    before = x;
  }
  const double direction = core::direction_of(chord);
  chain.joints = {{first, direction, 0}, {points.back().position, direction, 0}};
  chain.pieces = {{.length = length, .kind = PieceKind::line}};
  return chain;
}

std::optional<FitChain> arc_chain(const std::vector<FitPoint>& points) {
  if (points.size() < 3) return std::nullopt;
  const core::Point2 first = points.front().position;
  const auto inwards =
      centre_from(first, points[points.size() / 2].position, points.back().position);
  if (!inwards) return std::nullopt;
  const core::Point2 centre = first + *inwards;
  const double radius = core::norm(*inwards);
  std::vector<double> turned{0};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const core::Point2 p = points[i].position;
    if (std::abs(core::distance(p, centre) - radius) + spread_of(points[i]) > kRounding)
      return std::nullopt;
    if (i == 0) continue;
    const double step = core::angle_between(points[i - 1].position - centre, p - centre);
    if (step == 0 || step * turned.back() < 0) return std::nullopt;
    turned.push_back(turned.back() + step);
  }
  const double turning = turned.back();
  const double curvature = std::copysign(1 / radius, turning);
  const double direction = core::direction_of(*inwards) - std::copysign(core::kPi / 2, turning);
  FitChain chain;
  for (const double angle : turned) chain.feet.push_back({0, angle / turning});
  chain.joints = {{first, direction, curvature},
                  {points.back().position, direction + turning, curvature}};
  chain.pieces = {{.length = radius * std::abs(turning), .kind = PieceKind::arc}};
  return chain;
}

}  // namespace keyline::fairing::detail
