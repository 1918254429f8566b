#include "keyline/sketch/stroke_graph.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <unordered_map>
#include <utility>

#include "keyline/core/polygon.h"
#include "keyline/sketch/ink_radius.h"
#include "keyline/sketch/pixel_words.h"
#include "keyline/sketch/spurs.h"

namespace keyline::sketch {
namespace {

using core::Point2;

constexpr double kLensShare = 1.3;  ///< of a line's width: a hole with its rims is no wider

struct Pixel {
  int x, y;
};

/// Neighbours a line goes on to: those across an edge, and diagonal ones that no neighbour across
/// an edge leads to.
std::array<Pixel, 8> next_pixels(const Binary& lines, Pixel p, int& count) {
  static constexpr std::array<std::array<int, 2>, 8> kStep = {
      {{0, -1}, {1, -1}, {1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}}};
  const unsigned n = neighbours_of(lines, p.x, p.y);
  std::array<Pixel, 8> next{};
  count = 0;
  for (unsigned k = 0; k < 8; ++k) {
    if (((n >> k) & 1U) == 0) continue;
    if (k % 2 == 1 && (((n >> (k - 1)) & 1U) || ((n >> ((k + 1) % 8)) & 1U))) continue;
    next[static_cast<std::size_t>(count++)] = {p.x + kStep[k][0], p.y + kStep[k][1]};
  }
  return next;
}

class Builder {
 public:
  Builder(const Binary& lines, const Binary& ink)
      : lines_(lines), visited_(lines.width, lines.height), radius_(lines, ink) {}

  StrokeGraph build() {
    find_nodes();
    for (std::size_t k = 0; k < members_.size(); ++k)
      for (const Pixel p : members_[k]) follow_all(p, static_cast<int>(k));
    visit_lines([&](Pixel p) {
      if (!visited_.at(p.x, p.y)) closed_line(p);
    });
    return std::move(graph_);
  }

 private:
  static Point2 centre(Pixel p) { return {p.x + 0.5, p.y + 0.5}; }
  float radius(Pixel p) const { return radius_.at(p.x, p.y); }
  long key(Pixel p) const { return static_cast<long>(lines_.index(p.x, p.y)); }

  int degree(Pixel p) const {
    int count = 0;
    next_pixels(lines_, p, count);
    return count;
  }

  template <class See>
  void visit_lines(const See& see) const {
    for (int y = 0; y < lines_.height; ++y)
      visit_set(&lines_.data[lines_.index(0, y)], static_cast<std::size_t>(lines_.width),
                [&](std::size_t x) { see(Pixel{static_cast<int>(x), y}); });
  }

  /// Ends, single pixels, and clusters of touching junction pixels.
  void find_nodes() {
    visit_lines([&](Pixel p) {
      if (visited_.at(p.x, p.y)) return;
      const int d = degree(p);
      if (d != 2) add_node(p, d >= 3);
    });
  }

  void add_node(Pixel start, bool junction) {
    const int index = static_cast<int>(graph_.nodes.size());
    std::vector<Pixel> cluster = {start};
    visited_.at(start.x, start.y) = 1;
    for (std::size_t k = 0; junction && k < cluster.size(); ++k) {
      int count = 0;
      const auto next = next_pixels(lines_, cluster[k], count);
      for (int i = 0; i < count; ++i) {
        const Pixel q = next[static_cast<std::size_t>(i)];
        if (visited_.at(q.x, q.y) || degree(q) < 3) continue;
        visited_.at(q.x, q.y) = 1;
        cluster.push_back(q);
      }
    }
    GraphNode node;
    for (const Pixel p : cluster) {
      node.position.x += (p.x + 0.5) / static_cast<double>(cluster.size());
      node.position.y += (p.y + 0.5) / static_cast<double>(cluster.size());
      node.radius = std::max<double>(node.radius, radius(p));
      node_of_[key(p)] = index;
    }
    graph_.nodes.push_back(std::move(node));
    members_.push_back(std::move(cluster));
  }

  void follow_all(Pixel p, int node) {
    int count = 0;
    const auto next = next_pixels(lines_, p, count);
    if (count == 0 && graph_.nodes[static_cast<std::size_t>(node)].edges.empty()) {
      add_edge({node, node, {centre(p)}, {radius(p)}, true});
      return;
    }
    for (int i = 0; i < count; ++i) {
      const Pixel q = next[static_cast<std::size_t>(i)];
      const auto other = node_of_.find(key(q));
      if (other != node_of_.end()) {
        // two nodes side by side: one edge, made from the lower index
        if (other->second > node)
          add_edge({node, other->second, {centre(p), centre(q)}, {radius(p), radius(q)}, true});
      } else if (!visited_.at(q.x, q.y)) {
        follow(p, q, node);
      }
    }
  }

  void follow(Pixel from, Pixel p, int node) {
    GraphEdge edge{node, -1, {centre(from)}, {radius(from)}, true};
    Pixel before = from;
    while (true) {
      edge.points.push_back(centre(p));
      edge.radii.push_back(radius(p));
      const auto at = node_of_.find(key(p));
      if (at != node_of_.end()) {
        edge.to = at->second;
        break;
      }
      visited_.at(p.x, p.y) = 1;
      int count = 0;
      const auto next = next_pixels(lines_, p, count);
      Pixel on = p;
      for (int i = 0; i < count; ++i) {
        const Pixel q = next[static_cast<std::size_t>(i)];
        if (q.x != before.x || q.y != before.y) on = q;
      }
      if (on.x == p.x && on.y == p.y) break;
      before = p;
      p = on;
    }
    add_edge(std::move(edge));
  }

  void closed_line(Pixel start) {
    GraphEdge edge;
    Pixel p = start;
    Pixel before = {-9, -9};
    while (!visited_.at(p.x, p.y)) {
      visited_.at(p.x, p.y) = 1;
      edge.points.push_back(centre(p));
      edge.radii.push_back(radius(p));
      int count = 0;
      const auto next = next_pixels(lines_, p, count);
      Pixel on = p;
      for (int i = 0; i < count; ++i) {
        const Pixel q = next[static_cast<std::size_t>(i)];
        if ((q.x != before.x || q.y != before.y) && !visited_.at(q.x, q.y)) on = q;
      }
      before = p;
      p = on;
    }
    graph_.edges.push_back(std::move(edge));
  }

  void add_edge(GraphEdge edge) {
    if (edge.to < 0) {
      GraphNode end{edge.points.back(), edge.radii.back(), {}};
      edge.to = static_cast<int>(graph_.nodes.size());
      graph_.nodes.push_back(std::move(end));
    }
    const int index = static_cast<int>(graph_.edges.size());
    graph_.nodes[static_cast<std::size_t>(edge.from)].edges.push_back(index);
    graph_.nodes[static_cast<std::size_t>(edge.to)].edges.push_back(index);
    graph_.edges.push_back(std::move(edge));
  }

  const Binary& lines_;
  Binary visited_;
  InkRadius radius_;
  StrokeGraph graph_;
  std::vector<std::vector<Pixel>> members_;
  std::unordered_map<long, int> node_of_;
};

GraphNode& node_at(StrokeGraph& g, int i) { return g.nodes[static_cast<std::size_t>(i)]; }
GraphEdge& edge_at(StrokeGraph& g, int i) { return g.edges[static_cast<std::size_t>(i)]; }

double widest_gap(const GraphEdge& a, const GraphEdge& b) {
  double widest = 0;
  for (const Point2 p : a.points) {
    double least = core::distance(p, b.points.front());
    for (const Point2 q : b.points) least = std::min(least, core::distance(p, q));
    widest = std::max(widest, least);
  }
  return widest;
}

/// True for two edges around a hole that, ink included, is hardly wider than the line it lies in.
bool is_lens(StrokeGraph& g, const GraphEdge& a, const GraphEdge& b) {
  const double wide = std::max(node_at(g, a.from).radius, node_at(g, a.to).radius);
  if (std::max(length_of(a), length_of(b)) > 8 * wide + 4) return false;
  const float ra = a.radii[a.radii.size() / 2];
  const float rb = b.radii[b.radii.size() / 2];
  return widest_gap(a, b) + ra + rb < kLensShare * 2 * wide + 1;
}

/// Moves an edge to the middle between it and the other one; it is as wide as both and the hole.
void move_between(GraphEdge& kept, const GraphEdge& gone) {
  for (std::size_t i = 0; i < kept.points.size(); ++i) {
    std::size_t nearest = 0;
    for (std::size_t j = 1; j < gone.points.size(); ++j)
      if (core::distance(gone.points[j], kept.points[i]) <
          core::distance(gone.points[nearest], kept.points[i]))
        nearest = j;
    const Point2 other = gone.points[nearest];
    const double across =
        core::distance(kept.points[i], other) + kept.radii[i] + gone.radii[nearest];
    kept.points[i] = core::mix(kept.points[i], other, 0.5);
    kept.radii[i] = static_cast<float>(0.5 * across);
  }
}

/// Of two edges around a hole in a line one stays, in the middle.
void close_lenses(StrokeGraph& g) {
  std::map<std::pair<int, int>, int> first;
  for (int i = 0; i < static_cast<int>(g.edges.size()); ++i) {
    GraphEdge& e = edge_at(g, i);
    if (!e.alive || e.from < 0 || e.from == e.to) continue;
    const auto [at, fresh] = first.try_emplace(std::minmax(e.from, e.to), i);
    if (fresh || !is_lens(g, edge_at(g, at->second), e)) continue;
    const int other = at->second;
    const bool swap = length_of(edge_at(g, other)) > length_of(e);
    const int gone = swap ? other : i;
    at->second = swap ? i : other;
    move_between(edge_at(g, at->second), edge_at(g, gone));
    edge_at(g, gone).alive = false;
    detach(g, edge_at(g, gone).from, gone);
    detach(g, edge_at(g, gone).to, gone);
  }
  for (int n = 0; n < static_cast<int>(g.nodes.size()); ++n)
    if (node_at(g, n).edges.size() == 2) join_at(g, n);
}

}  // namespace

double length_of(const GraphEdge& edge) { return core::polygon_length(edge.points); }

StrokeGraph build_graph(const Binary& lines, const Binary& ink, bool ragged) {
  StrokeGraph graph = Builder(lines, ink).build();
  prune_spurs(graph, !ragged);
  close_lenses(graph);
  prune_spurs(graph, !ragged);
  return graph;
}

}  // namespace keyline::sketch
