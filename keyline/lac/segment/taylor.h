#pragma once

#include <array>

#include "keyline/core/pose.h"
#include "keyline/lac/segment/segment.h"

/// Internals: Taylor series of a log-aesthetic curve, by recurrences.
///
/// In arc length kappa is the power -1/alpha of a linear function, in tangent angle rho the power
/// 1/(alpha - 1) of one: with l the logarithmic rate at the point of expansion, the coefficients of
/// either obey k_{j+1} = k_j l (1 + j a) / (j + 1), a = alpha or 1 - alpha. The velocity is
/// e^{i theta} or rho e^{i theta}, whose coefficients follow by one more recurrence ([QLAC] Eqs. 7
/// and 10). Nothing is differentiated numerically.
namespace keyline::lac::detail {

inline constexpr int kMaxTaylorDegree = 40;

enum class SeriesVariable { tangent_angle, arc_length };

/// A piece reduced to length 1 and mainly positive curvature.
struct UnitPiece {
  Piece piece;
  double length = 1;   ///< that was
  double mirror = 1;   ///< -1: mirrored in the start tangent
  double turning = 0;  ///< of the reduced piece
};
UnitPiece unit_piece(const Piece& piece);

/// Points of a unit piece as a power series in x = u - about, u the fraction of the piece's arc
/// length or tangent angle: sum of coefficient[k] x^k (the first is 0), in the frame of the tangent
/// at the point of expansion.
struct TaylorSeries {
  SeriesVariable variable = SeriesVariable::arc_length;
  double about = 0;
  double arc = 0;  ///< fraction of the arc length at `about`
  int degree = 0;
  bool analytic = true;  ///< false: curvature 0 or infinite there, no series
  double radius = 0;     ///< of convergence, may be infinite
  std::array<core::Vector2, kMaxTaylorDegree + 1> coefficient{};

  double value = 0;     ///< kappa or rho times turning, at the point of expansion
  double log_rate = 0;  ///< d ln(kappa) / dx or d ln(rho) / dx
  double rate = 0;      ///< d kappa / dx: what counts where kappa is 0
  double decay = 0;     ///< alpha or 1 - alpha
  double turning = 0;
};

/// 1 <= degree <= kMaxTaylorDegree; about in [0, 1]. In tangent angle the curvature must be of one
/// sign and not zero at both ends.
TaylorSeries taylor_series(const UnitPiece& unit, SeriesVariable variable, double about,
                           int degree);

/// Sum of the series at x.
core::Vector2 sum(const TaylorSeries& series, double x);

/// Bound of |point - sum| for |x| <= reach: Cauchy's estimate of the terms left out, with the
/// velocity bounded on a circle of radius r < radius by its majorant (kappa with every coefficient
/// made positive is again such a power, of the same alpha). Nearly the least over r; infinite where
/// reach >= radius.
double remainder_bound(const TaylorSeries& series, double reach);

}  // namespace keyline::lac::detail
