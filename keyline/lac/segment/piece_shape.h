#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "keyline/core/angle.h"
#include "keyline/core/point.h"
#include "keyline/lac/segment/segment.h"
#include "keyline/numeric/power_mean.h"

/// Internals of the chain solvers: where a piece of unit length ends, with derivatives.
namespace keyline::lac::detail {

/// The variable in which a Newton step changes a curvature.
enum class CurvatureStep {
  linear,     ///< kappa itself
  power,      ///< sgn(kappa) |kappa|^p: regular where kappa crosses zero between pieces of slope -p
  logarithm,  ///< ln |kappa|: the sign is kept
  fixed       ///< no unknown: its derivatives are 0, and none is sought
};

/// Curvature of one end of a piece as an unknown.
struct CurvatureVariable {
  CurvatureStep step = CurvatureStep::linear;
  double power = 1;  ///< of CurvatureStep::power
};

inline constexpr CurvatureVariable kFixed{CurvatureStep::fixed, 1};

inline double stepped(double kappa, double by, const CurvatureVariable& v) {
  if (v.step == CurvatureStep::fixed) return kappa;
  if (v.step == CurvatureStep::linear) return kappa + by;
  if (v.step == CurvatureStep::logarithm) return kappa * std::exp(by);
  return numeric::signed_power(numeric::signed_power(kappa, v.power) + by, 1 / v.power);
}

/// End of a piece of unit length in the frame of its start, with derivatives by the variables of
/// its two end curvatures. Values to 1e-15, derivatives to about 1e-8.
struct PieceShape {
  core::Vector2 chord;
  double turning = 0;
  std::array<core::Vector2, 2> chord_by{};
  std::array<double, 2> turning_by{};
  /// d(chord)/d ln(length) of the curve that keeps its curvatures while it grows, for unit length;
  /// the turning's is the turning itself.
  core::Vector2 chord_by_length;
};

/// alpha and the curvatures as in a valid Piece without cusp.
PieceShape piece_shape(double alpha, double k0, double k1, const CurvatureVariable& v0,
                       const CurvatureVariable& v1);

/// A piece that turns by more, or is longer in chords, counts as wild where nothing else tells.
inline constexpr double kWildTurning = 1.5 * core::kPi;
inline constexpr double kWildLength = 12;
/// Of a joint, in turns of the chord: a radius of a thousandth of it is a point to any eye.
inline constexpr double kWildCurvature = 1000;

/// Curvature times length beyond which a piece on the way to an answer counts as astray: from an
/// inflection to such an end it turns by 8 rad.
inline double largest_bend(double alpha) { return alpha < 0 ? std::min(80.0, 8 - 8 / alpha) : 80; }

/// Turning to the left and to the right together, of a piece without cusp.
double absolute_turning(const Piece& piece);
/// Integral of the squared curvature; a piece without cusp. Accuracy 1e-6 or better.
double bending_energy(const Piece& piece);

/// Largest of the misses of Newton's method, or of its steps; larger than any that serves where one
/// is no number.
template <std::size_t N>
double size_of(const std::array<double, N>& misses) {
  double size = 0;
  for (const double m : misses) size = std::isfinite(m) ? std::max(size, std::abs(m)) : 1e300;
  return size;
}

/// Solves a (overwritten) x = b for small dense systems with pivoting; false where singular.
template <std::size_t N>
bool solve_small(std::array<std::array<double, N>, N>& a, std::array<double, N>& b) {
  for (std::size_t c = 0; c < N; ++c) {
    std::size_t best = c;
    for (std::size_t r = c + 1; r < N; ++r) {
      if (std::abs(a[r][c]) > std::abs(a[best][c])) best = r;
    }
    if (!(std::abs(a[best][c]) > 1e-300)) return false;
    std::swap(a[c], a[best]);
    std::swap(b[c], b[best]);
    for (std::size_t r = c + 1; r < N; ++r) {
      const double f = a[r][c] / a[c][c];
      for (std::size_t k = c; k < N; ++k) a[r][k] -= f * a[c][k];
      b[r] -= f * b[c];
    }
  }
  for (std::size_t c = N; c-- > 0;) {
    for (std::size_t k = c + 1; k < N; ++k) b[c] -= a[c][k] * b[k];
    b[c] /= a[c][c];
  }
  return true;
}

}  // namespace keyline::lac::detail
