#include "keyline/acquire/places.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace keyline::acquire::detail {
namespace {

auto place(core::Point2 p) { return std::tuple(p.x, p.y); }
auto place(const core::Point3& p) { return std::tuple(p.x, p.y, p.z); }

template <class Point>
std::vector<std::size_t> first_of(std::span<const Point> points) {
  std::vector<std::size_t> by_place(points.size());
  std::iota(by_place.begin(), by_place.end(), std::size_t{0});
  std::sort(by_place.begin(), by_place.end(), [&](std::size_t a, std::size_t b) {
    const auto p = place(points[a]), q = place(points[b]);
    return p < q || (p == q && a < b);
  });
  std::vector<std::size_t> first(points.size());
  for (std::size_t k = 0; k < by_place.size(); ++k) {
    const std::size_t i = by_place[k];
    const bool repeats = k > 0 && points[i] == points[by_place[k - 1]];
    first[i] = repeats ? first[by_place[k - 1]] : i;
  }
  return first;
}

}  // namespace

std::vector<std::size_t> first_at_place(std::span<const core::Point2> points) {
  return first_of(points);
}

std::vector<std::size_t> first_at_place(std::span<const core::Point3> points) {
  return first_of(points);
}

}  // namespace keyline::acquire::detail
