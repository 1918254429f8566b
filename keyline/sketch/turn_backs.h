#pragma once

#include <cstddef>
#include <vector>

#include "keyline/core/point.h"
#include "keyline/sketch/pass_evidence.h"

namespace keyline::sketch {

/// Where the hand turns without lifting and draws the same line again, the other way: indices of
/// points (even steps), ascending.
///
/// There an open stroke turns by three quarters of a half turn or more within some passes'
/// distance, and two thirds of the shorter of its ways from or to there run beside the other one,
/// no farther off than passes of that length lie apart. So a corner, however sharp, or a narrow
/// bend at the end of a broader shape is none.
std::vector<std::size_t> turn_backs(const std::vector<core::Point2>& points,
                                    const PassModel& at_most);

}  // namespace keyline::sketch
