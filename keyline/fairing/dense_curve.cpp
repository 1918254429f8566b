#include "keyline/fairing/dense_curve.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "keyline/core/angle.h"
#include "keyline/fairing/cell_nodes.h"
#include "keyline/fairing/local_pose.h"
#include "keyline/lac/segment/sensitivity.h"

namespace keyline::fairing::detail {
namespace {

constexpr double kReach = 0.01;     // of the length: what a first pose is fitted to, either way
constexpr double kTurn = 0.1;       // that a cell may make, for its sums to hold ten digits…
constexpr double kMostTurn = 6.3;   // …of what a gap may be taken to make
constexpr double kSameTurn = 1e-8;  // in sums over a cell and over its halves
constexpr int kMostParts = 16;      // of a cell: an inflection's neighbours never follow a parabola
constexpr double kWander = 2;       // a half circle is 1.6 times as long as its chord
constexpr double kWanderRoom = 4;   // tolerances

}  // namespace

std::vector<int> pieces_of(const DenseCurve& curve) {
  std::vector<int> piece;
  for (std::size_t p = 0; p + 1 < curve.cut.size(); ++p)
    piece.insert(piece.end(), curve.cut[p + 1] - curve.cut[p], static_cast<int>(p));
  return piece;
}

std::vector<signed char> sides_of_nodes(const DenseCurve& curve) {
  std::vector<signed char> side(curve.side.empty() ? 0 : curve.joints.size(), 0);
  for (std::size_t i = 0; i < curve.side.size(); ++i) side[curve.cut[i]] = curve.side[i];
  return side;
}

void set_free(DenseCurve& curve) {
  curve.side = sides_of_nodes(curve);
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

namespace {

/// Curvature along one piece, by its shares of the whole length.
class PieceBend {
 public:
  PieceBend(const DenseCurve& curve, std::size_t p)
      : a_(curve.value[p]),
        b_(curve.value[p + 1]),
        from_(curve.at[curve.cut[p]]),
        to_(curve.at[curve.cut[p + 1]]),
        flat_(flat(curve, p)),
        linear_(curve.alpha[p] == -1) {
    if (!flat_ && !linear_) bend_ = {a_, b_, curve.alpha[p]};
  }

  lac::CurvatureValue at(double t) const {
    if (flat_) return {a_, 1, 0, 0};
    const double v = std::clamp((t - from_) / (to_ - from_), 0.0, 1.0);
    if (linear_) return {(1 - v) * a_ + v * b_, 1 - v, v, 0};
    return bend_.at(v);
  }

 private:
  double a_;
  double b_;
  double from_;
  double to_;
  bool flat_;
  bool linear_;
  lac::PieceCurvature bend_;
};

}  // namespace

std::vector<CellShape> shapes_of(DenseCurve& curve) {
  std::vector<CellShape> shapes(curve.joints.size() - 1);
  for (std::size_t p = 0; p + 1 < curve.cut.size(); ++p) {
    if (flat(curve, p)) curve.value[p + 1] = curve.value[p];
    const auto set = [](CellShape& shape, std::size_t q, const lac::CurvatureValue& k) {
      shape.curvature[q] = k.curvature;
      shape.by_start[q] = k.by_start;
      shape.by_end[q] = k.by_end;
    };
    const PieceBend bend(curve, p);
    lac::CurvatureValue at = bend.at(curve.at[curve.cut[p]]);
    for (int c = curve.cut[p]; c < curve.cut[p + 1]; ++c) {
      set(shapes[c], 0, at);
      set(shapes[c], 1, bend.at(0.5 * (curve.at[c] + curve.at[c + 1])));
      at = bend.at(curve.at[c + 1]);
      set(shapes[c], 2, at);
      curve.joints[c].curvature = shapes[c].curvature[0];
      curve.joints[c + 1].curvature = shapes[c].curvature[2];
      const double direction = curve.joints[c].direction;
      shapes[c].tangent = {std::cos(direction), std::sin(direction)};
    }
  }
  return shapes;
}

DenseCurve begun_at(const DenseCurve& curve, int node) {
  if (node == 0) return curve;
  DenseCurve next = curve;
  const std::vector<signed char> side = sides_of_nodes(curve);
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
  next.side.clear();
  set_free(next);
  for (int i = 0; i <= cells && !side.empty(); ++i) next.side.push_back(side[(node + i) % cells]);
  next.sense.clear();
  return next;
}

CellPlace place_in_cell(const DenseCurve& curve, const CellShape& shape, int cell, double v) {
  const FitJoint& from = curve.joints[cell];
  const double h = curve.at[cell + 1] - curve.at[cell];
  CellPlace place{from.position, 0, {}, {}, {}, 0, 0};
  const double step = curve.length * h * v;
  core::Vector2 along;
  const Nodes nodes(shape, h, v);
  for (std::size_t q = 0; q < kNode.size(); ++q) {
    const core::Vector2 t = nodes.tangent(shape.tangent, q);
    const core::Vector2 n = core::perpendicular_left(t);
    along = along + t;
    place.by_start = place.by_start + nodes.sum(q, shape.by_start) * n;
    place.by_end = place.by_end + nodes.sum(q, shape.by_end) * n;
  }
  const std::array<double, 3> share = parabolas(v);
  const double turn = h * sum_of(share, shape.curvature);
  place.angle = from.direction + turn;
  place.tangent = turned(shape.tangent, turn);
  place.angle_by_start = h * sum_of(share, shape.by_start);
  place.angle_by_end = h * sum_of(share, shape.by_end);
  place.at = from.position + step * along;
  place.by_start = (step * h) * place.by_start;
  place.by_end = (step * h) * place.by_end;
  return place;
}

namespace {

/// Point and tangent alone.
struct CellPoint {
  core::Point2 at;
  core::Vector2 tangent;
};
CellPoint point_in_cell(const DenseCurve& curve, const CellShape& shape, int cell, double v) {
  const FitJoint& from = curve.joints[cell];
  const double h = curve.at[cell + 1] - curve.at[cell];
  core::Vector2 along;
  const Nodes nodes(shape, h, v);
  for (std::size_t q = 0; q < kNode.size(); ++q) along = along + nodes.tangent(shape.tangent, q);
  const double turn = h * sum_of(parabolas(v), shape.curvature);
  return {from.position + curve.length * h * v * along, turned(shape.tangent, turn)};
}

}  // namespace

CellPlace place_of(const DenseCurve& curve, const std::vector<CellShape>& shapes,
                   const Foot& foot) {
  return place_in_cell(curve, shapes[foot.piece], foot.piece, foot.fraction);
}

double place_along(const DenseCurve& curve, const Foot& foot) {
  return std::lerp(curve.at[foot.piece], curve.at[foot.piece + 1], foot.fraction);
}

bool wanders(const DenseCurve& curve, const std::vector<FitPoint>& points, double tolerance) {
  const std::size_t n = points.size();
  for (std::size_t j = 0; j + (curve.closed ? 0 : 1) < n; ++j) {
    const std::size_t next = (j + 1) % n;
    double way = place_along(curve, curve.feet[next]) - place_along(curve, curve.feet[j]);
    if (curve.closed) way -= std::floor(way);
    const double gap = core::distance(points[j].position, points[next].position);
    if (way < 0.5 && way * curve.length > kWander * gap + kWanderRoom * tolerance) return true;
  }
  return false;
}

double offset_of(const FitPoint& point, const CellPlace& place) {
  return point.share * core::cross(place.tangent, point.position - place.at);
}

void move_foot(const DenseCurve& curve, const std::vector<CellShape>& shapes, const FitPoint& point,
               Foot& foot) {
  const int count = static_cast<int>(curve.joints.size()) - 1;
  for (int hop = 0; hop < 6; ++hop) {
    const CellShape& shape = shapes[foot.piece];
    const auto [at, tangent] = point_in_cell(curve, shape, foot.piece, foot.fraction);
    const core::Vector2 miss = point.position - at;
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

PieceEnergy energy_of(const DenseCurve& curve, std::size_t piece) {
  if (flat(curve, piece)) return {};
  PieceEnergy energy = piece_energy(curve.value[piece], curve.value[piece + 1], curve.alpha[piece]);
  const double share = curve.at[curve.cut[piece + 1]] - curve.at[curve.cut[piece]];
  const double by = 1 / std::sqrt(share);
  return {by * energy.root, by * energy.by_start, by * energy.by_end};
}

double variation(const DenseCurve& curve) {
  double sum = 0;
  for (std::size_t p = 0; p + 1 < curve.cut.size(); ++p) {
    const double root = energy_of(curve, p).root;
    sum += root * root;
  }
  return sum;
}

namespace {

/// What a piece turns between two places, by Simpson's rule over so many parts.
double turn_between(const DenseCurve& curve, std::size_t p, double from, double to, int parts) {
  const PieceBend bend(curve, p);
  const auto k = [&](double u) { return bend.at(std::lerp(from, to, u / (2 * parts))).curvature; };
  double sum = k(0) + k(2 * parts);
  for (int i = 1; i < 2 * parts; ++i) sum += (i % 2 == 1 ? 4 : 2) * k(i);
  return sum * (to - from) / (6 * parts);
}

int parts_of(const DenseCurve& curve, std::size_t p, int cell) {
  if (flat(curve, p) || curve.alpha[p] == -1) return 1;
  const double from = curve.at[cell];
  const double to = curve.at[cell + 1];
  int parts = 1;
  double turn = turn_between(curve, p, from, to, 1);
  for (; parts < kMostParts; parts *= 2) {
    const double finer = turn_between(curve, p, from, to, 2 * parts);
    if (std::abs(finer - turn) < kSameTurn) break;
    turn = finer;
  }
  return parts;
}

}  // namespace

void refine_cells(DenseCurve& curve) {
  const std::vector<int> piece = pieces_of(curve);
  const std::vector<CellShape> shapes = shapes_of(curve);
  std::vector<int> first;  // new node of every old one
  std::vector<int> parts;
  DenseCurve next = curve;
  next.at.clear();
  next.joints.clear();
  const int cells = static_cast<int>(shapes.size());
  for (int c = 0; c < cells; ++c) {
    first.push_back(static_cast<int>(next.at.size()));
    parts.push_back(parts_of(curve, piece[c], c));
    next.at.push_back(curve.at[c]);
    next.joints.push_back(curve.joints[c]);
    for (int i = 1; i < parts[c]; ++i) {
      const double v = static_cast<double>(i) / parts[c];
      const CellPlace place = place_in_cell(curve, shapes[c], c, v);
      next.at.push_back(std::lerp(curve.at[c], curve.at[c + 1], v));
      next.joints.push_back({place.at, place.angle, curve.joints[c].curvature});
    }
  }
  first.push_back(static_cast<int>(next.at.size()));
  next.at.push_back(curve.at[cells]);
  next.joints.push_back(curve.joints[cells]);
  for (int& cut : next.cut) cut = first[cut];
  for (Foot& foot : next.feet) {
    const double place = foot.fraction * parts[foot.piece];
    const int part = std::clamp(static_cast<int>(place), 0, parts[foot.piece] - 1);
    foot = {first[foot.piece] + part, place - part};
  }
  curve = std::move(next);
  shapes_of(curve);  // sets the new joints' curvatures
}

DenseCurve dense_curve(const std::vector<FitPoint>& points, bool closed, int least) {
  const Track track = make_track(points, closed);
  const std::size_t gaps = closed ? points.size() : points.size() - 1;
  const double widest = track.total / least;
  DenseCurve curve;
  curve.closed = closed;
  curve.length = track.total;
  const double reach = kReach * track.total;
  FitJoint before = local_pose(track, 0, reach);
  for (std::size_t j = 0; j < gaps; ++j) {
    const double from = track.at(static_cast<long>(j));
    const double gap = track.at(static_cast<long>(j) + 1) - from;
    const FitJoint after = local_pose(track, from + gap, reach);
    const double turn = gap * std::max(std::abs(before.curvature), std::abs(after.curvature));
    const double parts = std::max(gap / widest, std::min(turn, kMostTurn) / kTurn);
    const int cells = std::max(1, static_cast<int>(std::ceil(parts - 1e-9)));
    before = after;
    curve.feet.push_back({static_cast<int>(curve.at.size()), 0});
    for (int c = 0; c < cells; ++c) curve.at.push_back((from + gap * c / cells) / track.total);
  }
  curve.at.push_back(1);
  if (!closed) curve.feet.push_back({static_cast<int>(curve.at.size()) - 2, 1});
  for (const double t : curve.at) {
    FitJoint joint = local_pose(track, t * track.total, reach);
    if (!curve.joints.empty()) {
      const double last = curve.joints.back().direction;
      joint.direction = last + core::wrap_angle(joint.direction - last);
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
