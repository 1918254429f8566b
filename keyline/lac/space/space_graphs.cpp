#include "keyline/lac/space/space_graphs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "keyline/core/point.h"

namespace keyline::lac {
namespace {

using core::Vector3;

constexpr int kPlaces = 32;
constexpr int kDerivatives = 4;

/// First to fourth derivative of a polynomial Bézier.
std::array<Vector3, kDerivatives> derivatives(const curve::Bezier3& c, double t) {
  std::array<Vector3, kDerivatives> all{};
  std::vector<Vector3> d;
  for (const core::Point3& p : c.control) d.push_back(p - core::Point3{});
  for (std::size_t order = 0; order < all.size() && d.size() > 1; ++order) {
    const auto degree = static_cast<double>(d.size() - 1);
    for (std::size_t i = 0; i + 1 < d.size(); ++i) d[i] = degree * (d[i + 1] - d[i]);
    d.pop_back();
    std::vector<Vector3> b = d;
    for (std::size_t n = b.size(); n > 1; --n)
      for (std::size_t i = 0; i + 1 < n; ++i) b[i] = (1 - t) * b[i] + t * b[i + 1];
    all[order] = b[0];
  }
  return all;
}

struct GraphPoint {
  double x = 0;
  double y = 0;
};

/// A law's value and rate as a point of its graph: rho = 1/value, rho ds/drho = -value/rate.
void add(std::vector<GraphPoint>& graph, double value, double rate) {
  const GraphPoint p{-std::log(std::abs(value)), std::log(std::abs(value / rate))};
  if (std::isfinite(p.x) && std::isfinite(p.y)) graph.push_back(p);
}

std::optional<GraphLine> line_of(const std::vector<GraphPoint>& graph) {
  constexpr std::size_t kFewest = 8;
  if (graph.size() < kFewest) return std::nullopt;
  const auto n = static_cast<double>(graph.size());
  GraphPoint mean;
  for (const GraphPoint& p : graph) mean = {mean.x + p.x / n, mean.y + p.y / n};
  double xx = 0;
  double xy = 0;
  double yy = 0;
  for (const GraphPoint& p : graph) {
    xx += (p.x - mean.x) * (p.x - mean.x);
    xy += (p.x - mean.x) * (p.y - mean.y);
    yy += (p.y - mean.y) * (p.y - mean.y);
  }
  constexpr double kSameRadius = 1e-6;
  if (!(xx > kSameRadius * kSameRadius * n)) return std::nullopt;
  return GraphLine{xy / xx, std::max(0.0, yy - xy * xy / xx) / n};
}

}  // namespace

GraphLines graph_lines(std::span<const curve::Bezier3> pieces) {
  std::vector<GraphPoint> curvature;
  std::vector<GraphPoint> torsion;
  for (const curve::Bezier3& piece : pieces)
    for (int i = 0; i < kPlaces; ++i) {
      const auto [r1, r2, r3, r4] = derivatives(piece, (i + 0.5) / kPlaces);
      const double speed = norm(r1);
      const Vector3 bend = cross(r1, r2);
      const Vector3 bend_by = cross(r1, r3);
      const double size = norm(bend);
      const double speed_by = dot(r1, r2) / speed;
      const double kappa = size / std::pow(speed, 3);
      const double kappa_by =
          dot(bend, bend_by) / size / std::pow(speed, 3) - 3 * kappa * speed_by / speed;
      add(curvature, kappa, kappa_by / speed);
      const double square = size * size;
      const double tau = dot(bend, r3) / square;
      const double tau_by = dot(bend, r4) / square - 2 * tau * dot(bend, bend_by) / square;
      add(torsion, tau, tau_by / speed);
    }
  return {line_of(curvature), line_of(torsion)};
}

}  // namespace keyline::lac
