#include "keyline/sketch/quintics.h"

#include <cmath>

namespace keyline::sketch {
namespace {

using core::Point2;
using core::Vector2;
using curve::Bezier2;

/// Moves q2 along the normal of the edge q0 q1 so that the curvature at q0 becomes `curvature`
/// (positive: q2 left of the edge from q0 to q1).
void bend(Point2 q0, Point2 q1, Point2& q2, double curvature) {
  const Vector2 edge = q1 - q0;
  const double length = core::norm(edge);
  if (!(length > 0)) return;
  const Vector2 normal = core::perpendicular_left(edge) / length;
  const double wanted = 1.25 * curvature * length * length;
  q2 = q2 + (wanted - core::dot(q2 - q1, normal)) * normal;
}

double curvature_of(Point2 q0, Point2 q1, Point2 q2) {
  const Vector2 edge = q1 - q0;
  const double length = core::norm(edge);
  return length > 0 ? 0.8 * core::cross(edge, q2 - q1) / (length * length * length) : 0;
}

}  // namespace

std::vector<Bezier2> quadratics(const std::vector<Point2>& vertices, bool closed) {
  std::vector<Bezier2> pieces;
  const std::size_t n = vertices.size();
  const auto middle = [&](std::size_t i, std::size_t j) {
    return core::mix(vertices[i % n], vertices[j % n], 0.5);
  };
  if (closed) {
    for (std::size_t i = 0; i < n; ++i)
      pieces.push_back({{middle(i, i + 1), vertices[(i + 1) % n], middle(i + 1, i + 2)}, {}});
    return pieces;
  }
  if (n == 2) return {{{vertices[0], middle(0, 1), vertices[1]}, {}}};
  for (std::size_t i = 1; i + 1 < n; ++i)
    pieces.push_back({{i == 1 ? vertices[0] : middle(i - 1, i), vertices[i],
                       i + 2 == n ? vertices[n - 1] : middle(i, i + 1)},
                      {}});
  return pieces;
}

std::vector<Bezier2> elevated(const std::vector<Bezier2>& pieces) {
  std::vector<Bezier2> quintics;
  for (const Bezier2& piece : pieces)
    quintics.push_back(curve::elevate_degree(piece, 5 - curve::degree(piece)));
  return quintics;
}

double start_curvature(const Bezier2& q) {
  return curvature_of(q.control[0], q.control[1], q.control[2]);
}

double end_curvature(const Bezier2& q) {
  return -curvature_of(q.control[5], q.control[4], q.control[3]);
}

void make_curvature_continuous(std::vector<Bezier2>& quintics, bool closed) {
  const std::size_t n = quintics.size();
  for (std::size_t i = 0; i + (closed ? 0 : 1) < n; ++i) {
    Bezier2& before = quintics[i];
    Bezier2& after = quintics[(i + 1) % n];
    const double mean = 0.5 * (end_curvature(before) + start_curvature(after));
    bend(before.control[5], before.control[4], before.control[3], -mean);
    bend(after.control[0], after.control[1], after.control[2], mean);
  }
}

}  // namespace keyline::sketch
