#pragma once

#include <vector>

#include "keyline/curve/bspline.h"

namespace keyline::curve {

/// The parameters between which the curves of to_beziers(c) lie, one more than there are curves:
/// breakpoints(c), but twice the same where two knots differ by less than parameters can.
template <class P>
std::vector<double> bezier_ends(const BSpline<P>& c) {
  const core::Interval range = domain(c);
  std::vector<double> ends{0};
  double last = range.low;
  for (std::size_t i = c.degree + 1; i <= c.control.size(); ++i) {
    if (!(c.knots[i] > last)) continue;
    last = c.knots[i];
    ends.push_back(parameter_at_knot(c, last));
  }
  return ends;
}

}  // namespace keyline::curve
