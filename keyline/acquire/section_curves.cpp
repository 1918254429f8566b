#include "keyline/acquire/section_curves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "keyline/acquire/kd_tree.h"
#include "keyline/acquire/order.h"
#include "keyline/acquire/spanning_tree.h"
#include "keyline/acquire/statistics.h"
#include "keyline/core/disjoint_sets.h"
#include "keyline/core/polygon.h"
#include "keyline/core/quantile.h"
#include "keyline/core/second_moments.h"
#include "keyline/core/text.h"

namespace keyline::acquire {
namespace {

using Indices = std::vector<std::size_t>;

constexpr std::size_t kLeastPoints = 24;    // a section of fewer is not taken apart
constexpr std::size_t kMostPoints = 50000;  // nor one of more
constexpr std::size_t kLeastPart = 8;       // points of a curve worth telling
constexpr double kWide = 0.4;               // width over length of a neighbourhood that is no line
constexpr double kStray = 2;                // what is wider than so many scatters is no line
constexpr std::size_t kFewNear = 9;         // neighbours among which a line is looked for at first…
constexpr std::size_t kMostNear = 72;       // …and at last
constexpr int kPasses = 4;                  // a hundredth is left of what points stray
constexpr double kThick = 0.85;             // share of such points in a thick band
constexpr double kGap = 14;                 // gap between parts, in usual steps…
constexpr double kGapOfExtent = 0.08;       // …and in the section's size
constexpr double kAcross = 0.5;             // along over length of a step that leads aside
constexpr double kBefore = 0.9;             // of it: how far on a line is looked for
constexpr double kPast =
    3;  // a line runs past where it has no more than so many times fewer points
constexpr double kAside = 4;  // what is no part of a line lies so many steps and scatters off it
constexpr std::array<std::size_t, 2> kWindows{9, 15};  // consecutive points looked at for zigzag
constexpr double kZigzag = 1.9;  // their way over its chord: half a circle has 1.57
constexpr double kZigzagStray =
    3;  // and their width over the scatter: nine of them show up to twice it…
constexpr double kZigzagWide = 0.3;  // and their width over their length: a hairpin is thin

std::vector<core::Point2> picked(const std::vector<core::Point2>& points, const Indices& which) {
  std::vector<core::Point2> some;
  for (const std::size_t i : which) some.push_back(points[i]);
  return some;
}

/// Scatter of some points: its middle, direction, and standard deviations along and across.
struct Spread {
  core::Point2 middle;
  core::Vector2 direction;
  double along = 0;
  double across = 0;
};

Spread spread_of(const std::vector<core::Point2>& points, std::span<const std::size_t> near) {
  core::Vector2 mean;
  for (const std::size_t i : near) mean = mean + (points[i] - points[near[0]]);
  mean = mean / static_cast<double>(near.size());
  core::SecondMoments moments;
  for (const std::size_t i : near) moments.add(points[i] - points[near[0]] - mean);
  const auto count = static_cast<double>(near.size());
  return {points[near[0]] + mean, moments.direction(), std::sqrt(moments.along() / count),
          std::sqrt(moments.across() / count)};
}

/// Width over length of the points' scatter; 1 for a round one.
double roundness(const std::vector<core::Point2>& points, std::span<const std::size_t> near) {
  const Spread spread = spread_of(points, near);
  return spread.along > 0 ? spread.across / spread.along : 1;
}

/// True where most of the nine nearest agree: one alone is a corner or a step.
std::vector<bool> agreed(const detail::KdTree& tree, const std::vector<core::Point2>& points,
                         const std::vector<bool>& wide) {
  std::vector<bool> most(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto near = tree.nearest(points[i], 9, points.size());
    const auto agree =
        std::count_if(near.begin(), near.end(), [&](std::size_t k) { return wide[k]; });
    most[i] = agree >= 5;
  }
  return most;
}

/// The fewest neighbours of a point that lie along a line, as their scatter; empty where none of so
/// many do.
struct Line {
  Spread spread;
  std::size_t count = 0;
};

std::optional<Line> line_at(const std::vector<core::Point2>& points, const detail::KdTree& tree,
                            core::Point2 p) {
  for (std::size_t count = kFewNear; count <= kMostNear; count *= 2) {
    const Spread spread = spread_of(points, tree.nearest(p, count, points.size()));
    if (spread.across <= kWide * spread.along) return Line{spread, count};
  }
  return std::nullopt;
}

/// How far points stray from their lines: in the middle of all points that have one.
double scatter_of(const std::vector<core::Point2>& points, const detail::KdTree& tree) {
  std::vector<double> scatter;
  for (const core::Point2 p : points)
    if (const auto line = line_at(points, tree, p)) scatter.push_back(line->spread.across);
  return scatter.empty() ? 0 : core::quantile(scatter);
}

/// Points that stray more than they step moved to the middle of their line, again until their
/// nearest lie along it: only so is it told which of them follow one another. Not where they stray
/// more than elsewhere, which is no line.
std::vector<core::Point2> centred(std::vector<core::Point2> points, double scatter) {
  for (int pass = 0; pass < kPasses; ++pass) {
    const detail::KdTree tree(points);
    std::vector<core::Point2> moved = points;
    for (core::Point2& p : moved) {
      const auto line = line_at(points, tree, p);
      if (!line || line->count == kFewNear) continue;
      const Spread& s = line->spread;
      if (s.across > kZigzagStray * scatter) continue;
      p = s.middle + core::dot(p - s.middle, s.direction) * s.direction;
    }
    if (moved == points) break;
    points = std::move(moved);
  }
  return points;
}

/// How wide the points lie about each of them.
struct Widths {
  std::vector<bool> wide;  ///< its nearest lie nearly as wide as long, few and more of them…
  std::vector<bool> area;  ///< …and wider than points stray from lines: they fill an area
  double scatter = 0;      ///< how far points stray from lines
};

/// A line whose points lie as close together as they stray from it is wide among the nearest few
/// by chance, here and there.
Widths widths_of(const std::vector<core::Point2>& points) {
  const detail::KdTree tree(points);
  Widths widths{std::vector<bool>(points.size()), std::vector<bool>(points.size()),
                scatter_of(points, tree)};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto near = tree.nearest(points[i], 16, points.size());
    const std::span<const std::size_t> nine(near.data(), std::min<std::size_t>(9, near.size()));
    widths.wide[i] = roundness(points, nine) > kWide && roundness(points, near) > kWide;
    widths.area[i] = widths.wide[i] && spread_of(points, near).across > kStray * widths.scatter;
  }
  widths.wide = agreed(tree, points, widths.wide);
  widths.area = agreed(tree, points, widths.area);
  return widths;
}

/// Whether a step between two points leads aside from a line that runs on past the first of them,
/// both ways.
bool leads_aside(const std::vector<core::Point2>& points, const detail::KdTree& tree,
                 std::size_t from, std::size_t to) {
  const auto line = line_at(points, tree, points[from]);
  if (!line) return false;
  const core::Vector2 along = line->spread.direction;
  const core::Vector2 step = points[to] - points[from];
  const double length = core::norm(step);
  if (std::abs(core::dot(along, step)) > kAcross * length) return false;
  std::size_t ahead = 0, behind = 0;
  for (const std::size_t k : tree.within(points[from], kBefore * length)) {
    const double x = core::dot(along, points[k] - points[from]);
    ahead += x > 0 ? 1 : 0;
    behind += x < 0 ? 1 : 0;
  }
  return kPast * static_cast<double>(std::min(ahead, behind)) >=
         static_cast<double>(std::max({ahead, behind, std::size_t{1}}));
}

/// What links points into one line.
struct Links {
  double gap = 0;   ///< steps of at most this…
  double step = 0;  ///< …above this not between lines that run on beside each other
};

/// Groups of points linked by such steps, in the order of their first point. A line goes on over a
/// gap at its end; what lies as near beside it is another line.
std::vector<Indices> groups_of(const std::vector<core::Point2>& points, const Indices& which,
                               const Links& links) {
  const auto some = picked(points, which);
  if (some.size() < 2) return {which};
  core::DisjointSets sets(some.size());
  const detail::KdTree nearby(some);
  const auto beside = [&](std::size_t a, std::size_t b) {
    return leads_aside(some, nearby, a, b) && leads_aside(some, nearby, b, a);
  };
  for (const auto& edge : detail::spanning_tree(some, detail::neighbour_lists(some), true)) {
    if (edge.length > links.gap) continue;
    if (edge.length <= links.step || !beside(edge.a, edge.b)) sets.join(edge.a, edge.b);
  }
  std::vector<Indices> groups;
  std::vector<std::size_t> group_of(some.size(), some.size());
  for (std::size_t k = 0; k < some.size(); ++k) {
    std::size_t& group = group_of[sets.find(k)];
    if (group == some.size()) {
      group = groups.size();
      groups.emplace_back();
    }
    groups[group].push_back(which[k]);
  }
  return groups;
}

/// Distance of p from the polygon through some points.
double distance_to_line(core::Point2 p, const std::vector<core::Point2>& line) {
  double least = core::distance(p, line.front());
  for (std::size_t k = 1; k < line.size(); ++k) {
    const core::Vector2 step = line[k] - line[k - 1];
    const double square = core::dot(step, step);
    const double t =
        square > 0 ? std::clamp(core::dot(p - line[k - 1], step) / square, 0.0, 1.0) : 0;
    least = std::min(least, core::distance(p, line[k - 1] + t * step));
  }
  return least;
}

/// One connected part taken apart into its stem and what branches off.
struct Parted {
  Indices stem;
  Indices aside;
};

Parted take_stem(const std::vector<core::Point2>& points, const Indices& group, double aside) {
  const auto some = picked(points, group);
  const auto tree = detail::spanning_tree(some, detail::neighbour_lists(some), true);
  std::vector<core::Point2> line;
  for (const std::size_t k : detail::longest_path(some.size(), tree)) line.push_back(some[k]);
  Parted parted;
  for (std::size_t k = 0; k < some.size(); ++k)
    (distance_to_line(some[k], line) > aside ? parted.aside : parted.stem).push_back(group[k]);
  return parted;
}

/// Whether consecutive points go to and fro over more than they stray from their line.
bool is_zigzag(const std::vector<core::Point2>& line, const Indices& window, double scatter) {
  const double way = core::polygon_length(picked(line, window), false);
  const double chord = core::distance(line[window.front()], line[window.back()]);
  return way >= kZigzag * chord && roundness(line, window) >= kZigzagWide &&
         spread_of(line, window).across > kZigzagStray * scatter;
}

/// Which points of an ordered curve belong to a zigzag.
std::vector<bool> zigzags(const std::vector<core::Point2>& line, double scatter) {
  std::vector<bool> flagged(line.size());
  for (const std::size_t size : kWindows) {
    Indices window(size);
    for (std::size_t k = 0; k + size <= line.size(); ++k) {
      std::iota(window.begin(), window.end(), k);
      if (!is_zigzag(line, window, scatter)) continue;
      for (const std::size_t i : window) flagged[i] = true;
    }
  }
  return flagged;
}

RawCurve part_of(const RawCurve& section, const Indices& which) {
  RawCurve part;
  part.has_z = section.has_z;
  part.scattered = section.scattered;
  for (const std::size_t i : which) {
    part.points.push_back(section.points[i]);
    if (!section.weights.empty()) part.weights.push_back(section.weights[i]);
    if (!section.source_lines.empty()) part.source_lines.push_back(section.source_lines[i]);
  }
  return part;
}

/// The section's points sorted into curves.
class Sorter {
 public:
  explicit Sorter(std::vector<core::Point2> points) : points_(std::move(points)) {}

  void run() {
    Indices all(points_.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    const Widths widths = widths_of(points_);
    // Where nearly all points lie wide the section is a thick band: its middle is found later.
    thick_ = std::count(widths.wide.begin(), widths.wide.end(), true) >
             static_cast<long>(kThick * static_cast<double>(points_.size()));
    Indices lines;
    for (const std::size_t i : all) (widths.area[i] && !thick_ ? left_ : lines).push_back(i);
    std::vector<double> steps;
    const auto some = centred(picked(points_, lines), widths.scatter);
    for (std::size_t k = 0; k < lines.size(); ++k) points_[lines[k]] = some[k];
    scatter_ = widths.scatter;
    for (const auto& edge : detail::spanning_tree(some, detail::neighbour_lists(some), true))
      steps.push_back(edge.length);
    const double usual = core::quantile(steps);
    aside_ = kAside * std::max(usual, scatter_);
    gap_ = std::max(kGap * usual, kGapOfExtent * detail::extent_of(some));
    sort(lines);
    std::stable_sort(curves_.begin(), curves_.end(),
                     [](const auto& a, const auto& b) { return a.second > b.second; });
  }

  std::size_t left() const { return left_.size(); }
  const std::vector<std::pair<Indices, double>>& curves() const { return curves_; }

 private:
  void sort(const Indices& which) {
    for (const Indices& group : groups_of(points_, which, {gap_, aside_})) {
      if (group.size() < kLeastPart) {
        leave(group);
      } else if (thick_) {
        curves_.emplace_back(group, detail::extent_of(picked(points_, group)));
      } else {
        const Parted parted = take_stem(points_, group, aside_);
        add(parted.stem);
        if (!parted.aside.empty()) sort(parted.aside);
      }
    }
  }

  void leave(const Indices& which) { left_.insert(left_.end(), which.begin(), which.end()); }

  void add(const Indices& stem) {
    const Ordering ordering = order_points(picked(points_, stem));
    for (const std::size_t k : ordering.dropped) left_.push_back(stem[k]);
    Indices along;
    for (const std::size_t k : ordering.order) along.push_back(stem[k]);
    const std::vector<bool> zigzag = zigzags(picked(points_, along), scatter_);
    Indices stretch;
    for (std::size_t k = 0; k < along.size(); ++k) {
      if (!zigzag[k]) {
        stretch.push_back(along[k]);
        continue;
      }
      left_.push_back(along[k]);
      add_stretch(stretch);
    }
    add_stretch(stretch);
  }

  void add_stretch(Indices& stretch) {
    if (stretch.size() < kLeastPart)
      leave(stretch);
    else
      curves_.emplace_back(stretch, core::polygon_length(picked(points_, stretch), false));
    stretch.clear();
  }

  std::vector<core::Point2> points_;
  std::vector<std::pair<Indices, double>> curves_;
  Indices left_;
  bool thick_ = false;
  double scatter_ = 0;
  double aside_ = 0;
  double gap_ = 0;
};

}  // namespace

std::vector<RawCurve> section_curves(const RawCurve& section, const Plane& plane) {
  if (section.points.size() < kLeastPoints || section.points.size() > kMostPoints) return {section};
  std::vector<core::Point2> points;
  for (const core::Point3& p : section.points) points.push_back(to_plane(plane, p));
  Sorter sorter(std::move(points));
  sorter.run();
  const bool whole = sorter.curves().size() == 1 && sorter.left() * 20 <= section.points.size();
  if (sorter.curves().empty() || whole) return {section};
  std::vector<RawCurve> curves;
  for (const auto& [which, length] : sorter.curves()) {
    curves.push_back(part_of(section, which));
    curves.back().id = "section-" + std::to_string(curves.size());
  }
  curves.front().notes = section.notes;
  if (curves.size() > 1)
    curves.front().notes.push_back("the section consists of " + std::to_string(curves.size()) +
                                   " curves");
  if (sorter.left() > 0)
    curves.front().notes.push_back(core::counted(sorter.left(), "point") +
                                   " of the section on no curve, left out");
  return curves;
}

}  // namespace keyline::acquire
