#include "keyline/acquire/order.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "keyline/acquire/kd_tree.h"
#include "keyline/acquire/places.h"
#include "keyline/acquire/spanning_tree.h"
#include "keyline/acquire/statistics.h"
#include "keyline/core/quantile.h"

namespace keyline::acquire {
namespace {

using Order = std::vector<std::size_t>;
using Lists = std::vector<std::vector<std::size_t>>;
constexpr std::size_t kAbsent = std::numeric_limits<std::size_t>::max();

/// Sum of all but the longest twentieth.
double trimmed_sum(std::vector<double> lengths) {
  std::sort(lengths.begin(), lengths.end());
  const std::size_t kept = lengths.size() - lengths.size() / 20;
  return std::accumulate(lengths.begin(), lengths.begin() + static_cast<std::ptrdiff_t>(kept), 0.0);
}

template <class Point>
std::vector<double> steps_of(std::span<const Point> points) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < points.size(); ++i) {
    steps.push_back(core::distance(points[i - 1], points[i]));
  }
  return steps;
}

/// Repeated points hang on the tree by edges of no length: searched for neighbours, each would find
/// only the others at its place.
bool follows_tree(std::span<const core::Point2> points,
                  const core::CancellationToken& cancellation) {
  const std::vector<std::size_t> first = detail::first_at_place(points);
  std::vector<core::Point2> places;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (first[i] == i) places.push_back(points[i]);
  }
  std::vector<double> edges(points.size() - places.size(), 0.0);
  const Lists neighbours = detail::neighbour_lists(places, cancellation);
  for (const auto& edge : detail::spanning_tree(places, neighbours, false))
    edges.push_back(edge.length);
  return trimmed_sum(steps_of(points)) <= 2 * trimmed_sum(std::move(edges));
}

std::vector<core::Point2> group_means(std::span<const core::Point2> points, std::size_t group) {
  std::vector<core::Point2> means;
  for (std::size_t first = 0; first + group <= points.size(); first += group) {
    core::Vector2 sum;
    for (std::size_t k = 0; k < group; ++k) sum = sum + (points[first + k] - points[first]);
    means.push_back(points[first] + sum / static_cast<double>(group));
  }
  return means;
}

/// Shortens a path over points by local changes.
class PathCleaner {
 public:
  PathCleaner(std::span<const core::Point2> points, const Lists& neighbours, Order path)
      : points_(points), neighbours_(neighbours), path_(std::move(path)), place_(points.size()) {
    refresh();
  }

  Order run() {
    for (int pass = 0; pass < 40; ++pass) {
      const bool turned = reverse_stretches();
      const bool moved = move_points();
      if (!turned && !moved) break;
    }
    return std::move(path_);
  }

 private:
  void refresh() {
    std::fill(place_.begin(), place_.end(), kAbsent);
    for (std::size_t k = 0; k < path_.size(); ++k) place_[path_[k]] = k;
  }

  double gap(std::size_t i, std::size_t k) const { return core::distance(points_[i], points_[k]); }

  /// Length of the step between places k and k + 1; 0 past the ends of the open path.
  double step(std::ptrdiff_t k) const {
    if (k < 0 || k + 1 >= static_cast<std::ptrdiff_t>(path_.size())) return 0;
    return gap(path_[static_cast<std::size_t>(k)], path_[static_cast<std::size_t>(k) + 1]);
  }

  void reverse(std::size_t from, std::size_t to) {
    std::reverse(path_.begin() + static_cast<std::ptrdiff_t>(from),
                 path_.begin() + static_cast<std::ptrdiff_t>(to) + 1);
    for (std::size_t k = from; k <= to; ++k) place_[path_[k]] = k;
  }

  /// 2-opt: turns [i + 1, j] round where the two new steps are shorter than the two old ones.
  bool reverse_stretches() {
    bool any = false;
    const std::size_t last = path_.size() - 1;
    for (std::size_t i = 0; i < last; ++i) {
      for (const std::size_t near : neighbours_[path_[i]]) {
        const std::size_t j = place_[near];
        if (j == kAbsent || j <= i + 1) continue;
        const double before =
            step(static_cast<std::ptrdiff_t>(i)) + step(static_cast<std::ptrdiff_t>(j));
        const double after =
            gap(path_[i], path_[j]) + (j < last ? gap(path_[i + 1], path_[j + 1]) : 0);
        if (after >= before * (1 - 1e-12)) continue;
        reverse(i + 1, j);
        any = true;
      }
    }
    // The stretch from the start turned round.
    for (const std::size_t near : neighbours_[path_[0]]) {
      const std::size_t j = place_[near];
      if (j == kAbsent || j < 2) continue;
      if (gap(path_[0], path_[j]) >= gap(path_[j - 1], path_[j]) * (1 - 1e-12)) continue;
      reverse(0, j - 1);
      any = true;
      break;
    }
    return any;
  }

  /// Moves single points between neighbours where that shortens the path.
  bool move_points() {
    bool any = false;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (place_[i] == kAbsent) continue;
      any = move_point(i) || any;
    }
    return any;
  }

  bool move_point(std::size_t i) {
    const auto k = static_cast<std::ptrdiff_t>(place_[i]);
    const auto size = static_cast<std::ptrdiff_t>(path_.size());
    const auto at = [&](std::ptrdiff_t p) { return path_[static_cast<std::size_t>(p)]; };
    const double bypass = k > 0 && k + 1 < size ? gap(at(k - 1), at(k + 1)) : 0;
    const double gain = step(k - 1) + step(k) - bypass;
    for (const std::size_t near : neighbours_[i]) {
      if (place_[near] == kAbsent) continue;
      for (const std::ptrdiff_t side : {-1, 0}) {
        // Between places p and p + 1.
        const std::ptrdiff_t p = static_cast<std::ptrdiff_t>(place_[near]) + side;
        if (p == k || p == k - 1 || p < 0 || p + 1 >= size) continue;
        const double detour = gap(at(p), i) + gap(i, at(p + 1)) - step(p);
        if (detour >= gain * (1 - 1e-12) - 1e-300) continue;
        const auto from = path_.begin() + k;
        if (p > k) {
          std::rotate(from, from + 1, path_.begin() + p + 1);
        } else {
          std::rotate(path_.begin() + p + 1, from, from + 1);
        }
        for (std::ptrdiff_t q = std::min(k, p); q <= std::max(k, p + 1); ++q) {
          place_[at(q)] = static_cast<std::size_t>(q);
        }
        return true;
      }
    }
    return false;
  }

  std::span<const core::Point2> points_;
  const Lists& neighbours_;
  Order path_;
  std::vector<std::size_t> place_;
};

/// Path as a list into which points are put.
struct Chainlet {
  std::vector<std::size_t> next, previous;
  std::vector<bool> present;
  std::size_t first = kAbsent;

  Chainlet(std::size_t n, const Order& path)
      : next(n, kAbsent), previous(n, kAbsent), present(n, false), first(path.front()) {
    for (std::size_t k = 0; k < path.size(); ++k) {
      present[path[k]] = true;
      if (k > 0) previous[path[k]] = path[k - 1];
      if (k + 1 < path.size()) next[path[k]] = path[k + 1];
    }
  }

  void insert(std::size_t i, std::size_t after, std::size_t before) {
    previous[i] = after;
    next[i] = before;
    if (after == kAbsent) {
      first = i;
    } else {
      next[after] = i;
    }
    if (before != kAbsent) previous[before] = i;
    present[i] = true;
  }

  Order order() const {
    Order all;
    for (std::size_t i = first; i != kAbsent; i = next[i]) all.push_back(i);
    return all;
  }
};

/// Puts i where the detour is least among the steps beside its neighbours; false where there is
/// none below `most`.
bool insert_best(std::span<const core::Point2> points, const std::vector<std::size_t>& neighbours,
                 std::size_t i, double most, Chainlet& list) {
  double least = most;
  std::size_t best_after = kAbsent, best_before = kAbsent;
  const auto gap = [&](std::size_t a, std::size_t b) {
    return core::distance(points[a], points[b]);
  };
  const auto consider = [&](std::size_t after, std::size_t before) {
    double detour = 0;
    if (after != kAbsent) detour += gap(after, i);
    if (before != kAbsent) detour += gap(i, before);
    if (after != kAbsent && before != kAbsent) detour -= gap(after, before);
    if (detour >= least) return;
    least = detour;
    best_after = after;
    best_before = before;
  };
  for (const std::size_t k : neighbours) {
    if (!list.present[k]) continue;
    consider(k, list.next[k]);
    consider(list.previous[k], k);
  }
  if (best_after == kAbsent && best_before == kAbsent) return false;
  list.insert(i, best_after, best_before);
  return true;
}

}  // namespace

bool is_ordered(std::span<const core::Point2> points, const core::CancellationToken& cancellation) {
  if (points.size() < 6 || cancellation.stop_requested()) return true;
  if (follows_tree(points, cancellation)) return true;
  if (core::quantile(steps_of(points)) > 0.02 * detail::extent_of(points)) return false;
  for (std::size_t group = 4; points.size() / group >= 16; group *= 2) {
    if (cancellation.stop_requested() || follows_tree(group_means(points, group), cancellation))
      return true;
  }
  return false;
}

bool is_ordered(std::span<const core::Point3> points) {
  constexpr double kMost = 10;
  if (points.size() < 6) return true;
  const detail::KdTree3 tree(points);
  std::vector<double> nearest;
  for (std::size_t i = 0; i < points.size(); ++i)
    nearest.push_back(core::distance(points[i], points[tree.nearest(points[i], 1, i).front()]));
  const double near = core::quantile(std::move(nearest));
  return near == 0 || core::quantile(steps_of(points)) <= kMost * near;
}

Ordering order_points(std::span<const core::Point2> points) {
  Ordering result;
  if (points.size() < 3) {
    result.order.resize(points.size());
    std::iota(result.order.begin(), result.order.end(), std::size_t{0});
    return result;
  }
  const Lists neighbours = detail::neighbour_lists(points);
  const auto tree = detail::spanning_tree(points, neighbours, true);
  const Order path = detail::longest_path(points.size(), tree);
  std::vector<double> lengths;
  for (const auto& edge : tree) lengths.push_back(edge.length);
  const double most = 12 * core::quantile(std::move(lengths));

  Chainlet list(points.size(), path);
  Order left;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!list.present[i]) left.push_back(i);
  }
  bool any = true;
  while (any && !left.empty()) {
    any = false;
    Order still;
    for (const std::size_t i : left) {
      if (insert_best(points, neighbours[i], i, most, list)) {
        any = true;
      } else {
        still.push_back(i);
      }
    }
    left = std::move(still);
  }
  result.dropped = std::move(left);
  result.order = PathCleaner(points, neighbours, list.order()).run();
  return result;
}

}  // namespace keyline::acquire
