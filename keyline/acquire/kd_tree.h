#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "keyline/core/point.h"

namespace keyline::acquire::detail {

/// Points of the plane or of space arranged for neighbour searches; the points must outlive the
/// tree. Building costs O(n log n), a search for few neighbours O(log n).
template <class Point>
class KdTreeOf {
 public:
  explicit KdTreeOf(std::span<const Point> points);

  /// Indices of the `count` points nearest to p, nearest first, without the point `except`.
  std::vector<std::size_t> nearest(Point p, std::size_t count, std::size_t except) const;

  /// Indices of the points within `radius` of p, in no particular but repeatable order.
  std::vector<std::size_t> within(Point p, double radius) const;

 private:
  struct Search;
  void build(std::size_t from, std::size_t to, int axis);
  void visit(std::size_t from, std::size_t to, int axis, Search& search) const;

  std::span<const Point> points_;
  std::vector<std::size_t> order_;
};

extern template class KdTreeOf<core::Point2>;
extern template class KdTreeOf<core::Point3>;
using KdTree = KdTreeOf<core::Point2>;
using KdTree3 = KdTreeOf<core::Point3>;

}  // namespace keyline::acquire::detail
