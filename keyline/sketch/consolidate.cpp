#include "keyline/sketch/consolidate.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "keyline/core/error.h"
#include "keyline/core/polygon.h"
#include "keyline/sketch/meant_line.h"
#include "keyline/sketch/stroke_grid.h"

namespace keyline::sketch {
namespace {

using core::distance;
using core::dot;
using core::Point2;
using core::Vector2;

constexpr double kUsualWidth =
    0.0055;  ///< of the geometric mean of a drawing's size and its strokes
constexpr double kMostOfUsual = 3;

/// How two strokes lie to each other: per stroke the part alongside the other, and whether that
/// part holds an end.
struct Overlap {
  double share_a = 0;
  double share_b = 0;
  bool end_a = false;
  bool end_b = false;
  double length = 0;  ///< of the part alongside, the shorter of both
};

class Grouping {
 public:
  Grouping(const std::vector<SampledStroke>& strokes, const ConsolidateOptions& options)
      : strokes_(strokes), options_(options), parent_(strokes.size()) {
    reach_ = options_.reach > 0 ? options_.reach : usual_reach();
    const double reach = 1.5 * reach_;
    const StrokeGrid grid(strokes_, reach);
    std::map<std::pair<std::size_t, std::size_t>, char> near;
    for (std::size_t i = 0; i < strokes_.size(); ++i)
      for (const Point2 p : strokes_[i].points)
        grid.visit(p, reach, [&](std::size_t j, std::size_t) {
          if (j > i) near[{i, j}] = 1;
        });
    for (const auto& [pair, unused] : near)
      if (belong(pair.first, pair.second)) pairs_.push_back(pair);
  }

  /// Those of the strokes that hang together, in order of their first.
  std::vector<std::vector<std::size_t>> groups(const std::vector<std::size_t>& of) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    std::vector<bool> in(strokes_.size(), false);
    for (const std::size_t i : of) in[i] = true;
    for (const auto& [a, b] : pairs_)
      if (in[a] && in[b]) parent_[root(a)] = root(b);
    std::vector<std::vector<std::size_t>> found;
    std::map<std::size_t, std::size_t> place;
    for (const std::size_t i : of) {
      const auto [at, fresh] = place.try_emplace(root(i), found.size());
      if (fresh) found.emplace_back();
      found[at->second].push_back(i);
    }
    return found;
  }

  double reach() const { return reach_; }

 private:
  std::size_t root(std::size_t i) const {
    while (parent_[i] != i) i = parent_[i];
    return i;
  }

  /// Three times the usual distance of a place on a stroke from the next stroke that runs along it.
  double usual_reach() const {
    const double most = 20 * options_.width;
    const StrokeGrid grid(strokes_, most);
    std::vector<double> nearest;
    for (std::size_t i = 0; i < strokes_.size(); ++i)
      for (std::size_t k = 0; k < strokes_[i].points.size(); k += 2) {
        double least = most;
        grid.visit(strokes_[i].points[k], most, [&](std::size_t j, std::size_t m) {
          if (j != i && parallel(strokes_[i].tangents[k], strokes_[j].tangents[m]))
            least = std::min(least, distance(strokes_[i].points[k], strokes_[j].points[m]));
        });
        if (least < most) nearest.push_back(least);
      }
    if (nearest.empty()) return 2 * options_.width;
    const auto middle = nearest.begin() + static_cast<long>(nearest.size() / 2);
    std::nth_element(nearest.begin(), middle, nearest.end());
    return std::clamp(3.1 * *middle, 2 * options_.width, 10 * options_.width);
  }

  /// Samples of a that lie alongside b.
  std::vector<bool> alongside(std::size_t a, std::size_t b, double reach) const {
    const SampledStroke& s = strokes_[a];
    const SampledStroke& t = strokes_[b];
    std::vector<bool> marks(s.points.size());
    for (std::size_t i = 0; i < s.points.size(); ++i) {
      double best = reach;
      std::size_t at = t.points.size();
      for (std::size_t j = 0; j < t.points.size(); ++j) {
        const double d = distance(s.points[i], t.points[j]);
        if (d < best && parallel(s.tangents[i], t.tangents[j])) best = d, at = j;
      }
      marks[i] = at < t.points.size();
    }
    return marks;
  }

  bool parallel(Vector2 u, Vector2 v) const {
    return std::abs(dot(u, v)) > std::cos(options_.angle);
  }

  Overlap overlap(std::size_t a, std::size_t b) const {
    const std::vector<bool> on_b = alongside(a, b, reach_);
    const std::vector<bool> on_a = alongside(b, a, reach_);
    const auto share = [](const std::vector<bool>& m) {
      return static_cast<double>(std::count(m.begin(), m.end(), true)) /
             static_cast<double>(m.size());
    };
    const auto at_end = [](const std::vector<bool>& m) {
      const std::size_t near = std::min<std::size_t>(3, m.size());
      return std::any_of(m.begin(), m.begin() + static_cast<long>(near),
                         [](bool v) { return v; }) ||
             std::any_of(m.end() - static_cast<long>(near), m.end(), [](bool v) { return v; });
    };
    Overlap o{share(on_b), share(on_a), at_end(on_b), at_end(on_a), 0};
    o.length = std::min(o.share_a * strokes_[a].length, o.share_b * strokes_[b].length);
    return o;
  }

  bool belong(std::size_t a, std::size_t b) const {
    const Overlap o = overlap(a, b);
    if (std::max(o.share_a, o.share_b) > 0.6) return true;
    return o.end_a && o.end_b && o.length > 1.5 * reach_;
  }

  const std::vector<SampledStroke>& strokes_;
  const ConsolidateOptions& options_;
  std::vector<std::size_t> parent_;
  std::vector<std::pair<std::size_t, std::size_t>> pairs_;  ///< that belong together
  double reach_ = 0;
};

/// A pen's width as drawings of that size and such strokes are drawn with: files that were scaled
/// without their pen would otherwise have a reach far too small or large.
double plausible_width(const std::vector<DrawnStroke>& strokes, double width) {
  Point2 low{INFINITY, INFINITY};
  Point2 high{-INFINITY, -INFINITY};
  double length = 0;
  for (const DrawnStroke& s : strokes) {
    length += core::polygon_length(s.points, s.closed) / static_cast<double>(strokes.size());
    for (const Point2 p : s.points) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
  }
  const double size = distance(low, high);
  if (!(size > 0) || !(length > 0)) return width;
  const double usual = kUsualWidth * std::sqrt(size * length);
  return std::clamp(width, usual, kMostOfUsual * usual);
}

}  // namespace

std::vector<MeantLine> consolidate(const std::vector<DrawnStroke>& strokes,
                                   const ConsolidateOptions& given) {
  ConsolidateOptions options = given;
  if (options.reach <= 0) options.width = plausible_width(strokes, given.width);
  const double step = std::max(options.width, 1e-12) * 1.5;
  std::vector<SampledStroke> sampled;
  for (const DrawnStroke& s : strokes) {
    if (s.points.size() < 2) throw core::InvalidInput("consolidate needs two points per stroke");
    sampled.push_back(sample_stroke(s.points, s.closed, step));
  }
  Grouping grouping(sampled, options);
  std::vector<std::size_t> all(strokes.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  std::vector<std::vector<std::size_t>> open = grouping.groups(all);
  std::vector<MeantLine> lines;
  std::vector<std::size_t> strays;
  while (!open.empty()) {  // strays of a line are lines of their own
    const std::vector<std::size_t> group = std::move(open.back());
    open.pop_back();
    lines.push_back(meant_line(sampled, group, step, grouping.reach(), options.angle, strays));
    for (auto& rest : grouping.groups(strays)) open.push_back(std::move(rest));
  }
  std::sort(lines.begin(), lines.end(), [](const MeantLine& a, const MeantLine& b) {
    return a.members.front() < b.members.front();
  });
  return lines;
}

}  // namespace keyline::sketch
