#include "keyline/fairing/condense.h"

#include <algorithm>
#include <cmath>

#include "keyline/core/angle.h"

namespace keyline::fairing::detail {
namespace {

FitPoint mean_of(std::span<const core::Point2> points, std::span<const double> weights) {
  FitPoint mean;
  mean.weight = 0;
  mean.count = static_cast<double>(points.size());
  core::Vector2 sum;
  double total = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double w = weights.empty() ? 1 : weights[i];
    sum = sum + w * core::Vector2{points[i].x, points[i].y};
    total += w;
  }
  mean.position = {sum.x / total, sum.y / total};
  mean.weight = total;
  return mean;
}

/// Spread of a run about the line along which its neighbours' means lie.
void measure_spread(FitPoint& mean, std::span<const core::Point2> run, core::Vector2 along) {
  const double size = core::norm(along);
  if (size == 0) return;
  const core::Vector2 normal = (1 / size) * core::perpendicular_left(along);
  for (const core::Point2 p : run) {
    const double offset = core::dot(p - mean.position, normal);
    mean.low = std::min(mean.low, offset);
    mean.high = std::max(mean.high, offset);
  }
}

constexpr double kGrid = 0x1p-33;  // of the length: steps of the points in the search

}  // namespace

std::vector<FitPoint> cut_digits(std::vector<FitPoint> points) {
  const auto cut = [](double x) { return kGrid * std::round(x / kGrid); };
  for (FitPoint& p : points) {
    p.position = {cut(p.position.x), cut(p.position.y)};
    p.low = cut(p.low);
    p.high = cut(p.high);
  }
  return points;
}
std::size_t condensed_index(std::size_t j, std::size_t n, std::size_t most) {
  if (n <= most || j == 0) return j;
  if (j + 1 == n) return most - 1;
  const std::size_t bins = most - 2;
  std::size_t b = (j - 1) * bins / (n - 2);
  while (1 + (n - 2) * (b + 1) / bins <= j) ++b;
  return b + 1;
}

std::vector<FitPoint> condense(std::span<const core::Point2> points,
                               std::span<const double> weights, std::size_t most) {
  std::vector<FitPoint> result;
  const std::size_t n = points.size();
  if (n <= most) {
    for (std::size_t i = 0; i < n; ++i)
      result.push_back({.position = points[i], .weight = weights.empty() ? 1 : weights[i]});
    return result;
  }
  // The ends stay single points: they pin the chain.
  const std::size_t bins = most - 2;
  std::vector<std::size_t> cut(bins + 1);
  for (std::size_t b = 0; b <= bins; ++b) cut[b] = 1 + (n - 2) * b / bins;
  const auto slice = [&](auto list, std::size_t b) {
    return list.empty() ? list : list.subspan(cut[b], cut[b + 1] - cut[b]);
  };
  result.push_back({.position = points.front(), .weight = weights.empty() ? 1 : weights[0]});
  for (std::size_t b = 0; b < bins; ++b)
    result.push_back(mean_of(slice(points, b), slice(weights, b)));
  result.push_back({.position = points.back(), .weight = weights.empty() ? 1 : weights.back()});
  for (std::size_t b = 0; b < bins; ++b)
    measure_spread(result[b + 1], slice(points, b), result[b + 2].position - result[b].position);
  return result;
}

}  // namespace keyline::fairing::detail
