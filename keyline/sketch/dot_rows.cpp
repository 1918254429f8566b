#include "keyline/sketch/dot_rows.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "keyline/core/angle.h"
#include "keyline/core/point.h"
#include "keyline/core/quantile.h"
#include "keyline/sketch/dash_row.h"

namespace keyline::sketch {
namespace {

using core::Point2;
using core::Vector2;

/// Sizes of a dot: no gap beside it is longer. Drawings have three widths of the line
/// ([ISO 128-20]); half as much again as gaps of a row may differ.
constexpr double kDotGap = 3 * kEven;
constexpr std::size_t kFewest = 5;  ///< dots that make a row by themselves
constexpr std::size_t kLooked = 8;  ///< neighbours among which a dot's two are looked for

/// A dot, or a free end of a line.
struct Place {
  Point2 at;               ///< the dot's middle, or where the line's middle ends
  double radius = 0;       ///< how far the ink goes on beyond that
  double half = 0;         ///< of the width, as it is along the line
  std::vector<int> parts;  ///< of a dot its edges, of a line's end its branch
  bool dot = false;
  Way way{};  ///< of a line's end
};

/// What lies beside a dot.
struct Next {
  std::size_t place = 0;
  double gap = 0;  ///< of paper
  double far = 0;  ///< from middle to middle, or to a line's end
  Vector2 to;      ///< unit
};

/// A new edge of one point between two free ends; its number.
int add_dot(Point2 at, double radius, StrokeGraph& graph) {
  const int node = static_cast<int>(graph.nodes.size());
  const int edge = static_cast<int>(graph.edges.size());
  for (int end = 0; end < 2; ++end) graph.nodes.push_back({at, radius, {edge}});
  graph.edges.push_back(
      {.from = node, .to = node + 1, .points = {at}, .radii = {static_cast<float>(radius)}});
  return edge;
}

class DotRows {
 public:
  DotRows(StrokeGraph& graph, std::vector<Branch>& branches) : graph_(graph), branches_(branches) {
    find_places();
    links_.resize(places_.size());
  }

  void join_rows() {
    choose_pairs();
    link_pairs();
    link_last_dots();
    std::vector<std::vector<std::size_t>> rows = chains();
    std::erase_if(rows, [&](const std::vector<std::size_t>& row) { return !is_row(row); });
    for (const std::vector<std::size_t>& row : rows) join(row);
  }

 private:
  struct Link {
    std::size_t place;
    double gap;
  };

  const Branch& branch(int i) const { return branches_[static_cast<std::size_t>(i)]; }

  void find_places() {
    std::vector<bool> of_dot(graph_.edges.size());
    for (const GraphDot& dot : graph_.dots) {
      places_.push_back({dot.at, dot.radius, dot.radius, dot.edges, true});
      for (const int e : dot.edges) of_dot[static_cast<std::size_t>(e)] = true;
    }
    for (std::size_t i = 0; i < branches_.size(); ++i) {
      const Branch& end = branches_[i];
      if (end.edge < 0 || !end.free || end.mate >= 0 || of_dot[i / 2]) continue;
      const GraphEdge& line = graph_.edges[i / 2];
      const LineEnd last = line_end(graph_, end);
      places_.push_back({last.at,
                         last.radius,
                         core::quantile(line.radii),
                         {static_cast<int>(i)},
                         false,
                         way_of(graph_, end)});
    }
    std::ranges::sort(places_, {}, [](const Place& p) { return p.at.x; });
  }

  /// Calls see(place) for all others not much farther from one than `reach`.
  template <class See>
  void visit_near(std::size_t i, double reach, const See& see) const {
    const double x = places_[i].at.x;
    const auto from =
        std::ranges::lower_bound(places_, x - reach, {}, [](const Place& p) { return p.at.x; });
    for (auto p = from; p != places_.end() && p->at.x <= x + reach; ++p) {
      const auto k = static_cast<std::size_t>(p - places_.begin());
      if (k != i && std::abs(p->at.y - places_[i].at.y) <= reach) see(k);
    }
  }

  /// What a row may go on with from a dot: dots as broad, and ends of lines as broad that lead to
  /// it; nearest first.
  std::vector<Next> near(std::size_t i) const {
    const Place& dot = places_[i];
    std::vector<Next> all;
    const double most = kDotGap * (2 * dot.radius + kGrid);
    visit_near(i, most + (2 + kEven) * dot.radius + 2 * kGrid, [&](std::size_t k) {
      const Place& other = places_[k];
      const Vector2 to = other.at - dot.at;
      const double far = core::norm(to);
      const double gap = far - dot.radius - other.radius;
      if (gap <= 0 || gap > most || !are_alike(i, k)) return;
      if (!other.dot && std::abs(core::angle_between(
                            other.way.outward, dot.at - other.way.middle)) > kRowTurn + unsure(far))
        return;
      all.push_back({k, gap, far, to / far});
    });
    std::ranges::sort(all, {}, &Next::gap);
    if (all.size() > kLooked) all.resize(kLooked);
    return all;
  }

  /// The middle of a dot is known to half a pixel.
  static double unsure(double far) { return 0.5 * kGrid / far; }

  /// Of each dot the nearest two on opposite sides, at even gaps.
  void choose_pairs() {
    pairs_.resize(places_.size());
    for (std::size_t i = 0; i < places_.size(); ++i) {
      if (!places_[i].dot) continue;
      const std::vector<Next> all = near(i);
      double least = HUGE_VAL;
      for (std::size_t a = 0; a < all.size(); ++a)
        for (std::size_t b = 0; b < a; ++b) {
          const double turn = std::abs(core::angle_between(-all[a].to, all[b].to));
          const double cost = (all[a].gap + all[b].gap) * (1 + turn);
          if (turn > kRowTurn + unsure(all[a].far) + unsure(all[b].far) || cost >= least ||
              !is_even(all[a].gap, all[b].gap))
            continue;
          least = cost;
          pairs_[i] = {all[a], all[b]};
        }
    }
  }

  bool has(std::size_t i, std::size_t other) const {
    return std::ranges::any_of(pairs_[i], [&](const Next& n) { return n.place == other; });
  }

  void link(std::size_t a, std::size_t b, double gap) {
    links_[a].push_back({b, gap});
    links_[b].push_back({a, gap});
  }

  bool has_room(std::size_t i) const { return links_[i].size() < (pairs_[i].empty() ? 1 : 2); }

  /// Two dots that have each other for a neighbour, and what has no pair of its own with the
  /// nearest that has it.
  void link_pairs() {
    struct Wish {
      double gap;
      std::size_t a, b;
    };
    std::vector<Wish> wishes;
    for (std::size_t i = 0; i < places_.size(); ++i)
      for (const Next& n : pairs_[i]) {
        if (pairs_[n.place].empty() || (n.place > i && has(n.place, i)))
          wishes.push_back({n.gap, i, n.place});
      }
    std::ranges::sort(wishes, {}, &Wish::gap);
    for (const Wish& w : wishes)
      if (has_room(w.a) && has_room(w.b)) link(w.a, w.b, w.gap);
  }

  /// The last dot of a chain line has an end of a dash beside it, and nothing else.
  void link_last_dots() {
    for (std::size_t i = 0; i < places_.size(); ++i) {
      if (!places_[i].dot || !links_[i].empty()) continue;
      for (const Next& n : near(i))
        if (!places_[n.place].dot && links_[n.place].empty()) {
          link(i, n.place, n.gap);
          break;
        }
    }
  }

  /// Places linked one after the other; of a closed row the first comes last again.
  std::vector<std::vector<std::size_t>> chains() const {
    std::vector<std::vector<std::size_t>> all;
    std::vector<bool> seen(places_.size());
    for (const bool closed : {false, true})
      for (std::size_t i = 0; i < places_.size(); ++i) {
        if (seen[i] || links_[i].size() != (closed ? 2 : 1)) continue;
        std::vector<std::size_t> row = {i};
        seen[i] = true;
        while (true) {
          const auto next = std::ranges::find_if(links_[row.back()],
                                                 [&](const Link& l) { return !seen[l.place]; });
          if (next == links_[row.back()].end()) break;
          seen[next->place] = true;
          row.push_back(next->place);
        }
        if (closed) row.push_back(i);
        all.push_back(std::move(row));
      }
    return all;
  }

  double gap_between(std::size_t a, std::size_t b) const {
    for (const Link& l : links_[a])
      if (l.place == b) return l.gap;
    return 0;
  }

  bool are_alike(std::size_t a, std::size_t b) const {
    return is_even(2 * places_[a].half, 2 * places_[b].half);
  }

  double pitch(std::size_t a, std::size_t b) const {
    return core::distance(places_[a].at, places_[b].at);
  }

  /// One of dots alone has enough of them, at an even pitch; one at a line's end another gap as
  /// long.
  bool is_row(const std::vector<std::size_t>& row) const {
    if (!stands_alone(row)) return false;
    const bool closed = row.front() == row.back();
    const bool from_line = !places_[row.front()].dot;
    const bool to_line = !places_[row.back()].dot;
    if (from_line || to_line)
      return row.size() > 2 ||
             goes_on(row[from_line ? 0 : 1], gap_between(row.front(), row.back()));
    double low = HUGE_VAL;
    double high = 0;
    for (std::size_t k = 0; k + 1 < row.size(); ++k) {
      low = std::min(low, pitch(row[k], row[k + 1]));
      high = std::max(high, pitch(row[k], row[k + 1]));
    }
    return row.size() >= kFewest + (closed ? 1 : 0) && high < kEven * low;
  }

  /// Whether most of its dots have no other half as far again as those beside them.
  bool stands_alone(const std::vector<std::size_t>& row) const {
    const auto dots = std::ranges::count_if(row, [&](std::size_t i) { return places_[i].dot; });
    const auto beset = std::ranges::count_if(
        row, [&](std::size_t i) { return places_[i].dot && has_other_near(i); });
    return 2 * beset < dots;
  }

  bool has_other_near(std::size_t i) const {
    double reach = 0;
    for (const Link& l : links_[i]) reach = std::max(reach, kEven * pitch(i, l.place));
    bool other = false;
    visit_near(i, reach, [&](std::size_t k) {
      const bool linked = std::ranges::find(links_[i], k, &Link::place) != links_[i].end();
      other = other || (places_[k].dot && !linked && pitch(i, k) < reach && are_alike(i, k));
    });
    return other;
  }

  /// Whether the line that ends at a place has a dot at its other end, over a gap as long.
  bool goes_on(std::size_t end, double gap) const {
    int out = places_[end].parts.front() ^ 1;
    for (std::size_t steps = 0; branch(out).mate >= 0 && steps < branches_.size(); ++steps)
      out = branch(out).mate ^ 1;
    const auto other = std::ranges::find_if(
        places_, [out](const Place& p) { return !p.dot && p.parts.front() == out; });
    if (other == places_.end()) return false;
    const auto k = static_cast<std::size_t>(other - places_.begin());
    return !links_[k].empty() && is_even(links_[k].front().gap, gap);
  }

  /// An edge of one point in place of what a dot was.
  void make_edge(Place& dot) {
    for (const int e : dot.parts) {
      graph_.edges[static_cast<std::size_t>(e)].alive = false;
      branches_[static_cast<std::size_t>(2 * e)].edge = -1;
      branches_[static_cast<std::size_t>(2 * e + 1)].edge = -1;
    }
    const int e = add_dot(dot.at, dot.radius, graph_);
    dot.parts = {e};
    for (const bool end : {false, true}) {
      branches_.push_back(make_branch(graph_, e, end, 0));
      branches_.back().free = true;
    }
  }

  void join(const std::vector<std::size_t>& row) {
    const bool closed = row.front() == row.back();
    for (std::size_t k = closed ? 1 : 0; k < row.size(); ++k)
      if (places_[row[k]].dot) make_edge(places_[row[k]]);
    for (std::size_t k = 0; k + 1 < row.size(); ++k) {
      const Place& a = places_[row[k]];
      const Place& b = places_[row[k + 1]];
      const int out = a.dot ? 2 * a.parts.front() + 1 : a.parts.front();
      const int in = b.dot ? 2 * b.parts.front() : b.parts.front();
      branches_[static_cast<std::size_t>(out)].mate = in;
      branches_[static_cast<std::size_t>(in)].mate = out;
    }
  }

  StrokeGraph& graph_;
  std::vector<Branch>& branches_;
  std::vector<Place> places_;             ///< from left to right
  std::vector<std::vector<Next>> pairs_;  ///< of dots: none or two
  std::vector<std::vector<Link>> links_;
};

}  // namespace

void join_rows_of_dots(StrokeGraph& graph, std::vector<Branch>& branches) {
  DotRows(graph, branches).join_rows();
}

}  // namespace keyline::sketch
