#include "keyline/sketch/spurs.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "keyline/core/quantile.h"
#include "keyline/sketch/branch.h"
#include "keyline/sketch/shared_stretch.h"

namespace keyline::sketch {
namespace {

using core::Point2;

constexpr double kOffInk = 0.7;    ///< pixels beyond it, for a skeleton's rounding
constexpr double kSwelling = 1.3;  ///< of its usual width a line may swell by itself

const GraphNode& node_at(const StrokeGraph& g, int i) {
  return g.nodes[static_cast<std::size_t>(i)];
}
const GraphEdge& edge_at(const StrokeGraph& g, int i) {
  return g.edges[static_cast<std::size_t>(i)];
}
GraphNode& node_at(StrokeGraph& g, int i) { return g.nodes[static_cast<std::size_t>(i)]; }
GraphEdge& edge_at(StrokeGraph& g, int i) { return g.edges[static_cast<std::size_t>(i)]; }

void reverse_edge(GraphEdge& e) {
  std::swap(e.from, e.to);
  std::reverse(e.points.begin(), e.points.end());
  std::reverse(e.radii.begin(), e.radii.end());
}

/// Half the usual width of the widest of the other lines at a node.
double half_width_beside(const StrokeGraph& g, const GraphNode& node, int edge) {
  double widest = 0;
  for (const int i : node.edges) {
    if (i == edge) continue;
    widest = std::max<double>(widest, core::quantile(edge_at(g, i).radii));
  }
  return widest;
}

/// True for an end that leaves the disc of the line it sits on by less than half that line's width,
/// or by less than dirt beside a thin line does. Where a line swells its usual width counts too.
bool is_spur(const StrokeGraph& g, int edge) {
  const GraphEdge& e = edge_at(g, edge);
  if (!e.alive || e.from < 0 || e.from == e.to) return false;
  const bool free_from = node_at(g, e.from).edges.size() == 1;
  const bool free_to = node_at(g, e.to).edges.size() == 1;
  if (free_from == free_to) return false;
  const GraphNode& foot = node_at(g, free_from ? e.to : e.from);
  if (foot.edges.size() < 3) return false;
  const double length = length_of(e);
  if (length >= 1.5 * foot.radius + 3) return false;
  const double r = std::min(foot.radius, kSwelling * half_width_beside(g, foot, edge));
  return length < std::max(1.5 * r + 1.5, std::min(2 * r + 3, 6.0));
}

/// Distance of a place from a line.
double distance_to(const GraphEdge& line, Point2 p) {
  double least = HUGE_VAL;
  for (const Point2 q : line.points) least = std::min(least, core::distance(p, q));
  return least;
}

/// Takes an end off its line; the node it sat on.
int cut(StrokeGraph& g, int end) {
  GraphEdge& e = edge_at(g, end);
  e.alive = false;
  const int foot = node_at(g, e.from).edges.size() == 1 ? e.to : e.from;
  detach(g, e.from, end);
  detach(g, e.to, end);
  return foot;
}

/// The ends at a node that lead into the two corners of a line cut straight across; none elsewhere.
std::vector<int> corner_prongs(const StrokeGraph& g, const GraphNode& node) {
  if (node.edges.size() != 3) return {};
  std::vector<int> prongs;
  for (const int i : node.edges)
    if (is_spur(g, i)) prongs.push_back(i);
  if (prongs.size() != 2) return {};
  std::vector<Point2> tips;
  for (const int i : prongs) {
    const GraphEdge& e = edge_at(g, i);
    if (length_of(e) > std::numbers::sqrt2 * node.radius + 1) return {};
    tips.push_back(&node_at(g, e.from) == &node ? e.points.back() : e.points.front());
  }
  if (core::distance(tips[0], tips[1]) < node.radius) return {};
  return prongs;
}

/// A broad line cut straight across ends before its corners, not in one of them.
void cut_forked_ends(StrokeGraph& g, bool spare) {
  for (const GraphNode& node : g.nodes) {
    const std::vector<int> prongs = corner_prongs(g, node);
    if (spare && std::ranges::any_of(prongs, [&](int i) { return leading_arm(g, i) >= 0; }))
      continue;
    for (const int i : prongs) cut(g, i);
  }
}

}  // namespace

void detach(StrokeGraph& g, int node, int edge) {
  auto& list = node_at(g, node).edges;
  const auto at = std::find(list.begin(), list.end(), edge);
  if (at != list.end()) list.erase(at);
}

void join_at(StrokeGraph& g, int node) {
  if (node_at(g, node).edges.size() != 2) return;
  const int a = node_at(g, node).edges[0];
  const int b = node_at(g, node).edges[1];
  if (a == b) {
    edge_at(g, a).from = edge_at(g, a).to = -1;
    node_at(g, node).edges.clear();
    return;
  }
  GraphEdge& first = edge_at(g, a);
  GraphEdge& second = edge_at(g, b);
  if (first.to != node) reverse_edge(first);
  if (second.from != node) reverse_edge(second);
  first.points.insert(first.points.end(), second.points.begin(), second.points.end());
  first.radii.insert(first.radii.end(), second.radii.begin(), second.radii.end());
  first.to = second.to;
  second.alive = false;
  node_at(g, node).edges.clear();
  auto& list = node_at(g, first.to).edges;
  std::replace(list.begin(), list.end(), b, a);
}

int leading_arm(const StrokeGraph& g, int end) {
  if (!is_spur(g, end)) return -1;
  const GraphEdge& e = edge_at(g, end);
  const bool tip_first = node_at(g, e.from).edges.size() == 1;
  const Point2 tip = tip_first ? e.points.front() : e.points.back();
  const int foot = tip_first ? e.to : e.from;
  const double r = half_width_beside(g, node_at(g, foot), end);
  double least = r + kOffInk;
  int leading = -1;
  const auto look_at = [&](int node, int arm) {
    const GraphEdge& line = edge_at(g, arm);
    if (line.from == line.to) return;
    const Branch branch = make_branch(g, arm, line.to == node, 1.5 * node_at(g, node).radius + 1);
    const double beside = passes_beside(g, branch, tip);
    if (beside < least) least = beside, leading = arm;
  };
  for (const int beside : node_at(g, foot).edges) {
    if (beside == end) continue;
    const GraphEdge& line = edge_at(g, beside);
    if (distance_to(line, tip) < std::max(r, 1.5)) return -1;
    if (node_at(g, foot).edges.size() > 3) look_at(foot, beside);
    const int far = line.from == foot ? line.to : line.from;
    if (far == foot || node_at(g, far).edges.size() < 3 || length_of(line) > kLongestShared * r)
      continue;
    for (const int arm : node_at(g, far).edges)
      if (arm != beside) look_at(far, arm);
  }
  return leading;
}

void prune_spurs(StrokeGraph& g, bool spare) {
  cut_forked_ends(g, spare);
  for (int round = 0; round < 3; ++round) {
    // shortest first: of a forked end the longer fork stays as the line's end
    std::vector<std::pair<double, int>> spurs;
    for (int i = 0; i < static_cast<int>(g.edges.size()); ++i)
      if (is_spur(g, i)) spurs.emplace_back(length_of(edge_at(g, i)), i);
    std::sort(spurs.begin(), spurs.end());
    bool changed = false;
    for (const auto& [length, i] : spurs) {
      if (!is_spur(g, i) || (spare && leading_arm(g, i) >= 0)) continue;
      join_at(g, cut(g, i));
      changed = true;
    }
    if (!changed) return;
  }
}

}  // namespace keyline::sketch
