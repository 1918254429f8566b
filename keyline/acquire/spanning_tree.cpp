#include "keyline/acquire/spanning_tree.h"

#include <algorithm>
#include <limits>
#include <tuple>
#include <utility>

#include "keyline/acquire/kd_tree.h"
#include "keyline/core/disjoint_sets.h"

namespace keyline::acquire::detail {
namespace {

constexpr std::size_t kNeighbours = 8;  // as in a lattice; trees left apart are bridged afterwards

bool shorter(const Edge& p, const Edge& q) {
  return std::tie(p.length, p.a, p.b) < std::tie(q.length, q.a, q.b);
}

Edge edge_between(std::span<const core::Point2> points, std::size_t i, std::size_t k) {
  return {static_cast<std::uint32_t>(std::min(i, k)), static_cast<std::uint32_t>(std::max(i, k)),
          core::distance(points[i], points[k])};
}

/// Calls each(i, k) for every pair of neighbours, once where both name each other.
template <class Each>
void each_pair(const std::vector<std::vector<std::size_t>>& neighbours, Each&& each) {
  for (std::size_t i = 0; i < neighbours.size(); ++i)
    for (const std::size_t k : neighbours[i])
      if (i < k || std::ranges::find(neighbours[k], i) == neighbours[k].end()) each(i, k);
}

std::vector<Edge> edges_of(std::span<const core::Point2> points,
                           const std::vector<std::vector<std::size_t>>& neighbours) {
  std::size_t count = 0;
  each_pair(neighbours, [&](std::size_t, std::size_t) { ++count; });
  std::vector<Edge> edges;
  edges.reserve(count);
  each_pair(neighbours,
            [&](std::size_t i, std::size_t k) { edges.push_back(edge_between(points, i, k)); });
  return edges;
}

/// The shortest edge from the tree of point 0 to any other.
Edge bridge(std::span<const core::Point2> points, core::DisjointSets& sets) {
  std::vector<core::Point2> inside;
  std::vector<std::size_t> index;
  const std::size_t home = sets.find(0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (sets.find(i) != home) continue;
    inside.push_back(points[i]);
    index.push_back(i);
  }
  const KdTree tree(inside);
  Edge best{0, 0, std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (sets.find(i) == home) continue;
    const auto near = tree.nearest(points[i], 1, std::numeric_limits<std::size_t>::max());
    const std::size_t k = near.front();
    const Edge edge{static_cast<std::uint32_t>(index[k]), static_cast<std::uint32_t>(i),
                    core::distance(inside[k], points[i])};
    if (shorter(edge, best)) best = edge;
  }
  return best;
}

/// Distances along the tree from one point; also who came from where.
struct Reach {
  std::vector<double> distance;
  std::vector<std::size_t> from;
  std::size_t farthest = 0;
};

using Links = std::vector<std::vector<std::pair<std::size_t, double>>>;

Reach reach_from(const Links& links, std::size_t start) {
  const double unseen = -1;
  Reach reach{std::vector<double>(links.size(), unseen),
              std::vector<std::size_t>(links.size(), start), start};
  std::vector<std::size_t> todo{start};
  reach.distance[start] = 0;
  while (!todo.empty()) {
    const std::size_t i = todo.back();
    todo.pop_back();
    if (reach.distance[i] > reach.distance[reach.farthest]) reach.farthest = i;
    for (const auto& [k, length] : links[i]) {
      if (reach.distance[k] != unseen) continue;
      reach.distance[k] = reach.distance[i] + length;
      reach.from[k] = i;
      todo.push_back(k);
    }
  }
  return reach;
}

}  // namespace

std::vector<std::vector<std::size_t>> neighbour_lists(std::span<const core::Point2> points,
                                                      const core::CancellationToken& cancellation) {
  const KdTree tree(points);
  std::vector<std::vector<std::size_t>> lists(points.size());
  for (std::size_t i = 0; i < points.size() && !cancellation.stop_requested(); ++i) {
    lists[i] = tree.nearest(points[i], kNeighbours, i);
  }
  return lists;
}

std::vector<Edge> spanning_tree(std::span<const core::Point2> points,
                                const std::vector<std::vector<std::size_t>>& neighbours,
                                bool connect) {
  std::vector<Edge> edges = edges_of(points, neighbours);
  std::sort(edges.begin(), edges.end(), shorter);
  core::DisjointSets sets(points.size());
  std::vector<Edge> tree;
  tree.reserve(points.empty() ? 0 : points.size() - 1);
  for (const Edge& edge : edges) {
    if (sets.join(edge.a, edge.b)) tree.push_back(edge);
  }
  while (connect && tree.size() + 1 < points.size()) {
    const Edge edge = bridge(points, sets);
    sets.join(edge.a, edge.b);
    tree.push_back(edge);
  }
  return tree;
}

std::vector<std::size_t> longest_path(std::size_t count, std::span<const Edge> tree) {
  Links links(count);
  for (const Edge& edge : tree) {
    links[edge.a].emplace_back(edge.b, edge.length);
    links[edge.b].emplace_back(edge.a, edge.length);
  }
  std::vector<std::size_t> path;
  if (count == 0) return path;
  const std::size_t one_end = reach_from(links, 0).farthest;
  const Reach reach = reach_from(links, one_end);
  for (std::size_t i = reach.farthest; i != one_end; i = reach.from[i]) path.push_back(i);
  path.push_back(one_end);
  return path;
}

}  // namespace keyline::acquire::detail
