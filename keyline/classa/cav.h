#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "keyline/classa/control_matrix.h"
#include "keyline/classa/minimum_energy.h"
#include "keyline/core/angle.h"
#include "keyline/core/describe.h"
#include "keyline/core/error.h"
#include "keyline/core/interval.h"
#include "keyline/curve/bezier.h"
#include "keyline/curve/monotone.h"

namespace keyline::classa {

/// Which way along a curve its ratios are read: where edges grow (s >= 1; reversing the curve then
/// changes nothing), or as the points stand, where s < 1 belongs to the branch s <= cos(alpha).
enum class Direction { growing, as_given };
constexpr auto choices(const Direction*) {
  return core::words<Direction>(
      {{Direction::growing, "growing"}, {Direction::as_given, "as-given"}});
}

struct CavOptions {
  double alpha_max = kDefaultAlphaMax;  ///< of Tab. 2 and of the plane: radians in (0, pi/2)
  double tolerance = 1e-6;  ///< in the alpha-s plane: ratios nearer than this are one and the same,
                            ///< a curve nearer than this to the minimum is at it; also the share of
                            ///< its size by which a planar curve in space may leave its plane
  std::optional<double> end_tolerance = {};  ///< of the minimum's end; empty: 0.01 of the chord
  Direction direction = Direction::growing;
  std::optional<Branch> branch = {};  ///< of the minimum; empty: that of the curve's own direction
  std::optional<core::Interval> alpha = {};  ///< of the minimum; empty: [0, alpha_max]
  core::Interval s = {0.01, 100};            ///< of the minimum
  /// Measure from this place instead of looking for the minimum: an edited curve is compared with
  /// the minimum of the curve it comes from.
  std::optional<EnergyMinimum> minimum = {};
  static constexpr auto describe() {
    return core::fields(
        core::field<&CavOptions::alpha_max>("largest rotation alpha of the plane ([Oya] Tab. 2)")
            .in("radian")
            .within(core::between(0, core::kPi / 2)),
        core::field<&CavOptions::tolerance>(
            "distance in the alpha-s plane below which ratios count as equal")
            .within(core::at_least(0)),
        core::field<&CavOptions::end_tolerance>(
            "how far the end may move to reach the minimum; 0.01 of the chord unless given")
            .in("length")
            .within(core::at_least(0)));
  }
};

/// Where a curve stands ([Oya] Tab. 1 and 2).
struct CurveValue {
  int type = 5;    ///< 1 at the minimum, 2 Class A, 3 one matrix, 4 several matrices, 5 none
  double cav = 0;  ///< Tab. 2
  std::optional<ControlMatrix> matrix;  ///< types 1-3, in the direction of `reversed`; alpha >= 0
  int degree = 0;
  bool reversed = false;  ///< read from its end to its start
  bool left = true;       ///< turns left in the direction it is read in
  double energy = 0;      ///< strain energy of the given curve, 1/length; infinite at a cusp
  std::optional<EnergyMinimum> minimum;  ///< empty for types 4, 5 where no such curve exists
  std::string no_minimum;                ///< then: why
  curve::MonotoneVerdict monotone;       ///< of curvature, certified on the curve itself
};

/// Diagonals of Tab. 2: d from (0, 1) to (alpha_max, 1/cos(alpha_max)), D from (0, 2) to
/// (alpha_max, 0). Type 3 scores d(1+L), type 4 d^2 D^2, type 5 d^3 D^3.
struct Diagonals {
  double boundary = 0;  ///< d
  double plane = 0;     ///< D
};
Diagonals diagonals(double alpha_max);

/// The steps of [Oya] Eq. 10 for one curve, an eighth of 12, 38, 110 and 407: the largest values of
/// a curve that is Class A, has one matrix, has several, or none. L is largest in the plane that
/// Tab. 2 draws, 0 <= alpha <= alpha_max and 0 <= s <= 2, the minimum on the branch of growing
/// edges: from (0, 1) to (arccos 1/2, 2) for Class A curves (alpha_max where that is less), from
/// (0, 2) to (alpha_max, cos alpha_max) for others.
struct LargestValues {
  double class_a = 0;
  double one_matrix = 0;
  double several = 0;
  double none = 0;
};
LargestValues largest_values(double alpha_max);

/// Curve aesthetic value of a polynomial Bézier curve of degree 1 … 30.
///
/// The conditions of its minimum are its own: start point and start tangent (of the direction in
/// which it is read), its first edge as the unit of beta, the end within end_tolerance, Class A.
/// A straight curve with one ratio is at its minimum (energy 0, type 1), and so is one of degree 1.
///
/// Errors: bad_input for numbers that are not finite, points that all coincide, alpha_max outside
/// (0, pi/2), negative tolerances; unsupported for a rational curve (approximate it first);
/// undrawable where the curve has one matrix but no Class A curve meets the conditions, so that L
/// of Tab. 2 does not exist.
core::Result<CurveValue> cav(const curve::Bezier2& c, const CavOptions& options = {});

/// The same in space, in the plane of the curve. Where it lies in none it is of type 5, and its
/// minimum lies in the plane of its start tangent and its chord: the x axis of the minimum's chord
/// is the tangent. (Torsion costs energy and meets none of the conditions.)
core::Result<CurveValue> cav(std::span<const core::Point3> control, const CavOptions& options = {});
core::Result<CurveValue> cav(const curve::Bezier3& c, const CavOptions& options = {});

/// Of a curve given by its matrix, its own minimum with it; the tangent as it stands is the unit of
/// beta (if the direction is its own).
core::Result<CurveValue> cav(const MatrixCurve& c, const CavOptions& options = {});

/// The ratios of a curve brought together: one matrix (mean of the ratios), several, or none.
struct MatrixReading {
  int type = 5;          ///< 3 one matrix, 4 several, 5 none
  ControlMatrix matrix;  ///< type 3: mean, alpha positive to the left
  bool left = true;      ///< side of the whole turning
};
MatrixReading read_matrix(std::span<const core::Point2> control, double alpha_max,
                          double tolerance);

/// A curve made ready to be placed: read in its direction, with the conditions of its minimum.
struct CurveReading {
  std::vector<core::Point2> control;  ///< in the direction it is read in
  bool reversed = false;
  MatrixReading matrix;
  EnergyConditions conditions;
};
/// Errors as of cav(), those of the minimum apart.
core::Result<CurveReading> read_curve(const curve::Bezier2& c, const CavOptions& options);
/// In the plane of the curve; where it lies in none, in that of cav(): there are then no control
/// points, and the conditions alone are the curve's.
core::Result<CurveReading> read_curve(const curve::Bezier3& c, const CavOptions& options);

}  // namespace keyline::classa
