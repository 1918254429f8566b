#include "keyline/sketch/join_strokes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "keyline/core/angle.h"
#include "keyline/core/disjoint_sets.h"
#include "keyline/core/polygon.h"
#include "keyline/core/quantile.h"
#include "keyline/sketch/branch.h"
#include "keyline/sketch/bridge_gaps.h"
#include "keyline/sketch/dot_rows.h"
#include "keyline/sketch/knot.h"
#include "keyline/sketch/shared_stretch.h"
#include "keyline/sketch/spurs.h"

namespace keyline::sketch {
namespace {

using core::distance;
using core::Point2;
using core::Vector2;

/// Radians: lines that meet at less run into one before their centres do.
constexpr double kFork = 0.8;

/// A skeleton that turns into a corner of its line's end does so within the corner's diagonal, in
/// half widths; it ends where the ink is narrower than this share of its usual width.
constexpr double kHook = std::numbers::sqrt2;
constexpr double kCorner = 0.7;

constexpr double kForkReach = 20;  ///< pixels of what follows that tell whose it is

/// How far from its end a line turns into a corner of it; 0 where it ends in its middle.
double hook_of(const GraphEdge& line, bool at_end) {
  const double usual = core::quantile(line.radii);
  const double last = at_end ? line.radii.back() : line.radii.front();
  return last < kCorner * usual ? kHook * usual : 0;
}

class Joiner {
 public:
  Joiner(StrokeGraph graph, const JoinOptions& options)
      : graph_(std::move(graph)), options_(options) {
    make_clusters();
    make_branches();
    for (std::size_t c = 0; c < members_.size(); ++c) match(members_[c], shared_[c]);
    if (options_.rows) join_rows_of_dots(graph_, branches_);
    bridge_.resize(graph_.edges.size());
    bridge_gaps(graph_, options_, branches_);
  }

  std::vector<RawStroke> strokes() {
    std::vector<RawStroke> all;
    std::vector<bool> used(graph_.edges.size());
    for (const bool cycles : {false, true})
      for (std::size_t e = 0; e < graph_.edges.size(); ++e) {
        const GraphEdge& edge = graph_.edges[e];
        const int start = branch_of(static_cast<int>(e), false);
        if (!edge.alive || used[e] || bridge_[e]) continue;
        if (edge.points.size() < 2 && at(start).edge < 0) continue;  // a dot of no row
        if (edge.from < 0) {
          used[e] = true;
          all.push_back(whole(edge, true));
          continue;
        }
        const int end = branch_of(static_cast<int>(e), true);
        if (at(start).mate < 0 || (cycles && at(end).mate >= 0)) {
          all.push_back(walk(start, used));
        } else if (at(end).mate < 0) {
          all.push_back(walk(end, used));
        }
      }
    return all;
  }

 private:
  const GraphEdge& edge(int i) const { return graph_.edges[static_cast<std::size_t>(i)]; }
  const GraphNode& node(int i) const { return graph_.nodes[static_cast<std::size_t>(i)]; }
  Branch& at(int i) { return branches_[static_cast<std::size_t>(i)]; }
  int branch_of(int e, bool at_end) const { return 2 * e + (at_end ? 1 : 0); }

  int root(int n) { return static_cast<int>(clusters_.find(static_cast<std::size_t>(n))); }
  void merge(int a, int b) {
    clusters_.join(static_cast<std::size_t>(a), static_cast<std::size_t>(b));
  }

  bool is_junction(int n) const { return n >= 0 && node(n).edges.size() >= 3; }

  /// Short edges between junctions disappear into one cluster.
  void make_clusters() {
    clusters_ = core::DisjointSets(graph_.nodes.size());
    bridge_.assign(graph_.edges.size(), false);
    for (std::size_t e = 0; e < graph_.edges.size(); ++e) {
      const GraphEdge& line = graph_.edges[e];
      if (!line.alive || !is_junction(line.from) || !is_junction(line.to)) continue;
      const double length = length_of(line);
      const double radius = std::max(node(line.from).radius, node(line.to).radius);
      const bool inside = length < 1.3 * radius + 1;
      if (line.from == line.to ? inside
                               : inside || is_shared_stretch(graph_, static_cast<int>(e))) {
        bridge_[e] = true;
        merge(line.from, line.to);
      }
    }
    for (const double times : {1.0, 2.0, 4.0}) join_knots(times);
    members_.assign(graph_.nodes.size(), {});
  }

  /// Where several lines cross near each other the edges between the crossings are too short to
  /// tell a direction: such knots are one cluster. Short are edges of so many times their usual
  /// length.
  void join_knots(double times) {
    core::DisjointSets near(graph_.nodes.size());
    std::vector<int> shorts;
    for (std::size_t e = 0; e < graph_.edges.size(); ++e) {
      const GraphEdge& line = graph_.edges[e];
      if (!line.alive || !is_junction(line.from) || !is_junction(line.to)) continue;
      const double radius = std::max(node(line.from).radius, node(line.to).radius);
      if (!bridge_[e] && length_of(line) > times * (4 * radius + 5)) continue;
      shorts.push_back(static_cast<int>(e));
      near.join(static_cast<std::size_t>(line.from), static_cast<std::size_t>(line.to));
    }
    std::map<std::size_t, std::vector<int>> inner;
    for (const int e : shorts)
      inner[near.find(static_cast<std::size_t>(edge(e).from))].push_back(e);
    for (const auto& [name, edges] : inner) {
      if (edges.size() < 2) continue;
      std::optional<Knot> knot = untie(graph_, edges);
      if (!knot) continue;
      for (const int e : edges) {
        bridge_[static_cast<std::size_t>(e)] = true;
        merge(edge(e).from, edge(e).to);
      }
      knots_.push_back(std::move(*knot));
    }
  }

  void make_branches() {
    branches_.resize(2 * graph_.edges.size());
    std::vector<double> radius(graph_.nodes.size(), 0);
    shared_.assign(graph_.nodes.size(), 0);
    for (std::size_t e = 0; e < graph_.edges.size(); ++e) {
      if (!bridge_[e]) continue;  // a ring has no nodes
      const double wide =
          std::max(node(graph_.edges[e].from).radius, node(graph_.edges[e].to).radius);
      if (length_of(graph_.edges[e]) <= kShortShared * wide) continue;
      double& longest = shared_[static_cast<std::size_t>(root(graph_.edges[e].from))];
      longest = std::max(longest, length_of(graph_.edges[e]));
    }
    for (std::size_t n = 0; n < graph_.nodes.size(); ++n) {
      double& r = radius[static_cast<std::size_t>(root(static_cast<int>(n)))];
      r = std::max(r, graph_.nodes[n].radius);
    }
    for (std::size_t e = 0; e < graph_.edges.size(); ++e) {
      const GraphEdge& line = graph_.edges[e];
      if (!line.alive || line.from < 0 || bridge_[e] || line.points.size() < 2) continue;
      for (const bool end : {false, true}) {
        const int n = end ? line.to : line.from;
        const bool junction = is_junction(n);
        const int cluster = root(n);
        const double r = radius[static_cast<std::size_t>(cluster)];
        const int id = branch_of(static_cast<int>(e), end);
        const double end_skip = std::max(0.7 * r, hook_of(line, end));
        at(id) = sketch::make_branch(graph_, static_cast<int>(e), end,
                                     junction ? 1.2 * r + 1 : end_skip);
        at(id).free = node(n).edges.size() == 1;
        members_[static_cast<std::size_t>(cluster)].push_back(id);
      }
    }
  }

  /// Of two lines that share a long stretch the directions beside it tell little: those go on with
  /// each other that lie on one arc, far out.
  bool match_far_out(const std::vector<int>& list, double shared) {
    std::array<std::array<double, 4>, 4> off{};
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t b = 0; b < a; ++b)
        off[a][b] = off[b][a] = going_on(graph_, at(list[a]), at(list[b]), arc_reach(shared, 0));
    std::size_t best = 1;
    for (const std::size_t mate : {2, 3}) {
      const auto sum = [&](std::size_t m) {
        return off[0][m] + off[m == 1 ? 2 : 1][m == 3 ? 2 : 3];
      };
      if (sum(mate) < sum(best)) best = mate;
    }
    const std::array<std::size_t, 2> rest = {best == 1 ? 2U : 1U, best == 3 ? 2U : 3U};
    for (const auto& [a, b] : {std::pair{std::size_t{0}, best}, std::pair{rest[0], rest[1]}}) {
      if (bend_between(at(list[a]), at(list[b])) > options_.turn) return false;
      at(list[a]).mate = list[b];
      at(list[b]).mate = list[a];
    }
    return true;
  }

  /// The knot that a cluster's branches come out of: the largest, which was found last.
  const Knot* knot_of(const std::vector<int>& list) {
    if (list.empty() || at(list[0]).free) return nullptr;
    const GraphEdge& line = edge(at(list[0]).edge);
    const int cluster = root(at(list[0]).at_end ? line.to : line.from);
    for (auto k = knots_.rbegin(); k != knots_.rend(); ++k)
      if (root(edge(k->edges.front()).from) == cluster) return &*k;
    return nullptr;
  }

  void match_knot(const Knot& knot, const std::vector<int>& list) {
    for (std::size_t i = 0; i < knot.exits.size(); ++i) {
      const Branch& out = knot.exits[i];
      const int id = branch_of(out.edge, out.at_end);
      if (std::find(list.begin(), list.end(), id) == list.end()) continue;
      at(id) = out;
      if (knot.mates[i] < 0) continue;
      const Branch& mate = knot.exits[static_cast<std::size_t>(knot.mates[i])];
      at(id).mate = branch_of(mate.edge, mate.at_end);
    }
  }

  /// Of two lines that run into one at a small angle, one goes on, the other ends there, or a
  /// little beyond: the one goes on that leads to the short end that follows.
  bool match_fork(const std::vector<int>& list) {
    for (const std::size_t k : {0U, 1U, 2U}) {
      const int stem = list[k];
      const int a = list[(k + 1) % 3];
      const int b = list[(k + 2) % 3];
      if (std::abs(core::angle_between(at(a).outward, at(b).outward)) > kFork) continue;
      if (!is_short_end(graph_, at(stem))) return false;
      if (bend_between(at(stem), at(a)) > options_.turn) return false;
      if (bend_between(at(stem), at(b)) > options_.turn) return false;
      const Point2 place = arm_of(graph_, at(stem), kForkReach).back();
      const int mate =
          passes_beside(graph_, at(a), place) <= passes_beside(graph_, at(b), place) ? a : b;
      at(stem).mate = mate;
      at(mate).mate = stem;
      return true;
    }
    return false;
  }

  /// Short ends and the lines that lead to them go on with each other; they leave the list.
  void match_leading(std::vector<int>& list) {
    const std::vector<int> all = list;
    for (const int end : all) {
      const int arm = leading_arm(graph_, at(end).edge);
      const auto mate = std::ranges::find_if(list, [&](int b) { return at(b).edge == arm; });
      if (arm < 0 || mate == list.end() || std::ranges::find(list, end) == list.end()) continue;
      at(end).mate = *mate;
      at(*mate).mate = end;
      std::erase_if(list, [&](int b) { return b == end || b == at(end).mate; });
    }
  }

  void match(std::vector<int> list, double shared) {
    if (list.size() == 2) {  // no junction at all
      at(list[0]).mate = list[1];
      at(list[1]).mate = list[0];
      return;
    }
    if (const Knot* knot = knot_of(list)) return match_knot(*knot, list);
    if (list.size() >= 4) match_leading(list);
    if (list.size() == 4 && shared > 0 && match_far_out(list, shared)) return;
    if (list.size() == 3 && match_fork(list)) return;
    std::vector<Branch> branches;
    for (const int id : list) branches.push_back(at(id));
    const std::vector<int> mates = pair_up(branches, options_.turn);
    for (std::size_t k = 0; k < list.size(); ++k)
      if (mates[k] >= 0) at(list[k]).mate = list[static_cast<std::size_t>(mates[k])];
  }

  static RawStroke whole(const GraphEdge& line, bool closed) {
    RawStroke s{line.points, line.radii, std::vector<std::uint8_t>(line.points.size(), 1),
                closed,      false,      false};
    return s;
  }

  void add_point(RawStroke& s, Point2 p, float r, bool sure) {
    s.points.push_back(p);
    s.radii.push_back(r);
    s.sure.push_back(sure ? 1 : 0);
  }

  /// Guessed points between p and q, both left out.
  void add_guess(RawStroke& s, Point2 p, Point2 q, float r) {
    const int steps = static_cast<int>(std::lround(distance(p, q)));
    for (int k = 1; k < steps; ++k)
      add_point(s, core::mix(p, q, k / static_cast<double>(steps)), r, false);
  }

  /// From the unmatched end of a stroke into its line: up to the node along the branch's direction.
  void add_dead_end(RawStroke& s, const Branch& b, bool before) {
    if (b.free) return;
    const GraphEdge& line = edge(b.edge);
    const Point2 foot = b.at_end ? line.points.back() : line.points.front();
    const double reach = b.tail > 0 ? b.tail : std::max(0.0, core::dot(b.place - foot, b.outward));
    const Point2 end = b.place - reach * b.outward;
    const float r = line.radii[b.anchor];
    if (before) {
      add_point(s, end, r, false);
      add_guess(s, end, b.place, r);
    } else {
      add_guess(s, b.place, end, r);
      add_point(s, end, r, false);
    }
  }

  void add_edge_points(RawStroke& s, const Branch& in, const Branch& out) {
    const GraphEdge& line = edge(in.edge);
    const auto n = static_cast<long>(line.points.size());
    // a free end keeps all its points
    const long first =
        in.free && in.mate < 0 ? (in.at_end ? n - 1 : 0) : static_cast<long>(in.anchor);
    const long last =
        out.free && out.mate < 0 ? (out.at_end ? n - 1 : 0) : static_cast<long>(out.anchor);
    const long step = in.at_end ? -1 : 1;
    // beside the last dot of a row nothing tells its direction: it stays where it is
    const bool sure = n > 1 || (in.mate >= 0 && out.mate >= 0);
    for (long i = first; step > 0 ? i <= last : i >= last; i += step)
      add_point(s, line.points[static_cast<std::size_t>(i)],
                line.radii[static_cast<std::size_t>(i)], sure);
  }

  RawStroke walk(int start, std::vector<bool>& used) {
    RawStroke s;
    int in = start;
    s.free_start = at(start).free && at(start).mate < 0;
    if (at(start).mate < 0) add_dead_end(s, at(start), true);
    while (true) {
      const Branch& entry = at(in);
      used[static_cast<std::size_t>(entry.edge)] = true;
      const int out = branch_of(entry.edge, !entry.at_end);
      add_edge_points(s, entry, at(out));
      const int next = at(out).mate;
      if (next < 0) {
        add_dead_end(s, at(out), false);
        s.free_end = at(out).free;
        return s;
      }
      const float r = edge(entry.edge).radii[at(out).anchor];
      if (at(out).way.empty()) add_guess(s, at(out).place, at(next).place, r);
      for (const Point2 p : at(out).way) {
        add_point(s, p, r, true);
        s.sure.back() = 2;
      }
      if (used[static_cast<std::size_t>(at(next).edge)]) {
        s.closed = true;
        return s;
      }
      in = next;
    }
  }

  StrokeGraph graph_;
  JoinOptions options_;
  core::DisjointSets clusters_;
  std::vector<bool> bridge_;
  std::vector<std::vector<int>> members_;
  std::vector<Knot> knots_;
  std::vector<double> shared_;  ///< longest stretch two lines share, by cluster; 0: short
  std::vector<Branch> branches_;
};

}  // namespace

std::vector<RawStroke> join_strokes(StrokeGraph graph, const JoinOptions& options) {
  return Joiner(std::move(graph), options).strokes();
}

}  // namespace keyline::sketch
