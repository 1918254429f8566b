#pragma once

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
/// Fills in graph, deviation and certificate.
void measure(QuasiResult& result);

}  // namespace keyline::lac::detail
