#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "keyline/core/point.h"

namespace keyline::acquire {

/// Strays among ordered points: single points or runs of at most three that lie off the local
/// cubic through their neighbours by more than ten times the noise and ten times the neighbours'
/// own misfit, a quarter of the spacing, a fifth of the gap they leave, and eight times the upper
/// quartile of all such residuals. A corner, a cusp or the tip of a fin leaves neighbours no cubic
/// fits that well, and stays. Increasing indices.
std::vector<std::size_t> find_outliers(std::span<const core::Point2> points, bool closed,
                                       double noise, std::size_t stride);

}  // namespace keyline::acquire
