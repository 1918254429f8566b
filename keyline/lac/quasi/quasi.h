#pragma once

#include <optional>

#include "keyline/core/describe.h"
#include "keyline/core/error.h"
#include "keyline/core/interval.h"
#include "keyline/core/point.h"
#include "keyline/curve/bezier.h"
#include "keyline/curve/monotone.h"
#include "keyline/lac/segment/segment.h"

/// Quasi-log-aesthetic curves: Bézier curves close to a log-aesthetic segment ([QLAC]).
namespace keyline::lac {

enum class QuasiForm {
  taylor_angle,    ///< Taylor polynomial in tangent angle ([QLAC] Eq. 7)
  taylor_arc,      ///< Taylor polynomial in arc length ([QLAC] Eq. 10)
  discrete_angle,  ///< control edges along the tangents at the middle of equal parts of angle
  discrete_arc,    ///< the same for equal parts of arc length, edges of equal length
  rational_cubic,  ///< positions, tangents and end curvatures exact, then least LCG variance
  /// Positions, tangents and finite end curvatures exact, then least deviation; the raised rational
  /// cubic, or over handles any other form or a cubic with its control points on them, where that
  /// is closer (its end curvatures are then as near as its deviation lets them be). Of a segment
  /// end curvatures are given up likewise where another form, which misses the ends, is closer.
  /// Never refused where another form serves; never worse than any other form of the degree or a
  /// lower one, of a segment up to a full turn and radii up to 1e4 apart.
  best,
};
constexpr auto choices(const QuasiForm*) {
  return core::words<QuasiForm>({{QuasiForm::taylor_angle, "taylor-angle"},
                                 {QuasiForm::taylor_arc, "taylor-arc"},
                                 {QuasiForm::discrete_angle, "discrete-angle"},
                                 {QuasiForm::discrete_arc, "discrete-arc"},
                                 {QuasiForm::rational_cubic, "rational-cubic"},
                                 {QuasiForm::best, "best"}});
}

struct QuasiOptions {
  QuasiForm form = QuasiForm::taylor_angle;
  int degree = 8;  ///< 3 … 30; at least 5 for best; the rational cubic is always 3
  /// Taylor forms: fraction of the interval of tangent angle or arc length to expand at, in
  /// [0, 1]. Empty: the end away from the singularity ([QLAC] §3; docs/readings.md), which is that
  /// of smaller radius for alpha < 1 (tangent angle) or alpha < 0 (arc length), else the other.
  std::optional<double> about = {};
  /// Taylor forms: the point of expansion, and the better of tangent angle and arc length, by the
  /// least error at the ends; `about` and which of the two forms is asked for do not matter then.
  /// Where that leads to nothing over handles: the closest expanded at eighths, of both variables.
  bool automatic = false;
};

struct QuasiResult {
  curve::Bezier2 curve;
  Segment target;                            ///< the log-aesthetic segment the curve stands for
  QuasiForm form = QuasiForm::taylor_angle;  ///< the one taken
  double about = 0;                          ///< Taylor forms: where it was expanded
  double lambda = 0;         ///< of the standard form of the curve's own series (lambda.h)
  bool lcg_defined = false;  ///< false where there is no graph: arcs, straight lines
  double lcg_slope = 0;
  double lcg_variance = 0;
  double deviation = 0;  ///< deviation_bound() from target
  /// Taylor forms: bound of the series' remainder over the interval, known before anything is
  /// drawn, by Cauchy's estimate (infinite where the interval leaves the circle of convergence).
  double series_bound = 0;
  curve::MonotoneVerdict monotone;
  int iterations = 0;  ///< of the search for lambda
};

/// The part of the standard form ([QLAC] Eqs. 1 and 2: at tangent angle 0 the curve passes the
/// origin along x with radius 1) with the tangent angles of the interval.
/// Fails: bad_input where a number is not finite, the interval is empty or leaves the curve, that
/// is 1 + (alpha - 1) lambda angle < 0 (or = 0 where arc length or turning is infinite).
core::Result<Segment> standard_segment(double alpha, double lambda, const core::Interval& angles);

/// A quasi-log-aesthetic curve of the segment, in its place. The Taylor forms meet position and
/// tangent where they are expanded, the discretisations the start point alone, the others as said.
/// Fails: bad_input (segment, degree, about); unsupported where the form does not exist: tangent
/// angle across an inflection or from an end without curvature or radius, end curvatures that are
/// zero or infinite for the rational cubic.
core::Result<QuasiResult> quasi_log_aesthetic(const Segment& segment, const QuasiOptions& options);

/// From the standard form.
core::Result<QuasiResult> quasi_log_aesthetic(double alpha, double lambda,
                                              const core::Interval& angles,
                                              const QuasiOptions& options);

/// G1 Hermite interpolation ([QLAC] §4): the Bézier itself runs from P0 to P2 with tangents along
/// P1-P0 and P2-P1, met to rounding; for the polynomial forms Lambda and the interval are solved
/// for on the Bézier (two unknowns, Newton from the log-aesthetic solution, then from every place
/// that bounds do not rule out, of pieces of less than a whole turn), so its Lambda differs from
/// that of `target`, the log-aesthetic segment through the same handles: a little where the series
/// serves, much where it is at its end. Fails as solve_g1, whose hint names what the form best
/// bears, not always the others; as above; and undrawable where no Lambda serves at this degree, or
/// but with an end edge below 1e-8 of the size, whose direction rounding would lose; not_converged
/// where none was found and rounding hid part of the plane.
core::Result<QuasiResult> quasi_log_aesthetic(core::Point2 p0, core::Point2 p1, core::Point2 p2,
                                              double alpha, const QuasiOptions& options);

}  // namespace keyline::lac
