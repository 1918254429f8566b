#pragma once

#include <cmath>
#include <optional>

#include "keyline/lac/space/space.h"
#include "keyline/lac/space/space_ride.h"
#include "keyline/numeric/power_mean.h"

/// Internals of the space Hermite solver: a quick integration of a log-aesthetic space curve, with
/// derivatives, where six digits are enough to steer Newton's method
/// (docs/design/space-hermite.md).
namespace keyline::lac::detail {

/// y with y^-p = x^-p + p d for p != 0 (signed powers for p < 0), x e^-d for p = 0; NaN past the
/// end of the curve. Standard form: p the slope, d the rate times arc length. No cancellation as
/// p -> 0.
inline double carried(double x, double p, double d) {
  if (p == 0) return x * std::exp(-d);
  const double part = p * d * std::pow(std::abs(x), p) * (p < 0 && x < 0 ? -1 : 1);
  if (p < 0 && !std::isfinite(part))
    return numeric::signed_power(numeric::signed_power(x, -p) + p * d, -1 / p);
  if (part == 0) return x;
  if (part > -1) return x * std::exp(-std::log1p(part) / p);
  return p < 0 ? -x * std::exp(-std::log(-1 - part) / p) : NAN;
}

/// omega in the unit in which the curve has unit length.
inline double unit_rate(double beta, double omega, double length) {
  return omega == 0 ? 0.0 : omega * std::pow(length, 1 - beta);
}

/// What decides a curve of given slopes and omega up to its size, all in units of the radius of
/// curvature at the start.
struct SpaceUnknowns {
  double bend = 0;    ///< lambda times length
  double twist = 0;   ///< total torsion, rad
  double length = 1;  ///< so that curvature times length is `length` at the start
};

/// Torsion times length at the start for which the torsion comes to x.twist in all; empty where no
/// curve of this slope and rate has as much.
std::optional<double> start_torsion(double beta, double omega, const SpaceUnknowns& x);

/// By bend, twist and length.
using SpaceShot = Shot<3>;

/// Of form only alpha, beta and omega count. Magnus' method of order 4 on the group of motions, in
/// 32 steps, more towards ends that are sharp: about 1e-7 per radian of turning, 1e-5 where a law
/// grows by a hundred times; derivatives about 1e-4. Empty where the curve ends
/// before its length.
std::optional<SpaceShot> shoot_space(const SpaceStandardForm& form, const SpaceUnknowns& x);

}  // namespace keyline::lac::detail
