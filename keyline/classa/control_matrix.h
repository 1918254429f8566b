#pragma once

#include <optional>
#include <span>
#include <vector>

#include "keyline/core/error.h"
#include "keyline/core/interval.h"
#include "keyline/core/point.h"
#include "keyline/curve/bezier.h"

/// Class A curves, strain energy and the curve aesthetic value of
/// [Oya]. What that key and the others stand for is told in docs/bibliography.md, how open passages
/// are read in docs/readings.md.
namespace keyline::classa {

/// The control matrix M of [Oya] Eq. 6: a rotation by alpha (radians, counter-clockwise positive)
/// times a scale s > 0. The place of a curve in the alpha-s plane is (|alpha|, s).
struct ControlMatrix {
  double alpha = 0;
  double s = 1;
  friend bool operator==(const ControlMatrix&, const ControlMatrix&) = default;
};

/// s >= 1/cos(alpha) or s <= cos(alpha), up to `slack` in s ([Oya] Eq. 5). For a curve with this
/// one matrix it is necessary and sufficient for monotone curvature, whatever the degree.
bool is_class_a(const ControlMatrix& m, double slack = 0);

/// Euclidean distance in the alpha-s plane, of either side of turning.
double plane_distance(const ControlMatrix& a, const ControlMatrix& b);

/// A Bézier curve whose edges are v, Mv, M^2 v, … with v = beta * tangent ([Oya] Eq. 3). The length
/// of `tangent` counts: with (1, 2) and beta = 1 the first edge is (1, 2).
struct MatrixCurve {
  core::Point2 start;
  core::Vector2 tangent = {1, 0};
  double beta = 1;
  ControlMatrix matrix;
  int degree = 3;
};

/// bad_input unless all numbers are finite, the tangent is not zero, beta > 0, s > 0, |alpha| < pi,
/// the degree lies in 1 … 30, edges at most 1e100 long. Paths: those names.
core::Result<void> validate(const MatrixCurve& c);

/// Its control points; `c` has to be valid.
curve::Bezier2 to_bezier(const MatrixCurve& c);

/// End minus start in a frame whose x axis is the first edge and whose unit is its length:
/// 1 + z + … + z^(degree-1) with z = s e^(i alpha).
core::Vector2 end_in_frame(const ControlMatrix& m, int degree);

/// Direction of end_in_frame, not wrapped: continuous in s on either side of 1 and 0 at alpha = 0.
/// alpha in [0, pi/2), s > 0. On s >= 1/cos(alpha) and on s <= cos(alpha) it grows with s for every
/// degree up to 13, and for any degree as long as (degree-1) alpha <= pi.
double end_angle(const ControlMatrix& m, int degree);

/// The s in the range at which end_angle({alpha, s}, degree) = angle; the nearer end of the range
/// where it is not reached. Needs end_angle to grow with s there.
double scale_at_end_angle(double alpha, double angle, int degree, const core::Interval& s);

/// From the first control point to the next that lies farther off than curve::kLeastEdge of the
/// longest edge: the direction in which the curve leaves. Not all points may be one.
core::Vector2 leaving_edge(std::span<const core::Point2> control);
core::Vector3 leaving_edge(std::span<const core::Point3> control);

/// One matrix for each two consecutive edges, alpha in (-pi, pi]; empty where one of the edges is
/// shorter than curve::kLeastEdge of the longest. A curve of degree 1 has none.
std::vector<std::optional<ControlMatrix>> ratios(std::span<const core::Point2> control);

/// Whether the edges shrink on the whole: the last against the first, then inwards. Where lengths
/// do not tell (to 1e-12), turning does: a curve whose edges grow turns more at its start.
bool edges_shrink(std::span<const core::Point2> control);

}  // namespace keyline::classa
