#pragma once

namespace keyline::fairing::detail {

/// Root of the variation of curvature of one piece and how it depends on its ends' curvatures, with
/// the sign of the change where that has one.
struct PieceEnergy {
  double root = 0;
  double by_start = 0;
  double by_end = 0;
};

/// Of the log-aesthetic piece of unit length between two curvatures: the integral of (d curvature /
/// ds)^2, in closed form. With p = -alpha curvature to the power p is linear in arc length, so the
/// rate is (b^p - a^p) / p * curvature^(1 - p), and the integral that difference times
/// (b^(2 - p) - a^(2 - p)) / (2 - p); powers with the sign of their base. Of slopes of -2 and
/// steeper it diverges where an end's curvature vanishes, of 0 and flatter the piece itself does.
///
/// Precondition: finite curvatures; where their signs differ or one is 0, -2 < alpha < 0.
PieceEnergy piece_energy(double curvature_start, double curvature_end, double alpha);

/// The flattest slope of a piece that runs through zero or into it: of flatter ones the curvature
/// clings to zero.
inline constexpr double kInflectionSlope = -0.25;

/// Whether a piece of that slope may run through zero or into it with a finite variation.
constexpr bool passes_inflection(double alpha) { return alpha > -2 && alpha <= kInflectionSlope; }

}  // namespace keyline::fairing::detail
