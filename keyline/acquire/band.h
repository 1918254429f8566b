#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "keyline/core/point.h"

namespace keyline::acquire {

/// Means of points, with the sum of their weights.
struct Averaged {
  std::vector<core::Point2> points;
  std::vector<double> weights;
};

/// Half width of the band of unordered points about its centre line, from the spread across the
/// principal direction of neighbourhoods just large enough to be longer than wide (ratio 4), and
/// the radius of these neighbourhoods. width 0: the points form a line already.
struct BandWidth {
  double width = 0;
  double radius = 0;
};
BandWidth measure_band(std::span<const core::Point2> points);

/// Means over square cells, of a size that leaves about `most` of them at most; in repeatable
/// order. Empty weights: all one.
Averaged average_cells(std::span<const core::Point2> points, std::span<const double> weights,
                       std::size_t most);

/// Unordered points of a thick band averaged to points in order along its centre line: each is
/// moved to the line through its neighbours within `radius` (twice), the moved points put in
/// order, and the given points averaged over stretches of about half a radius.
Averaged average_band(std::span<const core::Point2> points, std::span<const double> weights,
                      double radius);

/// Ordered points averaged over consecutive groups so that at most `most` remain; corners and ends
/// in `keep` (increasing indices) stay as they are and part the groups.
Averaged average_runs(std::span<const core::Point2> points, std::span<const double> weights,
                      std::span<const std::size_t> keep, std::size_t most);

}  // namespace keyline::acquire
