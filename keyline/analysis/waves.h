#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "keyline/analysis/split.h"

namespace keyline::analysis::detail {

/// A sample of the curve in order of t; stretch counts the breakpoints before it.
struct Sample {
  double t = 0;
  double s = 0;
  double curvature = 0;
  int stretch = 0;
};

/// What a difference of two curvatures may owe to rounding: a share of the larger of them, however
/// much the curve bends elsewhere.
struct Rounding {
  double share = 0;
  double least = 0;
  double of(double a, double b) const {
    return std::max(least, share * std::max(std::abs(a), std::abs(b)));
  }
};

/// Turning points of the curvature along samples [from, to] (both ends included in the result),
/// after every wave of no more than `noise` displacement or `rounding` swing has been merged.
/// What was merged is added to `merged`, rounding left out.
std::vector<std::size_t> significant_turns(const std::vector<Sample>& samples, std::size_t from,
                                           std::size_t to, double noise, const Rounding& rounding,
                                           std::vector<MergedWave>& merged);

/// Of the sign changes (index of the sample before each), those that bound significant lobes.
std::vector<std::size_t> significant_crossings(const std::vector<Sample>& samples, std::size_t from,
                                               std::size_t to, std::vector<std::size_t> crossings,
                                               double noise, const Rounding& rounding,
                                               std::vector<MergedWave>& merged);

}  // namespace keyline::analysis::detail
