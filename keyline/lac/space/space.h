#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "keyline/core/error.h"
#include "keyline/core/point.h"
#include "keyline/curve/bezier.h"
#include "keyline/curve/jet.h"
#include "keyline/lac/segment/segment.h"

/// Log-aesthetic space curves: curvature and torsion both follow the law of the plane, each with a
/// slope of its own (docs/readings.md; [Yoshida 2009]):
/// kappa(t) = M_{-alpha}(kappa0, kappa1; t), tau(t) = M_{-beta}(tau0, tau1; t), t the fraction of
/// the arc length.
namespace keyline::lac {

/// A piece without its place. Valid (see validate): {alpha, length, curvature…} and {beta, length,
/// torsion…} are both valid as a planar Piece, and finite (no cusp). Curvature may be negative: the
/// frame then goes smoothly through an inflection instead of jumping by a half turn.
struct SpacePiece {
  double alpha = -1;
  double beta = -1;
  double length = 1;
  double curvature_start = 0;
  double curvature_end = 0;
  double torsion_start = 0;
  double torsion_end = 0;
  friend bool operator==(const SpacePiece&, const SpacePiece&) = default;
};

/// A point of a space curve with Frenet's frame there: orthonormal, right-handed.
struct SpaceFrame {
  core::Point3 position;
  core::Vector3 tangent{1, 0, 0};
  core::Vector3 normal{0, 1, 0};
  core::Vector3 binormal{0, 0, 1};
  friend bool operator==(const SpaceFrame&, const SpaceFrame&) = default;
};

/// Pieces end to end with a common frame at every joint; compound ones share curvature and torsion
/// too. Models curve::SpaceCurve; parameter t = fraction of the whole arc length.
struct SpaceChain {
  SpaceFrame start;
  std::vector<SpacePiece> pieces;
  friend bool operator==(const SpaceChain&, const SpaceChain&) = default;
};

/// The two laws of a piece as planar pieces, whose curvature(), curvature_rate(), turning() then
/// speak of curvature and torsion.
inline Piece curvature_law(const SpacePiece& p) {
  return {p.alpha, p.length, p.curvature_start, p.curvature_end};
}
inline Piece torsion_law(const SpacePiece& p) {
  return {p.beta, p.length, p.torsion_start, p.torsion_end};
}

/// bad_input with the rule that is broken; the path names the piece or "frame" (orthonormal and
/// right-handed within 1e-9).
core::Result<void> validate(const SpaceChain& chain);

double arc_length(const SpaceChain& chain);
/// Largest jump of curvature and of torsion at the joints: 0 and 0 for a G3 curve.
struct SpaceJointGap {
  double curvature = 0;
  double torsion = 0;
};
SpaceJointGap largest_joint_gap(const SpaceChain& chain);

double curvature(const SpaceChain& chain, double t);
double torsion(const SpaceChain& chain, double t);

/// Frenet's equations solved from the start (Fehlberg's Runge-Kutta method of order 8,
/// Boost.Odeint, steps halved until that changes nothing). Accuracy about 1e-13 of the length and
/// 1e-13 rad per ten radians of turning. t is clamped to [0, 1].
SpaceFrame frame_at(const SpaceChain& chain, double t);
/// At growing t in one pass.
std::vector<SpaceFrame> frames(const SpaceChain& chain, std::span<const double> t);
/// At n >= 2 equal steps of the length, in one pass.
std::vector<core::Point3> sample(const SpaceChain& chain, int n);

core::Point3 evaluate(const SpaceChain& chain, double t);
/// Derivatives in t. Where the curvature's rate is infinite, the term holding it is left out.
curve::Jet3 jet(const SpaceChain& chain, double t);
/// 0, joints, inflections and zeros of torsion, 1.
std::vector<double> breakpoints(const SpaceChain& chain);
SpaceChain reverse(const SpaceChain& chain);

/// The five parameters of the literature's standard form, in units of the radius of curvature at
/// the reference point s = 0: rho^alpha = 1 + alpha lambda s there and mu^beta = nu^-beta + beta
/// omega s for the radius of torsion mu = 1/tau (logarithms for slope 0); nu is the torsion at the
/// reference point. For a slope below 0 the power is the signed one, so that curvature or torsion
/// may pass through zero.
struct SpaceStandardForm {
  double alpha = -1;
  double beta = -1;
  double lambda = 0;
  double omega = 0;
  double nu = 0;
};

/// From s = 0 to s = length, starting with the standard frame at the origin.
/// Fails: bad_input where a number is not finite, or the curve ends before `length`.
core::Result<SpacePiece> standard_piece(const SpaceStandardForm& form, double length);

/// Slopes of a piece's logarithmic curvature graph and logarithmic torsion graph: least squares
/// over log rho against log |rho ds/drho|, with torsion likewise. Not defined (false) where the
/// curvature or torsion is constant.
struct SpaceGraphs {
  double curvature_slope = 0;
  double torsion_slope = 0;
  bool curvature_defined = false;
  bool torsion_defined = false;
};
SpaceGraphs logarithmic_graphs(const SpacePiece& piece);

/// Quintic Béziers end to end that meet the curve's position, tangent and curvature at their ends.
struct SpaceBeziers {
  std::vector<curve::Bezier3> pieces;
  double deviation = 0;
};

/// Within `tolerance` (> 0, absolute; InvalidInput otherwise), each quintic as long as it may be.
/// The deviation is a bound of the distance at equal arc length, from bounds of the curve's
/// derivatives and the error of Hermite interpolation; it exceeds a tolerance only where that is
/// below about 4e-13 of the length.
SpaceBeziers approximate_by_quintics(const SpaceChain& chain, double tolerance);

}  // namespace keyline::lac
