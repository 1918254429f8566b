#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "keyline/core/point.h"

namespace keyline::acquire::detail {

/// Points of the plane arranged for neighbour searches; the points must outlive the tree.
/// Building costs O(n log n), a search for few neighbours O(log n).
class KdTree {
 public:
  explicit KdTree(std::span<const core::Point2> points);

  /// Indices of the `count` points nearest to p, nearest first, without the point `except`.
  std::vector<std::size_t> nearest(core::Point2 p, std::size_t count, std::size_t except) const;

  /// Indices of the points within `radius` of p, in no particular but repeatable order.
  std::vector<std::size_t> within(core::Point2 p, double radius) const;

 private:
  struct Search;
  void build(std::size_t from, std::size_t to, int axis);
  void visit(std::size_t from, std::size_t to, int axis, Search& search) const;

  std::span<const core::Point2> points_;
  std::vector<std::size_t> order_;
};

}  // namespace keyline::acquire::detail
