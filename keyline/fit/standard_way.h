#pragma once

#include <vector>

#include "keyline/curve/piecewise_bezier.h"
#include "keyline/fit/curvature_drive.h"

/// Where an answer hangs on the end a search sets out from, both ways of travel are searched in
/// one.
namespace keyline::fit::detail {

/// Whether the standard way of travel is the opposite one: of the first control edges from either
/// end that differ by more than rounding, the longer one is passed first.
bool goes_back(const curve::PiecewiseBezier& chain);

curve::PiecewiseBezier on_the_way_back(curve::PiecewiseBezier chain);
std::vector<CurvatureTarget> on_the_way_back(std::vector<CurvatureTarget> targets);

}  // namespace keyline::fit::detail
