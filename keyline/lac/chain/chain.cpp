#include "keyline/lac/chain/chain.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>

#include "keyline/core/angle.h"

namespace keyline::lac {
namespace {

using core::Point2;
using core::Pose2;

/// The derivatives of a chain of that length, by those of one of its segments.
curve::Jet2 jet_within(const Segment& segment, curve::Jet2 result, double whole) {
  const double ratio = whole / segment.length;
  result.first = ratio * result.first;
  result.second = ratio * ratio * result.second;
  result.third = ratio * ratio * ratio * result.third;
  return result;
}

}  // namespace

core::Result<void> validate(const Chain& chain) {
  if (chain.pieces.empty()) {
    return core::fail(core::ErrorCode::bad_input, "the chain has no pieces");
  }
  for (std::size_t i = 0; i < chain.pieces.size(); ++i) {
    const auto valid = validate(place(chain.pieces[i], chain.start));
    if (valid) continue;
    core::Failure failure = valid.error();
    failure.path = "pieces[" + std::to_string(i) + "]";
    return std::unexpected(std::move(failure));
  }
  return {};
}

JointGap largest_joint_gap(const Chain& chain) {
  JointGap gap;
  const std::size_t n = chain.pieces.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (i + 1 == n && !chain.closed) break;
    const Piece& before = chain.pieces[i];
    const Piece& after = chain.pieces[(i + 1) % n];
    gap.curvature = std::max(gap.curvature, std::abs(after.curvature_start - before.curvature_end));
    gap.curvature_rate = std::max(gap.curvature_rate,
                                  std::abs(curvature_rate(after, 0) - curvature_rate(before, 1)));
  }
  return gap;
}

double arc_length(const Chain& chain) {
  double sum = 0;
  for (const Piece& piece : chain.pieces) sum += piece.length;
  return sum;
}

double total_turning(const Chain& chain) {
  double sum = 0;
  for (const Piece& piece : chain.pieces) sum += total_turning(piece);
  return sum;
}

std::vector<double> joint_lengths(const Chain& chain) {
  std::vector<double> at{0};
  at.reserve(chain.pieces.size() + 1);
  for (const Piece& piece : chain.pieces) at.push_back(at.back() + piece.length);
  return at;
}

namespace {

/// In piece i, from one length to another of the whole.
ChainLocation within(std::size_t i, double from, double to, double whole, double t) {
  return {i, std::clamp((t * whole - from) / (to - from), 0.0, 1.0)};
}

}  // namespace

ChainLocation located(std::span<const double> joints, double t) {
  const std::size_t last = joints.size() - 2;
  if (t >= 1) return {last, 1};
  const double whole = joints.back();
  const auto inner = joints.subspan(1, last);
  const auto after = std::ranges::upper_bound(inner, t, {}, [&](double s) { return s / whole; });
  const auto i = static_cast<std::size_t>(after - inner.begin());
  return within(i, joints[i], joints[i + 1], whole, t);
}

/// As located(), without a list of lengths: a single place costs no allocation.
ChainLocation locate(const Chain& chain, double t) {
  const std::size_t last = chain.pieces.size() - 1;
  if (t >= 1) return {last, 1};
  const double whole = arc_length(chain);
  double from = 0;
  double to = chain.pieces[0].length;
  std::size_t i = 0;
  for (; i < last && t >= to / whole; to += chain.pieces[++i].length) from = to;
  return within(i, from, to, whole, t);
}

ChainLocation locate(const PlacedChain& placed, double t) {
  return located(placed.joint_lengths(), t);
}

std::vector<Segment> segments(const Chain& chain) {
  std::vector<Segment> placed;
  placed.reserve(chain.pieces.size());
  Pose2 pose = chain.start;
  for (const Piece& piece : chain.pieces) {
    placed.push_back(place(piece, pose));
    pose = end_pose(placed.back());
  }
  return placed;
}

Segment segment_at(const Chain& chain, std::size_t i) {
  Pose2 pose = chain.start;
  for (std::size_t k = 0; k < i; ++k) pose = end_pose(place(chain.pieces[k], pose));
  return place(chain.pieces[i], pose);
}

std::vector<Pose2> joints(const Chain& chain) {
  std::vector<Pose2> poses{chain.start};
  for (const Piece& piece : chain.pieces) poses.push_back(end_pose(place(piece, poses.back())));
  return poses;
}

Pose2 end_pose(const Chain& chain) {
  Pose2 pose = chain.start;
  for (const Piece& piece : chain.pieces) pose = end_pose(place(piece, pose));
  return pose;
}

double curvature(const Chain& chain, double t) {
  const ChainLocation at = locate(chain, t);
  return curvature(chain.pieces[at.piece], at.t);
}

double curvature_rate(const Chain& chain, double t) {
  const ChainLocation at = locate(chain, t);
  return curvature_rate(chain.pieces[at.piece], at.t);
}

double tangent_angle(const Chain& chain, double t) {
  const ChainLocation at = locate(chain, t);
  double angle = chain.start.direction;
  for (std::size_t i = 0; i < at.piece; ++i) angle += total_turning(chain.pieces[i]);
  return angle + turning(chain.pieces[at.piece], at.t);
}

Point2 evaluate(const Chain& chain, double t) {
  const ChainLocation at = locate(chain, t);
  return evaluate(segment_at(chain, at.piece), at.t);
}

curve::Jet2 jet(const Chain& chain, double t) {
  const ChainLocation at = locate(chain, t);
  const Segment segment = segment_at(chain, at.piece);
  return jet_within(segment, jet(segment, at.t), arc_length(chain));
}

PlacedChain::PlacedChain(Chain chain)
    : chain_(std::move(chain)),
      segments_(lac::segments(chain_)),
      joint_lengths_(lac::joint_lengths(chain_)) {
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    if (std::abs(total_turning(segments_[i])) > kTabled)
      tables_.emplace(i, std::make_shared<const SegmentTable>(segments_[i]));
  }
}

Point2 PlacedChain::point(const ChainLocation& at) const {
  const auto table = tables_.find(at.piece);
  return table == tables_.end() ? evaluate(segments_[at.piece], at.t) : table->second->point(at.t);
}

Point2 evaluate(const PlacedChain& placed, double t) { return placed.point(locate(placed, t)); }

double curvature(const PlacedChain& placed, double t) {
  const ChainLocation at = locate(placed, t);
  return curvature(placed.segments()[at.piece], at.t);
}

curve::Jet2 jet(const PlacedChain& placed, double t) {
  const ChainLocation at = locate(placed, t);
  const Segment& segment = placed.segments()[at.piece];
  return jet_within(segment, jet_from(segment, at.t, placed.point(at)), placed.length());
}

std::vector<double> breakpoints(const Chain& chain) {
  const double whole = arc_length(chain);
  std::vector<double> at{0};
  double before = 0;
  for (const Piece& piece : chain.pieces) {
    const double inner = inflection(piece);
    if (inner > 0) at.push_back((before + inner * piece.length) / whole);
    before += piece.length;
    at.push_back(before / whole);
  }
  at.back() = 1;
  return at;
}

std::vector<Point2> sample(const Chain& chain, int n) {
  if (n < 2) throw core::InvalidInput("sample: fewer than two points asked for");
  const std::vector<Segment> placed = segments(chain);
  const std::vector<double> joints = joint_lengths(chain);
  std::vector<Point2> points(n);
  std::vector<double> at;
  int done = 0;
  for (std::size_t i = 0; i < placed.size(); ++i) {
    at.clear();
    for (int k = done; k < n; ++k) {
      const ChainLocation where = located(joints, k / (n - 1.0));
      if (where.piece != i) break;
      at.push_back(where.t);
    }
    sample(placed[i], at, std::span(points).subspan(done, at.size()));
    done += static_cast<int>(at.size());
  }
  return points;
}

Chain part(const Chain& chain, double t0, double t1) {
  const ChainLocation from = locate(chain, t0);
  const ChainLocation to = locate(chain, t1);
  const Segment first = segment_at(chain, from.piece);
  Chain result{pose_at(first, from.t), {}, false};
  for (std::size_t i = from.piece; i <= to.piece; ++i) {
    const double low = i == from.piece ? from.t : 0;
    const double high = i == to.piece ? to.t : 1;
    if (high > low) result.pieces.push_back(part(chain.pieces[i], low, high));
  }
  return result;
}

Chain reverse(const Chain& chain) {
  const Pose2 end = end_pose(chain);
  Chain result{{end.position, core::wrap_angle(end.direction + core::kPi)}, {}, chain.closed};
  for (auto it = chain.pieces.rbegin(); it != chain.pieces.rend(); ++it) {
    result.pieces.push_back(reversed(*it));
  }
  return result;
}

ChainPair split(const Chain& chain, double t) { return {part(chain, 0, t), part(chain, t, 1)}; }

Chain transform(const Chain& chain, const core::Similarity2& map) {
  Chain result{
      {apply(map, chain.start.position), chain.start.direction + map.rotation}, {}, chain.closed};
  for (const Piece& piece : chain.pieces) {
    result.pieces.push_back(piece_of(transform(place(piece, chain.start), map)));
  }
  return result;
}

}  // namespace keyline::lac
