#include "keyline/sketch/knot.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace keyline::sketch {
namespace {

using core::distance;
using core::Point2;

constexpr double kOffGrid = 0.4;     ///< pixels: a skeleton's rounding, 1/sqrt(12), and a little
constexpr double kOffShare = 0.5;    ///< of the half width: as far as a hand's line lies off an arc
constexpr double kBendPixels = 0.5;  ///< that a radian of bend, or turn, counts as
constexpr double kOffInk = 1;        ///< pixels beyond the ink, for the same rounding
constexpr std::ptrdiff_t kMostEnds = 2;
constexpr double kNever = 1e6;  ///< cost of a line that ends inside: only where it must

class Untying {
 public:
  Untying(const StrokeGraph& graph, const std::vector<int>& edges) : graph_(graph) {
    knot_.edges = edges;
    for (const int e : edges)
      for (const int n : {edge(e).from, edge(e).to}) {
        nodes_.insert(n);
        half_width_ = std::max(half_width_, node(n).radius);
      }
  }

  std::optional<Knot> run() {
    if (!find_exits()) return std::nullopt;
    knot_.mates = pair_up(costs(), kNever);
    if (std::count(knot_.mates.begin(), knot_.mates.end(), -1) > kMostEnds) return std::nullopt;
    for (std::size_t i = 0; i < knot_.mates.size(); ++i) {
      if (knot_.mates[i] < 0) add_tail(knot_.exits[i]);
      if (knot_.mates[i] > static_cast<int>(i))
        add_way(knot_.exits[i], knot_.exits[static_cast<std::size_t>(knot_.mates[i])]);
    }
    if (!all_covered()) return std::nullopt;
    return std::move(knot_);
  }

 private:
  const GraphEdge& edge(int e) const { return graph_.edges[static_cast<std::size_t>(e)]; }
  const GraphNode& node(int n) const { return graph_.nodes[static_cast<std::size_t>(n)]; }

  bool find_exits() {
    for (const int n : nodes_)
      for (const int e : node(n).edges) {
        if (std::find(knot_.edges.begin(), knot_.edges.end(), e) != knot_.edges.end()) continue;
        if (edge(e).from == edge(e).to) return false;
        const Branch out = make_branch(graph_, e, edge(e).to == n, 1.2 * half_width_ + 1);
        knot_.exits.push_back(out);
      }
    return knot_.exits.size() >= 4 && knot_.exits.size() <= kMostBranches;
  }

  std::vector<std::vector<double>> costs() const {
    const std::vector<Branch>& out = knot_.exits;
    std::vector<std::vector<double>> all(out.size(), std::vector<double>(out.size(), HUGE_VAL));
    for (std::size_t i = 0; i < out.size(); ++i)
      for (std::size_t k = 0; k < i; ++k) {
        if (bend_between(out[i], out[k]) > kMostBend) continue;
        const double reach = arc_reach(distance(out[i].place, out[k].place), half_width_);
        if (!on_one_arc(graph_, out[i], out[k], reach, half_width_)) continue;
        const CommonArc arc =
            common_arc(arm_of(graph_, out[i], reach), arm_of(graph_, out[k], reach));
        const bool ink = std::all_of(arc.gap.begin(), arc.gap.end(), [&](Point2 p) {
          return on_ink(p, out[i].edge) || on_ink(p, out[k].edge) || on_ink(p);
        });
        if (ink) all[i][k] = all[k][i] = going_on(graph_, out[i], out[k], reach);
      }
    return all;
  }

  bool on_ink(Point2 p, int e) const {
    const GraphEdge& line = edge(e);
    for (std::size_t i = 0; i < line.points.size(); ++i)
      if (distance(line.points[i], p) < line.radii[i] + kOffInk) return true;
    return false;
  }
  bool on_ink(Point2 p) const {
    return std::any_of(knot_.edges.begin(), knot_.edges.end(), [&](int e) { return on_ink(p, e); });
  }

  void add_way(Branch& a, Branch& b) {
    const double reach = arc_reach(distance(a.place, b.place), half_width_);
    const CommonArc arc = common_arc(arm_of(graph_, a, reach), arm_of(graph_, b, reach));
    way_.insert(way_.end(), arc.gap.begin(), arc.gap.end());
    a.way = arc.gap;
    b.way.assign(arc.gap.rbegin(), arc.gap.rend());
    way_.push_back(a.place);
    way_.push_back(b.place);
  }

  /// A line that ends inside goes straight on as far as there is ink.
  void add_tail(Branch& out) {
    out.outward = direction_of(arm_of(graph_, out, arc_reach(0, half_width_)));
    way_.push_back(out.place);
    for (double t = 1;; ++t) {
      const Point2 p = out.place - t * out.outward;
      if (!on_ink(p) && !on_ink(p, out.edge)) break;
      out.tail = t;
      way_.push_back(p);
    }
    out.tail = std::max(0.0, out.tail - half_width_);
  }

  /// Whether some line runs along every place of the knot's edges.
  bool all_covered() const {
    for (const int e : knot_.edges)
      for (std::size_t i = 0; i < edge(e).points.size(); ++i) {
        const double most = edge(e).radii[i] + kOffInk;
        if (std::none_of(way_.begin(), way_.end(),
                         [&](Point2 p) { return distance(p, edge(e).points[i]) < most; }))
          return false;
      }
    return true;
  }

  const StrokeGraph& graph_;
  Knot knot_;
  std::set<int> nodes_;
  double half_width_ = 0;
  std::vector<Point2> way_;  ///< of all lines through the knot
};

}  // namespace

double arc_reach(double gap, double half_width) {
  return std::max({2 * gap, 12 * half_width, 30.0});
}

double going_on(const StrokeGraph& graph, const Branch& a, const Branch& b, double reach) {
  const CommonArc arc = common_arc(arm_of(graph, a, reach), arm_of(graph, b, reach));
  const double bend = kBendPixels * bend_between(a, b);
  const double turn = kBendPixels * arc.turn;
  return arc.off * arc.off + bend * bend + turn * turn;
}

bool on_one_arc(const StrokeGraph& graph, const Branch& a, const Branch& b, double reach,
                double half_width) {
  return common_arc(arm_of(graph, a, reach), arm_of(graph, b, reach)).off <=
         kOffGrid + kOffShare * half_width;
}

bool is_short_end(const StrokeGraph& graph, const Branch& branch) {
  const GraphEdge& line = graph.edges[static_cast<std::size_t>(branch.edge)];
  const GraphNode& tip = graph.nodes[static_cast<std::size_t>(branch.at_end ? line.from : line.to)];
  return tip.edges.size() == 1 && length_of(line) < 2 * arc_reach(0, tip.radius);
}

std::optional<Knot> untie(const StrokeGraph& graph, const std::vector<int>& edges) {
  return Untying(graph, edges).run();
}

}  // namespace keyline::sketch
