#pragma once

#include <optional>
#include <vector>

#include "keyline/core/describe.h"
#include "keyline/core/error.h"
#include "keyline/lac/segment/segment.h"

/// Error analysis of the Taylor forms ([QLAC] sections 3 and 6): what the series of each degree is
/// off by, as a bound and as found.
namespace keyline::lac {

/// In which the curve is expanded.
enum class TaylorVariable { tangent_angle, arc_length };
constexpr auto choices(const TaylorVariable*) {
  return core::words<TaylorVariable>({{TaylorVariable::tangent_angle, "tangent-angle"},
                                      {TaylorVariable::arc_length, "arc-length"}});
}

/// Of the partial sum of one degree, over the whole segment, in its unit of length. Both compare
/// places of equal angle or arc length, so that they bound the distance of the curves from above.
struct TaylorError {
  int degree = 1;
  double bound = 0;    ///< Cauchy's estimate of the remainder; infinite outside the circle
  double largest = 0;  ///< at 257 even places of the variable, both ends among them
};

struct TaylorErrors {
  double radius = 0;       ///< of convergence, as a share of the segment's angle or length; may be
                           ///< infinite
  bool converges = false;  ///< the whole segment lies inside the circle of convergence
  std::vector<TaylorError> degrees;  ///< 1, 2, … in order
};

/// about: fraction of the segment's angle or length to expand at, in [0, 1]; most: the last degree,
/// 1 … 30. Fails: bad_input (segment, about, most); unsupported where there is no series: at an
/// inflection (unless alpha = -1) or a cusp, in tangent angle across an inflection.
core::Result<TaylorErrors> taylor_errors(const Segment& segment, TaylorVariable variable,
                                         double about, int most);

}  // namespace keyline::lac
