#include "keyline/sketch/shared_stretch.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "keyline/sketch/branch.h"
#include "keyline/sketch/knot.h"
#include "keyline/sketch/spurs.h"

namespace keyline::sketch {
namespace {

const GraphEdge& edge_at(const StrokeGraph& g, int i) {
  return g.edges[static_cast<std::size_t>(i)];
}
const GraphNode& node_at(const StrokeGraph& g, int i) {
  return g.nodes[static_cast<std::size_t>(i)];
}

bool touch(const GraphEdge& a, const GraphEdge& b) {
  return a.from == b.from || a.from == b.to || a.to == b.from || a.to == b.to;
}

/// Two branches out of a node that soon meet again at their other ends: the sides of a hole.
bool rejoin(const StrokeGraph& g, const std::vector<Branch>& pair, int n, double most) {
  const GraphEdge& a = edge_at(g, pair[0].edge);
  const GraphEdge& b = edge_at(g, pair[1].edge);
  const auto other = [&](const GraphEdge& e) { return e.from == n ? e.to : e.from; };
  return other(a) == other(b) && length_of(a) < most && length_of(b) < most;
}

/// Whether the lines on the left go on in those on the right.
bool go_on_across(const StrokeGraph& g, const std::vector<Branch>& left,
                  const std::vector<Branch>& right, double length, double wide) {
  const double reach = arc_reach(length, wide);
  const auto cost = [&](std::size_t l, std::size_t r) {
    return going_on(g, left[l], right[r], reach);
  };
  const std::size_t mate = cost(0, 1) + cost(1, 0) < cost(0, 0) + cost(1, 1) ? 1 : 0;
  for (const std::size_t l : {0U, 1U}) {
    const Branch& other = right[l == 0 ? mate : 1 - mate];
    if (bend_between(left[l], other) >= kMostBend) return false;
    if (length > kShortShared * wide && !on_one_arc(g, left[l], other, reach, wide)) return false;
  }
  return true;
}

}  // namespace

bool is_shared_stretch(const StrokeGraph& g, int e) {
  const GraphEdge& line = edge_at(g, e);
  const double wide = std::max(node_at(g, line.from).radius, node_at(g, line.to).radius);
  const double length = length_of(line);
  if (length > kLongestShared * wide) return false;
  std::array<std::vector<Branch>, 2> sides;
  for (const std::size_t k : {0U, 1U}) {
    const int n = k == 0 ? line.from : line.to;
    if (node_at(g, n).edges.size() != 3) return false;
    for (const int other : node_at(g, n).edges) {
      if (other == e) continue;
      const int arm = leading_arm(g, other);
      if (arm >= 0 && touch(edge_at(g, arm), line)) return true;
      if (length_of(edge_at(g, other)) < 2 * wide) return false;
      sides[k].push_back(make_branch(g, other, edge_at(g, other).to == n, 1.5 * wide + 1));
    }
    if (sides[k].size() != 2 || rejoin(g, sides[k], n, 6 * wide)) return false;
  }
  return go_on_across(g, sides[0], sides[1], length, wide);
}

}  // namespace keyline::sketch
