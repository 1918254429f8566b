#pragma once

#include <vector>

#include "keyline/core/error.h"
#include "keyline/core/point.h"
#include "keyline/lac/quasi/quasi.h"
#include "keyline/lac/segment/taylor.h"

/// Internals: the forms of quasi-log-aesthetic curves in the frame of a unit piece (start at the
/// origin along x, length 1, turning left).
namespace keyline::lac::detail {

using ControlPolygon = std::vector<core::Vector2>;

/// Taylor polynomial as Bernstein coefficients: b_i is the polar form of the polynomial at i ones
/// and n - i zeros, taken in the series' own variable: sum of c_k e_k / C(n, k), e_k the elementary
/// symmetric functions of i times 1 - about and n - i times -about. The arguments never exceed 1,
/// so that nothing grows: at degree 30 the loss stays below 1e-15 of the sum of |c_k|.
ControlPolygon taylor_polygon(const UnitPiece& unit, const TaylorSeries& series);

/// Of a polygon, however it is turned.
struct EndEdges {
  core::Vector2 first, last, chord;
};
EndEdges taylor_end_edges(const TaylorSeries& series);

/// Control edges along the tangents at the middle of `degree` equal parts ([Miura 2010]).
ControlPolygon discrete_polygon(const UnitPiece& unit, SeriesVariable variable, int degree);

struct RationalCubic {
  ControlPolygon polygon;
  std::vector<double> weights;
};
/// Of inner weights, the outer being 1, and of their reciprocals.
inline constexpr double kMostRationalWeight = 1e4;
/// Least LCG variance among the rational cubics with the ends, tangents and curvatures of the
/// piece: from guesses, or where none of these has a graph from the best of a grid of handles.
/// Empty polygon where there is none.
RationalCubic rational_cubic(const UnitPiece& unit);

/// The segment's point that its unit piece has at v.
core::Point2 in_place(const Segment& segment, const UnitPiece& unit, core::Vector2 v);

/// Of the size: an end edge that is shorter loses its direction in rounding.
inline constexpr double kShortestHandle = 1e-8;

struct BestSearch {
  /// From many starts where the usual one leaves more than 1e-9 of the length (up to 100 ms).
  bool thorough = false;
  bool curvatures_held = true;
  /// Of the degree: where to start; from unit speed where it is empty, if thorough too.
  ControlPolygon from = {};
};
/// Least deviation with ends, tangents and, where held, end curvatures kept, degree >= 5. Empty
/// where the search cannot begin: end curvatures so large that no handle of a usual length meets
/// them.
ControlPolygon best_polygon(const UnitPiece& unit, int degree, const BestSearch& search);

/// The point of expansion of the paper's rule.
double ruled_about(const UnitPiece& unit, SeriesVariable variable);
/// Point and variable of least error at the ends.
struct Expansion {
  SeriesVariable variable = SeriesVariable::arc_length;
  double about = 0;
};
Expansion best_expansion(const UnitPiece& unit, int degree);

/// What of a form and a piece is refused, or nothing.
core::Result<void> check_form(const UnitPiece& unit, const QuasiOptions& options);

}  // namespace keyline::lac::detail
