#include "keyline/acquire/kd_tree.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace keyline::acquire::detail {
namespace {

constexpr std::size_t kLeaf = 8;  // points that are looked through one by one

double coordinate(core::Point2 p, int axis) { return axis == 0 ? p.x : p.y; }
double coordinate(core::Point3 p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

constexpr int next_axis(core::Point2, int axis) { return 1 - axis; }
constexpr int next_axis(core::Point3, int axis) { return (axis + 1) % 3; }

template <class Vector>
double squared(Vector v) {
  return core::dot(v, v);
}

}  // namespace

/// Either the `count` nearest (a heap, farthest first) or all within a radius.
template <class Point>
struct KdTreeOf<Point>::Search {
  Point centre;
  std::size_t count = 0;  // 0: all within the radius
  std::size_t except = std::numeric_limits<std::size_t>::max();
  double limit = std::numeric_limits<double>::infinity();  // squared
  std::vector<std::pair<double, std::size_t>> found;

  void offer(double d, std::size_t index) {
    if (index == except || d > limit) return;
    found.emplace_back(d, index);
    if (count == 0) return;
    std::push_heap(found.begin(), found.end());
    if (found.size() > count) {
      std::pop_heap(found.begin(), found.end());
      found.pop_back();
    }
    if (found.size() == count) limit = found.front().first;
  }
};

template <class Point>
KdTreeOf<Point>::KdTreeOf(std::span<const Point> points) : points_(points), order_(points.size()) {
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  build(0, order_.size(), 0);
}

template <class Point>
void KdTreeOf<Point>::build(std::size_t from, std::size_t to, int axis) {
  if (to - from <= kLeaf) return;
  const std::size_t middle = from + (to - from) / 2;
  const auto at = [&](std::size_t k) { return order_.begin() + static_cast<std::ptrdiff_t>(k); };
  std::nth_element(at(from), at(middle), at(to), [&](std::size_t a, std::size_t b) {
    const double ca = coordinate(points_[a], axis);
    const double cb = coordinate(points_[b], axis);
    return ca < cb || (ca == cb && a < b);
  });
  build(from, middle, next_axis(Point{}, axis));
  build(middle + 1, to, next_axis(Point{}, axis));
}

template <class Point>
void KdTreeOf<Point>::visit(std::size_t from, std::size_t to, int axis, Search& search) const {
  if (to - from <= kLeaf) {
    for (std::size_t k = from; k < to; ++k) {
      search.offer(squared(points_[order_[k]] - search.centre), order_[k]);
    }
    return;
  }
  const std::size_t middle = from + (to - from) / 2;
  const Point split = points_[order_[middle]];
  search.offer(squared(split - search.centre), order_[middle]);
  const double d = coordinate(search.centre, axis) - coordinate(split, axis);
  const bool low = d < 0;
  visit(low ? from : middle + 1, low ? middle : to, next_axis(Point{}, axis), search);
  if (d * d <= search.limit)
    visit(low ? middle + 1 : from, low ? to : middle, next_axis(Point{}, axis), search);
}

template <class Point>
std::vector<std::size_t> KdTreeOf<Point>::nearest(Point p, std::size_t count,
                                                  std::size_t except) const {
  std::vector<std::size_t> indices;
  if (count == 0) return indices;
  Search search{p, count, except, std::numeric_limits<double>::infinity(), {}};
  search.found.reserve(std::min(count, points_.size()) + 1);
  visit(0, order_.size(), 0, search);
  std::sort(search.found.begin(), search.found.end());
  indices.reserve(search.found.size());
  for (const auto& [d, index] : search.found) indices.push_back(index);
  return indices;
}

template <class Point>
std::vector<std::size_t> KdTreeOf<Point>::within(Point p, double radius) const {
  Search search;
  search.centre = p;
  search.limit = radius * radius;
  visit(0, order_.size(), 0, search);
  std::vector<std::size_t> indices;
  for (const auto& [d, index] : search.found) indices.push_back(index);
  return indices;
}

template class KdTreeOf<core::Point2>;
template class KdTreeOf<core::Point3>;

}  // namespace keyline::acquire::detail
