#pragma once

#include "keyline/classa/control_matrix.h"
#include "keyline/curve/bezier.h"
#include "keyline/curve/view.h"

namespace keyline::classa {

/// Strain energy of [Oya] Eq. 7, the integral of squared curvature over arc length, in 1/length:
/// adaptive Gauss-Kronrod to the relative tolerance, stretch by stretch between breakpoints.
/// Returns 0 for a straight curve and for one without length, +infinity where the curve has a cusp
/// or an end handle of no length (the integral diverges there).
double strain_energy(const curve::PlanarView& c, double tolerance = 1e-10);
double strain_energy(const curve::Bezier3& c, double tolerance = 1e-10);
template <curve::PlanarCurve C>
double strain_energy(const C& c, double tolerance = 1e-10) {
  return strain_energy(curve::PlanarView(c), tolerance);
}

/// Eq. 7 for a curve with one matrix and a first edge of length 1, and the derivatives of its
/// logarithm. The energy of a MatrixCurve is value / (beta |tangent|).
struct MatrixEnergy {
  double value = 0;
  double log_by_alpha = 0;  ///< d ln(value) / d alpha; 0 where alpha = 0
  double log_by_s = 0;      ///< d ln(value) / d s; 0 where alpha = 0
};

/// To rounding: the hodograph of such a curve is n v (1 - t + t z)^(n-1), so that curvature over
/// the polar angle psi in [0, alpha] of 1 - t + t z is a trigonometric polynomial,
///   E = (n-1)^2/n s sin(alpha) * integral of ((s sin(alpha-psi) + sin psi)/(s sin alpha))^(n+1),
/// which a Gauss rule of fixed size meets. alpha in [0, pi/2), s > 0, degree in 1 … 30.
MatrixEnergy matrix_energy(const ControlMatrix& m, int degree);

/// Strain energy of a curve with one matrix, through matrix_energy.
double strain_energy(const MatrixCurve& c);

}  // namespace keyline::classa
