#pragma once

#include "keyline/core/point.h"

/// Internals of the G1 solvers: the chord of an arm of unit length (see arm.h), as a function of
/// the range q = |ln(kappa_light / kappa_heavy)| at a fixed turning.
namespace keyline::lac::detail {

/// Largest finite range: e^q stays well inside the doubles.
inline constexpr double kLargestRange = 690;

/// Decays of ds and dtheta of an arm of slope alpha, and the decay k in which the chord angle is
/// close to linear in e^{-kq} as it nears its limit.
struct Decays {
  double a = 0;
  double b = 0;
  double k = 0;
};
Decays decays_of(double alpha);

/// Chord from the heavy to the light end in the frame of the heavy tangent, and d(chord)/dq.
struct ChordValue {
  core::Vector2 chord;
  core::Vector2 slope;
};
/// q in [0, infinity]; infinity only where a > 0 and b > 0. Accuracy 1e-15, slope 1e-9 relative.
ChordValue chord_value(const Decays& d, double theta, double q);

/// d(chord angle)/dq at q = 0 for b > a (its negative for b < a): (1 - h cot h) / theta, h =
/// theta/2.
double circle_slope(double theta);

enum class ChordStatus {
  solved,
  beyond_region,     ///< the chord angle lies outside the drawable region
  beyond_precision,  ///< inside, but the curvatures' ratio would exceed the range of doubles
};
struct ChordSolution {
  ChordStatus status = ChordStatus::solved;
  double range = 0;         ///< q; infinite for an inflection or a cusp at the light end
  double chord_length = 1;  ///< of an arm of length 1
  int iterations = 0;
};

/// The range q at which an arm of the given turning, 0 < theta < 2 pi, has its chord at the angle
/// psi from the tangent at the start, seen in the direction in which the radius of curvature
/// grows: theta/2 <= psi < theta. Newton's method on the chord angle, which is monotone in q,
/// inside a bracket.
ChordSolution solve_chord_angle(double alpha, double theta, double psi);

/// Supremum of psi over all q: theta/2, the circle's, or more.
double limit_chord_angle(double alpha, double theta);

}  // namespace keyline::lac::detail
