#pragma once

#include <functional>

#include "keyline/lac/quasi/quasi_forms.h"

/// Internals shared by the sources of quasi.h.
namespace keyline::lac::detail {

struct Drawn {
  ControlPolygon polygon;  ///< empty where the form meets no such ends
  std::vector<double> weights;
  double series_bound = 0;  ///< in lengths of the piece
};

/// The options with form and point of expansion decided, or what is refused.
core::Result<QuasiOptions> settled(const UnitPiece& unit, QuasiOptions options);
/// Settled options only.
Drawn draw_form(const UnitPiece& unit, const QuasiOptions& options);
/// The segment's curve from one drawn for its unit piece.
curve::Bezier2 in_place(const Segment& segment, const UnitPiece& unit, const Drawn& drawn);
/// Fills in graph, deviation and certificate.
void measure(QuasiResult& result);

struct Approximation {
  curve::Bezier2 curve;
  double deviation = 0;  ///< bound
  bool curvatures_held = false;
};
/// Of the forms that give up end curvatures the closest of a degree >= 3; nothing where there is
/// none.
using OtherForms = std::function<std::optional<Approximation>(int degree)>;

/// The form `best`: never worse than the rational cubic, the other forms and itself at this degree
/// and below. Where one of the other forms is closer than any fit that holds the end curvatures,
/// fits that do not hold them are tried too. Nothing where nothing meets the ends.
std::optional<Approximation> best_of_degrees(const Segment& segment, int degree,
                                             const OtherForms& others);

/// That as an answer; fails: undrawable.
core::Result<QuasiResult> best_result(const Segment& segment, int degree, const OtherForms& others);

}  // namespace keyline::lac::detail
