#include "keyline/fairing/straight_run.h"

#include <algorithm>
#include <cmath>

#include "keyline/core/angle.h"

namespace keyline::fairing::detail {
namespace {

// Of the length: what a point's own digits put it off the line.
constexpr double kRounding = 1e-12;

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
    const double spread = std::max(p.high, -p.low);
    if (!(x > before) || !(aside + spread <= kRounding)) return std::nullopt;
    chain.feet.push_back({0, x / length});
    before = x;
  }
  const double direction = core::direction_of(chord);
  chain.joints = {{first, direction, 0}, {points.back().position, direction, 0}};
  chain.pieces = {{.length = length, .kind = PieceKind::line}};
  return chain;
}

}  // namespace keyline::fairing::detail
