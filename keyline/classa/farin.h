#pragma once

#include <array>

#include "keyline/core/error.h"
#include "keyline/core/point.h"
#include "keyline/curve/bezier.h"
#include "keyline/curve/monotone.h"

/// Matrices in space after [Farin 2006], the source of [Oya] Eqs. 3 and 4. Cao and Wang
/// ([Cao 2008]) showed that his conditions do not imply monotone curvature: they are reported,
/// and the curve itself is judged.
namespace keyline::classa {

using Matrix3 = std::array<std::array<double, 3>, 3>;  ///< by rows

/// A Bézier curve whose edges are v, Mv, M^2 v, … with v = tangent.
struct SpaceMatrixCurve {
  core::Point3 start;
  core::Vector3 tangent = {1, 0, 0};
  Matrix3 matrix = {};
  int degree = 3;
};

/// bad_input unless all numbers are finite, the tangent is not zero and the degree is in 2 … 30;
/// also where powers of the matrix overflow.
core::Result<void> validate(const SpaceMatrixCurve& c);

curve::Bezier3 to_bezier(const SpaceMatrixCurve& c);

/// What Farin's conditions say. None of them, nor all, certify anything.
struct FarinConditions {
  bool segment = false;  ///< Eq. 4: the segment from v to Mv keeps out of the sphere of radius |v|
  bool expands = false;  ///< the same for every v: M + M^T - 2I is positive semidefinite
  bool singular_values = false;      ///< sigma_3^2 >= sigma_1
  std::array<double, 3> sigma = {};  ///< singular values, largest first
};
FarinConditions farin_conditions(const SpaceMatrixCurve& c);

/// Whether curvature (never negative in space) only rises or only falls along a polynomial Bézier
/// curve in space: the sign of N'V - 3NV', N = |x' x x''|^2, V = |x'|^2, from its Bernstein
/// coefficients on subdivided parts, in doubles that carry bounds of their rounding. undecided
/// where rounding hides the sign on a part of the curve, or the curve stops inside. The tolerance
/// and the fields of the verdict are as for planar curves (curve/monotone.h).
curve::MonotoneVerdict certify_monotone_curvature(const curve::Bezier3& c, double tolerance = 1e-9);

}  // namespace keyline::classa
