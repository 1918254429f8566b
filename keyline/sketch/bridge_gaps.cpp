#include "keyline/sketch/bridge_gaps.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "keyline/core/angle.h"
#include "keyline/core/quantile.h"
#include "keyline/sketch/dash_row.h"

namespace keyline::sketch {
namespace {

using core::Point2;
using core::Vector2;

constexpr double kStraightest = 0.8;  ///< of the turn at a junction a line may make over a gap
/// Widths of the line: nor is a gap longer than this. The longest that drawings have are 18 widths
/// ([ISO 128-20], spaced dashes); half as much again as gaps of a row may differ.
constexpr double kWidestGap = 18 * kEven;
/// Gaps: a dash between two gaps is no longer. The longest that drawings have are eight times as
/// long as their gaps ([ISO 128-20], long dashes); half as much again as gaps of a row may differ.
constexpr double kLongDash = 8 * kEven;
constexpr double kDot = 3;  ///< pixels: what is shorter has no direction

/// Of a line's ink.
struct Box {
  Point2 low{HUGE_VAL, HUGE_VAL};
  Point2 high{-HUGE_VAL, -HUGE_VAL};

  bool meets(Point2 p, Point2 q) const {
    return std::max(p.x, q.x) >= low.x && std::min(p.x, q.x) <= high.x &&
           std::max(p.y, q.y) >= low.y && std::min(p.y, q.y) <= high.y;
  }
};

Box box_of(const GraphEdge& line) {
  Box box;
  for (std::size_t i = 0; i < line.points.size(); ++i) {
    const double r = line.radii[i] + 0.5;
    box.low = {std::min(box.low.x, line.points[i].x - r),
               std::min(box.low.y, line.points[i].y - r)};
    box.high = {std::max(box.high.x, line.points[i].x + r),
                std::max(box.high.y, line.points[i].y + r)};
  }
  return box;
}

class Bridges {
 public:
  Bridges(const StrokeGraph& graph, double gap, double turn, std::vector<Branch>& branches)
      : graph_(graph), most_(gap), turn_(turn), branches_(branches), over_(branches.size(), 0) {
    for (std::size_t i = 0; i < branches.size(); ++i)
      if (branches[i].edge >= 0 && branches[i].mate < 0) ends_.push_back(static_cast<int>(i));
    std::sort(ends_.begin(), ends_.end(),
              [&](int a, int b) { return end_of(a).at.x < end_of(b).at.x; });
    for (const int end : ends_) largest_ = std::max(largest_, end_of(end).radius);
    if (ends_.empty()) return;
    for (const GraphEdge& line : graph_.edges) {
      boxes_.push_back(box_of(line));
      for (const float radius : line.radii) broadest_ = std::max<double>(broadest_, radius + 0.5);
    }
  }

  /// Nearest and straightest pairs first. What lies under other ink is not seen, so it is no gap:
  /// a line that stops short of a broad or darker one goes on behind it. One that touches another
  /// line on this side and comes out of it after a gap has to go on as straight as dashes do.
  void bridge_short() {
    std::vector<Pair> pairs;
    visit_pairs(most_ + 2 * broadest_, [&](int a, int b, double gap) {
      if (gap > most_ + 2 * broadest_ || !long_enough(a, b, gap)) return;
      if (!at(a).free && !at(b).free) return;
      const double turn = bend_between(at(a), at(b));
      if (turn >= (at(a).free && at(b).free ? kStraightest * turn_ : kRowTurn)) return;
      const double paper = gap > most_ ? gap - ink_between(a, b) : gap;
      if (paper <= most_) pairs.push_back({gap / most_ + turn, gap, a, b});
    });
    std::ranges::sort(pairs, {}, &Pair::cost);
    for (const Pair& p : pairs)
      if (at(p.a).mate < 0 && at(p.b).mate < 0) join(p.a, p.b, p.gap);
  }

  /// Dashes: ends each of which is the other's nearest ahead, over gaps as long as the next ones.
  /// What shows a row is paper: over other ink it goes on only where it does so on both sides.
  void bridge_rows() {
    std::erase_if(ends_, [&](int end) { return at(end).mate >= 0 || !at(end).free; });
    if (ends_.empty()) return;
    find_nearest();
    find_paper();
    std::vector<Pair> rows;
    for (const int a : ends_) {
      const Pair p = nearest_[index(a)];
      if (p.b < a || !is_mutual(a)) continue;
      const bool one = goes_on(a, p.gap);
      const bool other = goes_on(p.b, p.gap);
      if (paper_[index(a)] ? one || other : one && other) rows.push_back({p.cost, p.gap, a, p.b});
    }
    for (const Pair& p : rows) join(p.a, p.b, p.gap);
  }

 private:
  struct Pair {
    double cost = HUGE_VAL;
    double gap = 0;
    int a = -1;
    int b = -1;
  };

  static std::size_t index(int i) { return static_cast<std::size_t>(i); }
  Branch& at(int b) { return branches_[index(b)]; }
  const GraphEdge& edge_of(int b) const { return graph_.edges[index(b / 2)]; }

  LineEnd end_of(int b) const { return line_end(graph_, branches_[index(b)]); }

  /// Calls see(a, b, gap) for ends not much farther apart than `most`.
  template <class See>
  void visit_pairs(double most, const See& see) {
    for (std::size_t i = 0; i < ends_.size(); ++i)
      for (std::size_t j = i + 1; j < ends_.size(); ++j) {
        const Vector2 d = end_of(ends_[j]).at - end_of(ends_[i]).at;
        if (d.x > most + 2 * largest_) break;
        see(ends_[i], ends_[j], core::norm(d) - end_of(ends_[i]).radius - end_of(ends_[j]).radius);
      }
  }

  void join(int a, int b, double gap) {
    at(a).mate = b;
    at(b).mate = a;
    over_[index(a)] = over_[index(b)] = gap;
  }

  /// A closed loop is made of a line longer than its gap only; two ends of a dash make no loop.
  bool long_enough(int a, int b, double gap) {
    const double least = std::min(length_of(edge_of(a)), length_of(edge_of(b)));
    return a / 2 == b / 2 ? least > 4 * gap : least > 0.5 * gap;
  }

  double width(int b) const { return 2 * core::quantile(edge_of(b).radii); }

  /// Of the ink, along the line that ends there.
  double dash(int b) const { return length_of(edge_of(b)) + width(b); }

  /// As bend_between of branches; of the turn from one middle to the other the gap has its share.
  static double row_bend(const Way& a, const Way& b, double gap) {
    const Vector2 chord = b.middle - a.middle;
    const double first = core::angle_between(a.outward, chord);
    const double second = core::angle_between(chord, -b.outward);
    return 0.5 * std::abs(first + second) * gap / core::norm(chord) + std::abs(first - second);
  }

  void find_nearest() {
    nearest_.assign(branches_.size(), {});
    std::vector<double> reach(branches_.size(), 0);
    std::vector<Way> ways(branches_.size());
    for (const int end : ends_) {
      reach[index(end)] = std::min(kRowGap * dash(end), kWidestGap * width(end));
      ways[index(end)] = way_of(graph_, at(end));
    }
    visit_pairs(std::ranges::max(reach), [&](int a, int b, double gap) {
      if (a / 2 == b / 2 || gap > std::min(reach[index(a)], reach[index(b)])) return;
      const double first = length_of(edge_of(a));
      const double second = length_of(edge_of(b));
      if (std::min(first, second) < kDot) return;
      const double unsure = kGrid / first + kGrid / second;
      const double turn = row_bend(ways[index(a)], ways[index(b)], gap);
      if (turn > kRowTurn + unsure) return;
      const Pair pair{gap / std::min(dash(a), dash(b)) + turn, gap, a, b};
      if (pair.cost < nearest_[index(a)].cost) nearest_[index(a)] = pair;
      if (pair.cost < nearest_[index(b)].cost) nearest_[index(b)] = {pair.cost, gap, b, a};
    });
  }

  bool is_mutual(int end) const {
    const int other = nearest_[index(end)].b;
    return other >= 0 && nearest_[index(other)].b == end;
  }

  /// Tells the gaps that show paper from those that have ink of other lines in them.
  void find_paper() {
    paper_.assign(branches_.size(), false);
    for (const int a : ends_)
      if (is_mutual(a) && nearest_[index(a)].b > a)
        paper_[index(a)] = paper_[index(nearest_[index(a)].b)] =
            ink_between(a, nearest_[index(a)].b) == 0;
  }

  /// How much of the gap between two ends other lines' ink covers.
  double ink_between(int a, int b) {
    const Point2 from = end_of(a).at;
    const Vector2 across = end_of(b).at - from;
    const double length = core::norm(across);
    const Vector2 along = across / length;
    const double first = end_of(a).radius;
    const double last = length - end_of(b).radius;
    std::vector<std::pair<double, double>> covered;
    for (std::size_t e = 0; e < graph_.edges.size(); ++e) {
      const GraphEdge& line = graph_.edges[e];
      if (!line.alive || e == index(a / 2) || e == index(b / 2)) continue;
      if (!boxes_[e].meets(from, from + across)) continue;
      for (std::size_t i = 0; i < line.points.size(); ++i) {
        const Vector2 to = line.points[i] - from;
        const double way = core::dot(to, along);
        const double off = std::abs(core::cross(to, along));
        const double radius = line.radii[i] + 0.5;
        if (way <= first || way >= last || off >= radius) continue;
        const double half = std::sqrt(radius * radius - off * off);
        covered.emplace_back(std::max(first, way - half), std::min(last, way + half));
      }
    }
    std::ranges::sort(covered);
    double ink = 0;
    double end = first;
    for (const auto& [low, high] : covered) {
      ink += std::max(0.0, high - std::max(low, end));
      end = std::max(end, high);
    }
    return ink;
  }

  /// Whether the line that ends there has, or comes to at its other end, a gap as long that shows
  /// paper, and is no longer than a dash between two such gaps. It may come to it over gaps that do
  /// not.
  bool goes_on(int end, double gap) {
    const auto even = [gap](double other) { return other > 0 && is_even(gap, other); };
    int out = end ^ 1;
    double way = dash(end);
    for (std::size_t steps = 0; way <= kLongDash * gap && steps < branches_.size(); ++steps) {
      int mate = at(out).mate;
      if (mate >= 0) {
        if (even(over_[index(out)])) return true;
        way += over_[index(out)] + length_of(edge_of(mate));
      } else {
        if (!is_mutual(out) || !even(nearest_[index(out)].gap)) return false;
        if (paper_[index(out)]) return true;
        mate = nearest_[index(out)].b;
        way = dash(mate);
      }
      out = mate ^ 1;
      if (out == end) return false;
    }
    return false;
  }

  const StrokeGraph& graph_;
  double most_;
  double turn_;
  std::vector<Branch>& branches_;
  std::vector<double> over_;   ///< the gap that was bridged, by branch
  std::vector<int> ends_;      ///< those without a mate, from left to right
  double largest_ = 0;         ///< radius of an end
  double broadest_ = 0;        ///< radius of any ink
  std::vector<Pair> nearest_;  ///< by branch
  std::vector<bool> paper_;    ///< by branch: its nearest lies across paper
  std::vector<Box> boxes_;     ///< of the edges' ink
};

}  // namespace

void bridge_gaps(const StrokeGraph& graph, const JoinOptions& options,
                 std::vector<Branch>& branches) {
  Bridges bridges(graph, options.gap, options.turn, branches);
  bridges.bridge_short();
  if (options.rows) bridges.bridge_rows();
}

}  // namespace keyline::sketch
