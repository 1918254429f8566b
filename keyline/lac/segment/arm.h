#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "keyline/core/point.h"
#include "keyline/lac/segment/segment.h"
#include "keyline/numeric/power_mean.h"

/// Internals: a monotone run of a piece in the logarithm of its curvature.
///
/// With lambda = |ln(kappa / kappa_heavy)| measured from the "heavy" end (the one of larger
/// curvature for alpha < 0, else of smaller) arc length and tangent angle are
///   s ~ (1 - e^{-a lambda}) / a,   theta ~ (1 - e^{-b lambda}) / b
/// with a = |alpha| >= 0 and b = 1 - alpha or alpha - 1. Both are entire in lambda, so Gauss rules
/// converge fast even where kappa or rho goes to zero, which is lambda -> infinity.
namespace keyline::lac::detail {

/// (1 - e^{-k x}) / k, k any sign; x itself for k = 0; 1/k for x = infinity and k > 0.
inline double decay_integral(double k, double x) {
  if (std::isinf(x)) return k > 0 ? 1 / k : x;
  return x * numeric::expm1_over(-k * x);
}

struct Arm {
  double a = 0;           ///< decay of ds, >= 0
  double b = 0;           ///< decay of dtheta, a + 1 or a - 1
  double range = 0;       ///< lambda at the light end, >= 0; may be infinite
  double length = 0;      ///< document units
  double turning = 0;     ///< signed, travelling from the heavy end
  bool backward = false;  ///< heavy end is the later one along the piece
  double from = 0;        ///< fractions of the piece's length it covers
  double to = 1;

  double arc_total = 1;    ///< decay_integral(a, range)
  double angle_total = 1;  ///< decay_integral(b, range)

  /// Fractions of arc length and turning between the heavy end and lambda.
  double arc_fraction(double lambda) const { return decay_integral(a, lambda) / arc_total; }
  double angle_fraction(double lambda) const { return decay_integral(b, lambda) / angle_total; }
  /// lambda where the arc length from the heavy end is the given fraction of the whole; the
  /// complement is given apart so that nothing is lost close to the light end.
  double lambda_at(double fraction, double complement) const;
};

/// Arms of a piece, in order along it: one, or two meeting at an inflection.
struct Arms {
  int count = 0;
  std::array<Arm, 2> arm;
};
Arms arms_of(const Piece& piece);

/// One step of integration: [from, to] in lambda; where straight, the tangent direction does not
/// change within it by anything that could matter.
struct Panel {
  double from = 0;
  double to = 0;
  bool straight = false;
};

/// Walks the panels of [0, end]. `exponent` bounds the decay, `angle` the turning in one panel.
class PanelWalk {
 public:
  PanelWalk(const Arm& arm, double end, double exponent, double angle);
  /// The next panel; false when the end has been reached.
  bool next(Panel& panel);

 private:
  double step_from(double lambda) const;

  const Arm& arm_;
  double end_;
  double exponent_;
  double angle_;
  double head_ = 0;  ///< before it the direction is that of the heavy end
  double tail_ = 0;  ///< after it the direction, or the length left, is negligible
  double at_ = 0;
};

/// Integrals over a panel of e^{-a lambda} times tangent, and of angle times that.
struct PanelMoments {
  core::Vector2 zeroth;
  core::Vector2 first;
};
PanelMoments panel_moments(const Arm& arm, const Panel& panel);

/// Chord of the unit arm that leaves an inflection with tangent angle turned * x^m at the fraction
/// x of its length, in the frame of the inflection's tangent, and its derivative by turned.
/// |turned| <= kLargestSeriesTurning, m > 1; accuracy 1e-15.
struct InflectionArm {
  core::Vector2 chord;
  core::Vector2 by_turned;
};
inline constexpr double kLargestSeriesTurning = 4;  ///< cancellation costs e^4 / 10 roundings
InflectionArm inflection_arm(double turned, double m);

/// Vector from the heavy end to lambda, in the frame of the heavy end's tangent (pointing into the
/// arm), as a fraction of the arm's length.
core::Vector2 arm_vector(const Arm& arm, double lambda);

/// The same and the tangent angle there by fraction of the arm's arc length from the heavy end,
/// given with its complement to 1. These two also serve circles and straight lines.
core::Vector2 arm_vector_at(const Arm& arm, double fraction, double complement);
double arm_angle_at(const Arm& arm, double fraction, double complement);

}  // namespace keyline::lac::detail
