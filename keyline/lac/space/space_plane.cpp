#include "keyline/lac/space/space_plane.h"

#include <cmath>
#include <limits>

#include "keyline/lac/segment/piece_shape.h"

namespace keyline::lac::detail::space {

using core::Vector3;

namespace {

/// The same with no curvature at its start where the inflection lies within rounding of it.
Piece bare_start(Piece p) {
  constexpr double kMet = 1e-12;  // radians, as end tangents are met
  if (!(p.alpha < 0) || p.curvature_start == p.curvature_end) return p;
  // By so much about the tangents turn where the inflection moves on to the end.
  const double missed =
      std::pow(std::abs(p.curvature_start / p.curvature_end), -p.alpha) * absolute_turning(p);
  if (missed < kMet) p.curvature_start = 0;
  return p;
}

/// drho/ds at the start of a piece that turns left (sense 1) or right (-1) there.
double start_rate(const Piece& p, double sense) {
  if (p.curvature_start == p.curvature_end) return 0;
  if (p.curvature_start == 0) return -std::numeric_limits<double>::infinity();
  return -sense * curvature_rate(p, 0) / (p.curvature_start * p.curvature_start);
}

/// Of the first curvature that there is.
double first_sense(const Chain& curve) {
  for (const Piece& p : curve.pieces)
    for (const double k : {p.curvature_start, p.curvature_end})
      if (k != 0) return k < 0 ? -1 : 1;
  return 1;
}

}  // namespace

ChordFrame plane_of(const Setting& setting) {
  const SpaceHermite& data = setting.data;
  const bool start_leaves = std::sin(setting.wanted.first) >= std::sin(setting.wanted.last);
  return chord_frame(data.end - data.start, start_leaves ? data.start_tangent : data.end_tangent);
}

std::array<double, 2> directions_in(const ChordFrame& plane, const SpaceHermite& data) {
  const auto angle = [&](Vector3 v) { return std::atan2(dot(v, plane.y), dot(v, plane.x)); };
  return {angle(data.start_tangent), angle(data.end_tangent)};
}

SpaceSolution in_plane(const ChordFrame& plane, const SpaceHermite& data, Chain curve,
                       const std::array<double, 2>& beta) {
  const double chord = norm(data.end - data.start);
  curve.pieces.front() = bare_start(curve.pieces.front());
  curve.pieces.back() = reversed(bare_start(reversed(curve.pieces.back())));
  const double sense = first_sense(curve);
  SpaceSolution solution;
  solution.planar = true;
  const double direction = curve.start.direction;
  const Vector3 tangent = unit(from(plane, {std::cos(direction), std::sin(direction), 0}));
  const Vector3 binormal = sense * plane.z;
  solution.chain.start = {data.start, tangent, cross(binormal, tangent), binormal};
  for (std::size_t i = 0; i < curve.pieces.size(); ++i) {
    const Piece& p = curve.pieces[i];
    solution.chain.pieces.push_back({p.alpha, beta[i], p.length * chord,
                                     sense * p.curvature_start / chord,
                                     sense * p.curvature_end / chord, 0, 0});
  }
  const Piece& first = curve.pieces.front();
  solution.length = sense * first.curvature_start * arc_length(curve);
  solution.lambda = start_rate(first, sense);
  return solution;
}

}  // namespace keyline::lac::detail::space
