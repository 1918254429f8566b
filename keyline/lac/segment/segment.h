#pragma once

#include <span>
#include <vector>

#include "keyline/core/error.h"
#include "keyline/core/interval.h"
#include "keyline/core/point.h"
#include "keyline/core/pose.h"
#include "keyline/core/similarity.h"
#include "keyline/curve/jet.h"

/// Log-aesthetic curves of every slope alpha, exact to rounding.
///
/// In the fraction t of the arc length the curvature is the power mean
/// kappa(t) = M_{-alpha}(kappa0, kappa1; t) ([QLAC] Eqs. 2-4): alpha = -1 is the clothoid,
/// 0 Nielsen's spiral, 1 the logarithmic spiral, 2 the circle involute; kappa0 = kappa1 a circle,
/// both 0 a straight line.
namespace keyline::lac {

/// A log-aesthetic curve piece without its place in the plane.
///
/// Valid (see validate): finite alpha, length > 0 and finite, and for the curvatures one of
/// - both finite, not zero and of one sign: any alpha;
/// - one or both zero, or of opposite signs (the curve inflects inside): alpha < 0 (both zero,
///   a straight line: any alpha);
/// - one of them infinite, the other finite and not zero, |sign| agreeing: a cusp, alpha > 1.
/// The functions below demand a valid piece; with another they return, but nothing useful.
struct Piece {
  double alpha = -1;
  double length = 1;
  double curvature_start = 0;
  double curvature_end = 0;
  friend bool operator==(const Piece&, const Piece&) = default;
};

/// A piece with its place: models curve::PlanarCurve, parameter t = fraction of the arc length.
struct Segment {
  core::Pose2 start;
  double alpha = -1;
  double length = 1;
  double curvature_start = 0;
  double curvature_end = 0;
  friend bool operator==(const Segment&, const Segment&) = default;
};

inline Piece piece_of(const Segment& s) {
  return {s.alpha, s.length, s.curvature_start, s.curvature_end};
}
inline Segment place(const Piece& p, const core::Pose2& start) {
  return {start, p.alpha, p.length, p.curvature_start, p.curvature_end};
}

/// Radians: what turns farther, or points there, has lost digits of its direction.
inline constexpr double kLargestTurning = 1e5;

/// bad_input with the rule that is broken, or nothing. The turning is at most kLargestTurning.
core::Result<void> validate(const Piece& piece);
core::Result<void> validate(const Segment& segment);

/// Signed curvature at fraction t of the length; t is clamped to [0, 1] here and below.
/// Relative accuracy 1e-14. Infinite only at a cusp.
double curvature(const Piece& piece, double t);
/// dkappa/ds. Infinite at a cusp and, for alpha < -1, at an inflection.
double curvature_rate(const Piece& piece, double t);
/// Tangent angle at t less that at the start: the integral of curvature. Absolute accuracy 1e-15
/// of the whole turning.
double turning(const Piece& piece, double t);
/// Signed turning of the whole piece: length times Stolarsky's mean of the end curvatures.
double total_turning(const Piece& piece);
/// Where the piece has turned by the fraction u of its turning; one sign of curvature only
/// (no inflection inside). For a straight line u itself.
double fraction_at_turning(const Piece& piece, double u);
/// Fraction of the length at which the curvature is zero, strictly inside (0, 1); else -1.
double inflection(const Piece& piece);
/// Point at t in the piece's own frame: start at the origin, start tangent along x.
/// Accuracy about 2e-15 of the length.
core::Vector2 displacement(const Piece& piece, double t);

/// The part from t0 to t1 (0 <= t0 < t1 <= 1), the same curve run backwards, a similar curve.
Piece part(const Piece& piece, double t0, double t1);
Piece reversed(const Piece& piece);
/// Mirror image in the start tangent.
Piece mirrored(const Piece& piece);

double curvature(const Segment& segment, double t);
double curvature_rate(const Segment& segment, double t);
/// Tangent angle at t, continuous along the curve from start.direction (not wrapped).
double tangent_angle(const Segment& segment, double t);
double total_turning(const Segment& segment);
inline double arc_length(const Segment& segment) { return segment.length; }

core::Point2 evaluate(const Segment& segment, double t);
/// Derivatives in t. Where curvature or its rate is infinite, the terms holding it are left out.
curve::Jet2 jet(const Segment& segment, double t);
/// The same about a point that is known.
curve::Jet2 jet_from(const Segment& segment, double t, core::Point2 point);
/// {0, 1}, with the inflection between them if there is one.
std::vector<double> breakpoints(const Segment& segment);
core::Pose2 end_pose(const Segment& segment);
core::Pose2 pose_at(const Segment& segment, double t);

/// Points at n >= 2 equal steps of the length, in one pass (bench: sample_segment).
std::vector<core::Point2> sample(const Segment& segment, int n);
/// Points at the given fractions, in any order; points.size() == at.size().
void sample(const Segment& segment, std::span<const double> at, std::span<core::Point2> points);

Segment part(const Segment& segment, double t0, double t1);
Segment reverse(const Segment& segment);
struct SegmentPair {
  Segment first, second;
};
/// Both sides of fraction t, 0 < t < 1.
SegmentPair split(const Segment& segment, double t);
Segment transform(const Segment& segment, const core::Similarity2& map);

/// Locus of the centres of curvature: again log-aesthetic, of slope 1/(2 - alpha), as long as the
/// radius of curvature changes by. Its tangents are the normals of the curve.
/// Fails (bad_input): a circle, a straight line, an inflection or a cusp.
core::Result<Segment> evolute(const Segment& segment);

}  // namespace keyline::lac
