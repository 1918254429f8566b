#include "keyline/fairing/dense_places.h"

#include <cmath>

namespace keyline::fairing::detail {
namespace {

constexpr double kCurvatureShare = 0.1;  // of the seam's gap of curvature in the sum

void add_seam(Gaps& gaps, const DenseCurve& curve) {
  const int held = static_cast<int>(curve.hold_end);
  if (!curve.closed && held == 0) return;
  const FitJoint& first = curve.closed ? curve.joints.front() : curve.held_end;
  const FitJoint& last = curve.joints.back();
  gaps.seam << last.position.x - first.position.x, last.position.y - first.position.y,
      last.direction - first.direction - (curve.closed ? curve.turning : 0),
      last.curvature - first.curvature * (curve.closed ? 1 : curve.length), 0, 0;
  for (int k = 0; k < 4; ++k)
    if (!curve.closed && (k > held || (k == 0 && curve.slides_end))) gaps.seam(k) = 0;
  gaps.sum += gaps.seam.head<3>().lpNorm<1>() + kCurvatureShare * std::abs(gaps.seam(3));
}

}  // namespace

Gaps gaps_of(const DenseCurve& curve, const Shapes& shapes) {
  Gaps gaps;
  gaps.end.reserve(shapes.size());
  gaps.cell.reserve(shapes.size());
  for (std::size_t i = 0; i + 1 < curve.joints.size(); ++i) {
    gaps.end.push_back(place_in_cell(curve, shapes[i], static_cast<int>(i), 1));
    const CellPlace& end = gaps.end.back();
    const FitJoint& to = curve.joints[i + 1];
    gaps.cell.push_back(
        {end.at.x - to.position.x, end.at.y - to.position.y, end.angle - to.direction});
    gaps.sum += gaps.cell.back().lpNorm<1>();
  }
  add_seam(gaps, curve);
  return gaps;
}

Spots spots_of(const DenseCurve& curve, const Shapes& shapes, const std::vector<FitPoint>& points) {
  Spots spots;
  spots.place.reserve(points.size());
  spots.offset.reserve(points.size());
  for (std::size_t j = 0; j < points.size(); ++j) {
    spots.place.push_back(place_of(curve, shapes, curve.feet[j]));
    spots.offset.push_back(offset_of(points[j], spots.place.back()));
  }
  return spots;
}

namespace {

/// What the curve jumps by on the way from one cell to another, the shorter one where it is closed.
core::Vector2 jump_between(int from, int to, const DenseCurve& curve, const Gaps& gaps) {
  const int count = static_cast<int>(gaps.cell.size());
  int steps = to - from;
  if (curve.closed && std::abs(steps) > count / 2) steps -= steps > 0 ? count : -count;
  const int first = steps > 0 ? from : to;
  core::Vector2 jump{0, 0};
  for (int k = 0; k < std::abs(steps); ++k) {
    const int i = (first + k) % count;
    jump = jump + core::Vector2{gaps.cell[i](0), gaps.cell[i](1)};
    if (i + 1 == count) jump = jump + core::Vector2{gaps.seam(0), gaps.seam(1)};
  }
  return steps > 0 ? jump : -jump;
}

}  // namespace

std::vector<double> without_gaps(const Spots& spots, const std::vector<Foot>& before,
                                 const DenseCurve& curve, const Gaps& gaps,
                                 const std::vector<FitPoint>& points) {
  std::vector<double> offset = spots.offset;
  for (std::size_t j = 0; j < offset.size(); ++j) {
    const int from = before[j].piece;
    const int to = curve.feet[j].piece;
    if (from == to) continue;
    const core::Vector2 jump = jump_between(from, to, curve, gaps);
    offset[j] -= points[j].share * core::cross(spots.place[j].tangent, jump);
  }
  return offset;
}

double along(const Spots& spots, const std::vector<FitPoint>& points, std::size_t j) {
  return core::dot(spots.place[j].at - points[j].position, spots.place[j].tangent);
}

Vector6 derivative(const DenseCurve& curve, const CellPlace& place, int cell,
                   core::Vector2 direction) {
  const core::Vector2 arm = place.at - curve.joints[cell].position;
  Vector6 d;
  d << direction.x, direction.y, core::cross(arm, direction), core::dot(place.by_start, direction),
      core::dot(place.by_end, direction), core::dot(arm, direction) / curve.length;
  return d;
}

// The offset is what the point lies left of the curve: the curve's own move, reversed.
Vector6 by_offset(const DenseCurve& curve, const Spots& spots, const std::vector<FitPoint>& points,
                  std::size_t j) {
  const CellPlace& s = spots.place[j];
  return -points[j].share *
         derivative(curve, s, curve.feet[j].piece, core::perpendicular_left(s.tangent));
}

}  // namespace keyline::fairing::detail
