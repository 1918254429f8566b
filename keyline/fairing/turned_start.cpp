#include "keyline/fairing/turned_start.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "keyline/core/point.h"

namespace keyline::fairing::detail {
namespace {

template <class T>
void turn(std::vector<T>& list, std::size_t first) {
  if (!list.empty())
    std::rotate(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(first), list.end());
}

void turn_indices(std::vector<std::size_t>& indices, std::size_t first, std::size_t count) {
  for (std::size_t& index : indices) index = (index + count - first) % count;
  std::ranges::sort(indices);
}

/// Lengths of the closed way from the first point to each, and back to itself.
std::vector<double> way(const std::vector<core::Point2>& points) {
  std::vector<double> at{0};
  for (std::size_t i = 0; i < points.size(); ++i)
    at.push_back(at.back() + core::distance(points[i], points[(i + 1) % points.size()]));
  return at;
}

}  // namespace

bool runs_over_start(const FairOptions& options) {
  return options.region && (options.region->low < 0 || options.region->high > 1);
}

TurnedStart turn_start(const acquire::KeyLine& line, const FairOptions& options) {
  TurnedStart turned{line, options};
  const core::Interval region = *options.region;
  const double opposite = (region.low + region.high) / 2 + 0.5;
  const std::vector<double> at = way(line.points);
  const double wanted = (opposite - std::floor(opposite)) * at.back();
  const auto nearest =
      std::ranges::min_element(at, {}, [wanted](double place) { return std::abs(place - wanted); });
  turned.first = static_cast<std::size_t>(nearest - at.begin()) % line.points.size();
  const double begin = at[turned.first] / at.back();
  const double low = region.low - begin - std::floor(region.low - begin);
  turned.options.region = {low, std::min(low + (region.high - region.low), 1.0)};
  turn(turned.line.points, turned.first);
  turn(turned.line.weights, turned.first);
  turn(turned.line.sources, turned.first);
  turn_indices(turned.line.corners, turned.first, line.points.size());
  turn_indices(turned.options.must_pass, turned.first, line.points.size());
  return turned;
}

void turn_back(FairResult& result, std::size_t first) {
  const std::size_t count = result.offsets.size();
  if (count == 0) return;
  turn(result.offsets, count - first);
  result.worst_point = (result.worst_point + first) % count;
  result.notes.push_back(fmt::format("the answer begins at point {}, outside the region", first));
}

}  // namespace keyline::fairing::detail
