#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "keyline/core/point.h"
#include "keyline/core/progress.h"

namespace keyline::acquire::detail {

/// Between two points by their numbers, in 16 bytes: of a million points there are millions.
struct Edge {
  std::uint32_t a = 0;
  std::uint32_t b = 0;
  double length = 0;
};

/// The 8 nearest neighbours of every point; of those that come once it is cancelled, none.
std::vector<std::vector<std::size_t>> neighbour_lists(
    std::span<const core::Point2> points, const core::CancellationToken& cancellation = {});

/// Edges of the minimum spanning tree of the neighbour graph, shortest first (Kruskal). A forest
/// where the graph falls apart, unless `connect`: then the trees are joined by shortest edges
/// (of those between trees, O(trees * n) work). Precondition: less than 2^32 points.
std::vector<Edge> spanning_tree(std::span<const core::Point2> points,
                                const std::vector<std::vector<std::size_t>>& neighbours,
                                bool connect);

/// Points of the longest path of a tree, end to end.
std::vector<std::size_t> longest_path(std::size_t count, std::span<const Edge> tree);

}  // namespace keyline::acquire::detail
