#include "keyline/fairing/dense_curve.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "keyline/core/angle.h"
#include "keyline/fairing/local_pose.h"
#include "keyline/lac/sensitivity.h"

namespace keyline::fairing::detail {
namespace {

// Gauss and Legendre's four points on [0, 1].
constexpr std::array<double, 4> kNode = {0.06943184420297371, 0.33000947820757187,
                                         0.66999052179242813, 0.93056815579702629};
constexpr std::array<double, 4> kWeight = {0.17392742256872693, 0.32607257743127307,
                                           0.32607257743127307, 0.17392742256872693};

constexpr double kAgainst = 1e4;  // price of variation against its sense: what is left is unseen

}  // namespace

std::vector<int> pieces_of(const DenseCurve& curve) {
  std::vector<int> piece;
  for (std::size_t p = 0; p + 1 < curve.cut.size(); ++p)
    piece.insert(piece.end(), curve.cut[p + 1] - curve.cut[p], static_cast<int>(p));
  return piece;
}

void set_free(DenseCurve& curve) {
  const std::size_t nodes = curve.joints.size();
  curve.cut.resize(nodes);
  std::iota(curve.cut.begin(), curve.cut.end(), 0);
  curve.alpha.assign(nodes - 1, -1);
  curve.value.clear();
  for (const FitJoint& joint : curve.joints) curve.value.push_back(joint.curvature);
}

bool flat(const DenseCurve& curve, std::size_t piece) {
  return !curve.kind.empty() && curve.kind[piece] != PieceKind::curve;
}

std::vector<CellShape> shapes_of(DenseCurve& curve) {
  std::vector<CellShape> shapes(curve.joints.size() - 1);
  for (std::size_t p = 0; p + 1 < curve.cut.size(); ++p) {
    const double from = curve.at[curve.cut[p]];
    const double length = curve.at[curve.cut[p + 1]] - from;
    if (flat(curve, p)) curve.value[p + 1] = curve.value[p];
    const auto curvature = [&](double t) {
      if (flat(curve, p)) return lac::CurvatureValue{curve.value[p], 1, 0, 0};
      const double v = std::clamp((t - from) / length, 0.0, 1.0);
      if (curve.alpha[p] == -1)
        return lac::CurvatureValue{(1 - v) * curve.value[p] + v * curve.value[p + 1], 1 - v, v, 0};
      return lac::curvature_with_derivatives(curve.value[p], curve.value[p + 1], curve.alpha[p], v);
    };
    for (int c = curve.cut[p]; c < curve.cut[p + 1]; ++c) {
      const std::array<double, 3> t{curve.at[c], 0.5 * (curve.at[c] + curve.at[c + 1]),
                                    curve.at[c + 1]};
      for (int q = 0; q < 3; ++q) {
        const lac::CurvatureValue k = curvature(t[q]);
        shapes[c].curvature[q] = k.curvature;
        shapes[c].by_start[q] = k.by_start;
        shapes[c].by_end[q] = k.by_end;
      }
      curve.joints[c].curvature = shapes[c].curvature[0];
      curve.joints[c + 1].curvature = shapes[c].curvature[2];
    }
  }
  return shapes;
}

DenseCurve begun_at(const DenseCurve& curve, int node) {
  if (node == 0) return curve;
  DenseCurve next = curve;
  const int cells = static_cast<int>(curve.joints.size()) - 1;
  const double first = curve.at[node];
  for (int i = 0; i <= cells; ++i) {
    const bool over = node + i >= cells;
    const int from = (node + i) % cells;
    next.at[i] = curve.at[from] - first + (over ? 1 : 0);
    next.joints[i] = curve.joints[from];
    if (over) next.joints[i].direction += curve.turning;
  }
  for (Foot& foot : next.feet) foot.piece = (foot.piece - node + cells) % cells;
  set_free(next);
  next.sense.clear();
  return next;
}

double piece_price(const DenseCurve& curve, int piece) {
  if (curve.sense.empty()) return 1;
  return curve.sense[piece] * (curve.value[piece + 1] - curve.value[piece]) < 0 ? kAgainst : 1;
}

namespace {

/// Integrals from 0 to u of the parabolas that are 1 at one of 0, 1/2 and 1 and 0 at the others.
std::array<double, 3> parabolas(double u) {
  return {u * (1 + u * (-1.5 + u * (2.0 / 3))), u * u * (2 - u * (4.0 / 3)),
          u * u * (-0.5 + u * (2.0 / 3))};
}

double sum_of(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

}  // namespace

CellPlace place_in_cell(const DenseCurve& curve, const CellShape& shape, int cell, double v) {
  const FitJoint& from = curve.joints[cell];
  const double h = curve.at[cell + 1] - curve.at[cell];
  CellPlace place{from.position, 0, {}, {}, 0, 0};
  const double step = curve.length * h * v;
  core::Vector2 along;
  for (std::size_t q = 0; q < kNode.size(); ++q) {
    const std::array<double, 3> turned = parabolas(v * kNode[q]);
    const double direction = from.direction + h * sum_of(turned, shape.curvature);
    const core::Vector2 t{kWeight[q] * std::cos(direction), kWeight[q] * std::sin(direction)};
    const core::Vector2 n = core::perpendicular_left(t);
    along = along + t;
    place.by_start = place.by_start + sum_of(turned, shape.by_start) * n;
    place.by_end = place.by_end + sum_of(turned, shape.by_end) * n;
  }
  const std::array<double, 3> turned = parabolas(v);
  place.angle = from.direction + h * sum_of(turned, shape.curvature);
  place.angle_by_start = h * sum_of(turned, shape.by_start);
  place.angle_by_end = h * sum_of(turned, shape.by_end);
  place.at = from.position + step * along;
  place.by_start = (step * h) * place.by_start;
  place.by_end = (step * h) * place.by_end;
  return place;
}

double offset_of(const DenseCurve& curve, const std::vector<CellShape>& shapes,
                 const FitPoint& point, const Foot& foot) {
  const CellPlace s = place_in_cell(curve, shapes[foot.piece], foot.piece, foot.fraction);
  const core::Vector2 tangent{std::cos(s.angle), std::sin(s.angle)};
  return point.share * core::cross(tangent, point.position - s.at);
}

void move_foot(const DenseCurve& curve, const std::vector<CellShape>& shapes, const FitPoint& point,
               Foot& foot) {
  const int count = static_cast<int>(curve.joints.size()) - 1;
  for (int hop = 0; hop < 6; ++hop) {
    const CellShape& shape = shapes[foot.piece];
    const CellPlace s = place_in_cell(curve, shape, foot.piece, foot.fraction);
    const core::Vector2 tangent{std::cos(s.angle), std::sin(s.angle)};
    const core::Vector2 miss = point.position - s.at;
    const double k =
        std::lerp(shape.curvature[0], shape.curvature[2], foot.fraction) / curve.length;
    const double bend = std::max(0.25, 1 - k * core::cross(tangent, miss));
    const double cell = (curve.at[foot.piece + 1] - curve.at[foot.piece]) * curve.length;
    const double to = foot.fraction + core::dot(miss, tangent) / bend / cell;
    const bool back = to < 0 && (curve.closed || foot.piece > 0);
    const bool on = to > 1 && (curve.closed || foot.piece + 1 < count);
    if (!back && !on) {
      foot.fraction = std::clamp(to, 0.0, 1.0);
      return;
    }
    foot.piece = (foot.piece + (on ? 1 : count - 1)) % count;
    foot.fraction = on ? 0 : 1;
  }
}

double variation(const DenseCurve& curve, const std::vector<CellShape>& shapes, bool priced) {
  double sum = 0;
  for (std::size_t p = 0; p + 1 < curve.cut.size(); ++p) {
    double piece = 0;
    for (int c = curve.cut[p]; c < curve.cut[p + 1]; ++c) {
      const double change = shapes[c].curvature[2] - shapes[c].curvature[0];
      piece += change * change / (curve.at[c + 1] - curve.at[c]);
    }
    sum += piece * (priced ? piece_price(curve, static_cast<int>(p)) : 1);
  }
  return sum;
}

DenseCurve dense_curve(const std::vector<FitPoint>& points, bool closed, int least) {
  const Track track = make_track(points, closed);
  const std::size_t gaps = closed ? points.size() : points.size() - 1;
  const double widest = track.total / least;
  DenseCurve curve;
  curve.closed = closed;
  curve.length = track.total;
  for (std::size_t j = 0; j < gaps; ++j) {
    const double from = track.at(static_cast<long>(j));
    const double gap = track.at(static_cast<long>(j) + 1) - from;
    const int cells = std::max(1, static_cast<int>(std::ceil(gap / widest - 1e-9)));
    curve.feet.push_back({static_cast<int>(curve.at.size()), 0});
    for (int c = 0; c < cells; ++c) curve.at.push_back((from + gap * c / cells) / track.total);
  }
  curve.at.push_back(1);
  if (!closed) curve.feet.push_back({static_cast<int>(curve.at.size()) - 2, 1});
  for (const double t : curve.at) {
    FitJoint joint = local_pose(track, t * track.total, 0.01 * track.total);
    if (!curve.joints.empty()) {
      const double before = curve.joints.back().direction;
      joint.direction = before + core::wrap_angle(joint.direction - before);
    }
    joint.curvature *= track.total;
    curve.joints.push_back(joint);
  }
  if (closed) {
    const double turn = curve.joints.back().direction - curve.joints.front().direction;
    curve.turning = 2 * core::kPi * std::round(turn / (2 * core::kPi));
    curve.joints.back() = curve.joints.front();
    curve.joints.back().direction += curve.turning;
  }
  set_free(curve);
  return curve;
}

}  // namespace keyline::fairing::detail
