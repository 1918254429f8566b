#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "keyline/core/error.h"
#include "keyline/core/pose.h"
#include "keyline/core/similarity.h"
#include "keyline/curve/jet.h"
#include "keyline/lac/segment/segment.h"
#include "keyline/lac/segment/segment_table.h"

namespace keyline::lac {

/// Pieces laid end to end with common tangents: G1 by construction, G2 where neighbours share the
/// curvature at their joint. Models curve::PlanarCurve; parameter t = fraction of the whole arc
/// length. closed says that the end is meant to meet the start; it does not make it so.
struct Chain {
  core::Pose2 start;
  std::vector<Piece> pieces;
  bool closed = false;
  friend bool operator==(const Chain&, const Chain&) = default;
};

inline Chain chain_of(const Segment& s) { return {s.start, {piece_of(s)}, false}; }

/// bad_input if there is no piece or one is not valid; the failure's path names the piece.
core::Result<void> validate(const Chain& chain);

/// Largest jump of curvature at the joints (with the closing joint if closed), in 1/length, and
/// of its rate dkappa/ds, in 1/length^2: 0 and 0 for a G3 chain.
struct JointGap {
  double curvature = 0;
  double curvature_rate = 0;
};
JointGap largest_joint_gap(const Chain& chain);

double arc_length(const Chain& chain);
double total_turning(const Chain& chain);

/// Which piece the parameter falls into and the piece's own parameter there; a joint belongs to
/// the piece after it. t is clamped to [0, 1].
struct ChainLocation {
  std::size_t piece = 0;
  double t = 0;
};
ChainLocation locate(const Chain& chain, double t);
/// Arc length up to the start, every inner joint and the end: pieces.size() + 1 of them.
std::vector<double> joint_lengths(const Chain& chain);
/// The same by these lengths alone, of at least one piece. On which side of a joint t lies is told
/// by the joint's share of the whole, as breakpoints() prints it: t times the length may be rounded
/// to the other side.
ChainLocation located(std::span<const double> joint_lengths, double t);

/// The i-th piece in its place, i < pieces.size(); all of them in one pass.
Segment segment_at(const Chain& chain, std::size_t i);
std::vector<Segment> segments(const Chain& chain);
/// Poses at the start, at every inner joint and at the end: pieces.size() + 1 of them.
std::vector<core::Pose2> joints(const Chain& chain);
core::Pose2 end_pose(const Chain& chain);

double curvature(const Chain& chain, double t);
double curvature_rate(const Chain& chain, double t);
/// Continuous along the chain from start.direction (not wrapped).
double tangent_angle(const Chain& chain, double t);
core::Point2 evaluate(const Chain& chain, double t);
/// Derivatives in t, the fraction of the whole length.
curve::Jet2 jet(const Chain& chain, double t);
/// 0, the joints and inflections, 1, increasing.
std::vector<double> breakpoints(const Chain& chain);
/// Points at n >= 2 equal steps of the length, in one pass.
std::vector<core::Point2> sample(const Chain& chain, int n);

/// The part from t0 to t1 (0 <= t0 < t1 <= 1), never closed.
Chain part(const Chain& chain, double t0, double t1);
Chain reverse(const Chain& chain);
struct ChainPair {
  Chain first, second;
};
ChainPair split(const Chain& chain, double t);
Chain transform(const Chain& chain, const core::Similarity2& map);

/// A chain with its pieces in their places. Each evaluation of a Chain lays all pieces before the
/// one asked for end to end again, and walks along that one; this one did the first once. Models
/// curve::PlanarCurve.
///
/// Accuracy: the same to the bit; along pieces that turn by more than kTabled, which are integrated
/// once as well, to 2e-15 of their length.
class PlacedChain {
 public:
  /// Radians: from a few turns on walking along a piece takes longer than finding a table's panel.
  static constexpr double kTabled = 20;

  /// Precondition: the chain is valid.
  explicit PlacedChain(Chain chain);

  const Chain& chain() const { return chain_; }
  double length() const { return joint_lengths_.back(); }
  const std::vector<double>& joint_lengths() const { return joint_lengths_; }
  const std::vector<Segment>& segments() const { return segments_; }
  /// Of the piece that t falls into.
  core::Point2 point(const ChainLocation& at) const;

 private:
  Chain chain_;
  std::vector<Segment> segments_;
  std::map<std::size_t, std::shared_ptr<const SegmentTable>> tables_;  ///< by the piece
  std::vector<double> joint_lengths_;
};

ChainLocation locate(const PlacedChain& placed, double t);
double curvature(const PlacedChain& placed, double t);
core::Point2 evaluate(const PlacedChain& placed, double t);
curve::Jet2 jet(const PlacedChain& placed, double t);
inline std::vector<double> breakpoints(const PlacedChain& placed) {
  return breakpoints(placed.chain());
}
/// What curve::PlanarView looks at in the chain's stead.
inline PlacedChain prepared(const Chain& chain) { return PlacedChain(chain); }

}  // namespace keyline::lac
