#pragma once

#include <vector>

#include "keyline/lac/segment/taylor.h"

/// Internals: where a Taylor form may meet three handles.
namespace keyline::lac::detail {

/// What decides a Taylor form of given slope: the curvature or, in tangent angle, the turning, and
/// the logarithmic rate of curvature or radius at the point of expansion, both by the fraction.
struct SeriesPlace {
  double value = 0;
  double log_rate = 0;
};

struct SeriesWanted {
  SeriesVariable variable = SeriesVariable::arc_length;
  double alpha = 0;
  double about = 0;
  int degree = 0;          ///< of the curve
  double turning = 0;      ///< from the first end edge to the last, left positive
  double chord_angle = 0;  ///< from the first end edge to the chord
};

/// Places next to which both angles may be met, at least one within about 1e-3 of the size of every
/// solution where the search is complete.
struct SeriesPlaces {
  std::vector<SeriesPlace> places;
  bool complete = true;
};

/// All of the plane is looked at, whether there is a piece or not.
///
/// Both end edges and the chord are polynomials of both unknowns. In homogeneous coordinates the
/// half plane of positive values is covered by unit squares; one is left out when the directions of
/// its Bernstein coefficients cannot differ as wanted, else quartered. Of a degree or slope so high
/// that rounding hides the directions too many squares are left: it ends at larger ones then, and
/// is not complete.
SeriesPlaces series_places(const SeriesWanted& wanted);

}  // namespace keyline::lac::detail
