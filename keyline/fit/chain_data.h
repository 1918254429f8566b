#pragma once

#include <cstddef>
#include <vector>

#include "keyline/core/point.h"

namespace keyline::fit {

/// The points with their arc length, direction and curvature, both smoothed over a few neighbours.
struct ChainData {
  std::vector<core::Point2> points;  ///< closed: the first repeated at the end
  std::vector<double> length;        ///< from the start
  std::vector<double> direction;
  std::vector<double> curvature;
};

/// Precondition: at least two points; InvalidInput where two neighbours are equal.
ChainData prepare_chain_data(const std::vector<core::Point2>& points, bool closed);

/// Indices where the joints of so many pieces lie: equal shares of length and of turning, averaged.
std::vector<std::size_t> joint_indices(const ChainData& data, int pieces);

/// Puts a joint into the middle of the pieces that deviate most, while there are fewer than `most`
/// pieces. False where none can be split.
bool split_worst(const ChainData& data, const std::vector<double>& deviations, double tolerance,
                 int most, std::vector<std::size_t>& joints);

}  // namespace keyline::fit
