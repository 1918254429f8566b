#include "keyline/acquire/band.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

#include "keyline/acquire/kd_tree.h"
#include "keyline/acquire/order.h"
#include "keyline/acquire/statistics.h"
#include "keyline/core/quantile.h"
#include "keyline/core/second_moments.h"

namespace keyline::acquire {
namespace {

constexpr std::size_t kSamples = 400;  // points whose neighbourhoods are looked at: medians of them
constexpr std::size_t kMostMoved = 6000;  // points moved one by one: each move looks at a radius
constexpr double kLong = 0.25;  // width over length that makes a neighbourhood a stretch of line

struct Spread {
  core::Point2 mean;
  core::Vector2 direction;
  double along = 0;  // standard deviations
  double across = 0;
};

Spread spread_of(std::span<const core::Point2> points, std::span<const double> weights,
                 std::span<const std::size_t> near) {
  const auto weight = [&](std::size_t i) { return weights.empty() ? 1.0 : weights[i]; };
  const core::Point2 origin = points[near[0]];
  core::Vector2 sum;
  double total = 0;
  for (const std::size_t i : near) {
    sum = sum + weight(i) * (points[i] - origin);
    total += weight(i);
  }
  Spread s;
  s.mean = origin + sum / total;
  core::SecondMoments moments;
  for (const std::size_t i : near) moments.add(points[i] - s.mean, weight(i));
  s.direction = moments.direction();
  s.along = std::sqrt(moments.along() / total);
  s.across = std::sqrt(moments.across() / total);
  return s;
}

using Cell = std::pair<std::int64_t, std::int64_t>;

Cell cell_of(core::Point2 p, double size) {
  return {static_cast<std::int64_t>(std::floor(p.x / size)),
          static_cast<std::int64_t>(std::floor(p.y / size))};
}

/// Weighted mean being collected.
struct Mean {
  core::Vector2 sum;
  double weight = 0;
  void add(core::Point2 p, double w) {
    sum = sum + w * core::Vector2{p.x, p.y};
    weight += w;
  }
  core::Point2 point() const { return {sum.x / weight, sum.y / weight}; }
};

std::vector<core::Point2> moved_to_centre(std::span<const core::Point2> points,
                                          std::span<const core::Point2> given,
                                          std::span<const double> weights, double radius) {
  const detail::KdTree tree(given);
  std::vector<core::Point2> moved(points.begin(), points.end());
  for (core::Point2& p : moved) {
    const auto near = tree.within(p, radius);
    if (near.size() < 3) continue;
    const Spread s = spread_of(given, weights, near);
    p = s.mean + core::dot(p - s.mean, s.direction) * s.direction;
  }
  return moved;
}

}  // namespace

BandWidth measure_band(std::span<const core::Point2> points) {
  if (points.size() < 24) return {};
  const detail::KdTree tree(points);
  const std::size_t skip = std::max<std::size_t>(1, points.size() / kSamples);
  for (std::size_t count = 6; count <= points.size() / 4; count *= 2) {
    std::vector<double> ratios, widths, radii;
    for (std::size_t i = 0; i < points.size(); i += skip) {
      const auto near = tree.nearest(points[i], count, points.size());
      const Spread s = spread_of(points, {}, near);
      ratios.push_back(s.along > 0 ? s.across / s.along : 1);
      widths.push_back(s.across);
      radii.push_back(core::distance(points[i], points[near.back()]));
    }
    if (core::quantile(ratios) > kLong) continue;
    const double radius = core::quantile(radii);
    return {count == 6 ? 0 : core::quantile(widths), radius};
  }
  return {};
}

Averaged average_cells(std::span<const core::Point2> points, std::span<const double> weights,
                       std::size_t most) {
  Averaged result;
  double size = detail::extent_of(points) / static_cast<double>(most);
  while (size > 0) {
    std::map<Cell, Mean> cells;
    for (std::size_t i = 0; i < points.size(); ++i) {
      cells[cell_of(points[i], size)].add(points[i], weights.empty() ? 1 : weights[i]);
      if (cells.size() > most) break;
    }
    if (cells.size() <= most) {
      for (const auto& [cell, mean] : cells) {
        if (!(mean.weight > 0)) continue;
        result.points.push_back(mean.point());
        result.weights.push_back(mean.weight);
      }
      break;
    }
    size *= 1.5;
  }
  return result;
}

Averaged average_band(std::span<const core::Point2> points, std::span<const double> weights,
                      double radius) {
  // Many points are first averaged to a few thousand, far finer than the band is wide.
  Averaged base{{points.begin(), points.end()}, {weights.begin(), weights.end()}};
  if (points.size() > kMostMoved) base = average_cells(points, weights, kMostMoved);
  std::vector<core::Point2> centre = base.points;
  for (int pass = 0; pass < 2; ++pass) {
    centre = moved_to_centre(centre, base.points, base.weights, radius);
  }
  const Averaged reduced = average_cells(centre, base.weights, 2000);
  const Ordering ordering = order_points(reduced.points);
  // Each point goes to the nearest point of the ordered centre line, and these to stretches.
  std::vector<core::Point2> line;
  for (const std::size_t i : ordering.order) line.push_back(reduced.points[i]);
  std::vector<std::size_t> stretch(line.size(), 0);
  double since = 0;
  for (std::size_t k = 1; k < line.size(); ++k) {
    since += core::distance(line[k - 1], line[k]);
    stretch[k] = stretch[k - 1];
    if (since >= 0.5 * radius) {
      ++stretch[k];
      since = 0;
    }
  }
  std::vector<Mean> means(stretch.back() + 1);
  const detail::KdTree tree(line);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t k = tree.nearest(points[i], 1, line.size()).front();
    if (core::distance(line[k], points[i]) > radius) continue;
    means[stretch[k]].add(points[i], weights.empty() ? 1 : weights[i]);
  }
  Averaged result;
  for (const Mean& mean : means) {
    if (!(mean.weight > 0)) continue;
    result.points.push_back(mean.point());
    result.weights.push_back(mean.weight);
  }
  return result;
}

Averaged average_runs(std::span<const core::Point2> points, std::span<const double> weights,
                      std::span<const std::size_t> keep, std::size_t most) {
  Averaged result;
  const std::size_t group = points.size() / std::max<std::size_t>(most, 1) + 1;
  const auto weight = [&](std::size_t i) { return weights.empty() ? 1.0 : weights[i]; };
  Mean mean;
  std::size_t held = 0;
  const auto flush = [&] {
    if (held > 0 && mean.weight > 0) {
      result.points.push_back(mean.point());
      result.weights.push_back(mean.weight);
    }
    mean = {};
    held = 0;
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (std::binary_search(keep.begin(), keep.end(), i)) {
      flush();
      result.points.push_back(points[i]);
      result.weights.push_back(weight(i));
      continue;
    }
    mean.add(points[i], weight(i));
    if (++held == group) flush();
  }
  flush();
  return result;
}

}  // namespace keyline::acquire
