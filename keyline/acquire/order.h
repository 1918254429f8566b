#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "keyline/core/point.h"
#include "keyline/core/progress.h"

namespace keyline::acquire {

/// True where the order of the points already follows a curve: without its longest twentieth, the
/// polygon through them is at most twice as long as the minimum spanning tree without its longest
/// twentieth; or, for points denser than their noise, the same holds for the means of consecutive
/// groups while steps stay below a fiftieth of the extent. Whatever it says once cancelled means
/// nothing.
bool is_ordered(std::span<const core::Point2> points,
                const core::CancellationToken& cancellation = {});

/// In space: true unless the median step from point to point is more than ten times the median
/// distance of a point from its nearest. Noise about a curve makes that of a thousand points within
/// its own reach; of points strewn over a surface some hundred do.
bool is_ordered(std::span<const core::Point3> points);

/// Points put in order along the curve they lie on.
struct Ordering {
  std::vector<std::size_t> order;    ///< indices of the points kept, along the curve
  std::vector<std::size_t> dropped;  ///< increasing; points no short detour reaches
};

/// Order by the longest path of the minimum spanning tree, other points inserted where the detour
/// is least, cleaned up by 2-opt and by moving single points. For thin, curve-like clouds of
/// distinct points; the result starts at the widest gap of a closed outline. Meant for a few
/// thousand points: the clean-up is quadratic at worst.
Ordering order_points(std::span<const core::Point2> points);

}  // namespace keyline::acquire
