#include "keyline/sketch/consolidate.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "keyline/core/error.h"
#include "keyline/core/polygon.h"
#include "keyline/sketch/polyline_tools.h"
#include "keyline/sketch/stroke_grid.h"
#include "keyline/sketch/whittaker.h"

namespace keyline::sketch {
namespace {

using core::distance;
using core::dot;
using core::Point2;
using core::Vector2;

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
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
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
      if (belong(pair.first, pair.second)) parent_[root(pair.first)] = root(pair.second);
  }

  std::size_t root(std::size_t i) const {
    while (parent_[i] != i) i = parent_[i];
    return i;
  }

  double reach() const { return reach_; }

 private:
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
  double reach_ = 0;
};

/// The line of one group.
class Spine {
 public:
  Spine(const std::vector<SampledStroke>& strokes, const std::vector<std::size_t>& members,
        double step, double reach, double angle)
      : strokes_(strokes), members_(members), step_(step), reach_(reach), angle_(angle) {
    start();
    prolong();
    std::reverse(line_.begin(), line_.end());
    prolong();
    close();
  }

  MeantLine line() {
    for (int round = 0; round < 2 && members_.size() > 1; ++round) average();
    return {line_, closed_, members_};
  }

 private:
  const SampledStroke& stroke(std::size_t m) const { return strokes_[members_[m]]; }

  void start() {
    used_.assign(members_.size(), false);
    std::size_t longest = 0;
    for (std::size_t m = 1; m < members_.size(); ++m)
      if (stroke(m).length > stroke(longest).length) longest = m;
    used_[longest] = true;
    line_ = stroke(longest).points;
    closed_ = stroke(longest).closed;
  }

  Vector2 end_direction() const {
    const std::size_t back = std::min<std::size_t>(line_.size() - 1, 4);
    const Vector2 d = line_.back() - line_[line_.size() - 1 - back];
    return core::norm(d) > 0 ? d / core::norm(d) : Vector2{1, 0};
  }

  /// Appends, at the end of the line, the member that goes on there the farthest, again and again.
  void prolong() {
    while (!closed_) {
      const Point2 end = line_.back();
      const Vector2 direction = end_direction();
      std::vector<Point2> best;
      std::size_t which = members_.size();
      for (std::size_t m = 0; m < members_.size(); ++m) {
        if (used_[m]) continue;
        std::vector<Point2> more = continuation(stroke(m), end, direction);
        if (more.size() > best.size()) best = std::move(more), which = m;
      }
      if (which == members_.size() || best.size() < 3) return;
      used_[which] = true;
      line_.insert(line_.end(), best.begin(), best.end());
    }
  }

  /// What of a stroke lies beyond the end, from where it passes it.
  std::vector<Point2> continuation(const SampledStroke& s, Point2 end, Vector2 direction) const {
    double best = 2 * reach_;
    std::size_t at = s.points.size();
    for (std::size_t i = 0; i < s.points.size(); ++i) {
      const double d = distance(s.points[i], end);
      if (d < best && std::abs(dot(s.tangents[i], direction)) > std::cos(1.5 * angle_))
        best = d, at = i;
    }
    if (at == s.points.size()) return {};
    std::vector<Point2> more;
    const bool forward = dot(s.tangents[at], direction) > 0;
    const auto add = [&](Point2 p) {
      if (dot(p - end, direction) > 0.5 * step_ || !more.empty()) more.push_back(p);
    };
    if (forward) {
      for (std::size_t i = at; i < s.points.size(); ++i) add(s.points[i]);
    } else {
      for (std::size_t i = at + 1; i-- > 0;) add(s.points[i]);
    }
    return more;
  }

  /// Closes a line whose end runs into its start in the start's direction; what overlaps goes.
  void close() {
    if (closed_ || line_.size() < 12) return;
    const double whole = core::polygon_length(line_);
    const std::size_t n = line_.size();
    const std::size_t part =
        std::min<std::size_t>(n / 3, static_cast<std::size_t>(0.35 * whole / step_));
    const auto tangent = [&](std::size_t i) {
      const Vector2 d = line_[std::min(i + 2, n - 1)] - line_[i < 2 ? 0 : i - 2];
      return core::norm(d) > 0 ? d / core::norm(d) : Vector2{1, 0};
    };
    // the first point of the last part that comes alongside the start
    for (std::size_t i = n - 1 - part; i < n; ++i)
      for (std::size_t j = 0; j < std::min<std::size_t>(part, 6); ++j) {
        if (distance(line_[i], line_[j]) > 1.5 * reach_) continue;
        if (dot(tangent(i), tangent(j)) < std::cos(1.5 * angle_)) continue;
        closed_ = true;
        line_.resize(i);
        line_.erase(line_.begin(), line_.begin() + static_cast<long>(j));
        return;
      }
  }

  /// Moves every point to the mean of the members that pass alongside, and smooths.
  void average() {
    std::vector<Point2> even;
    std::vector<double> unused;
    resample(line_, std::vector<double>(line_.size(), 0), step_, closed_, even, unused);
    const std::size_t n = even.size();
    if (n < 5) return;
    std::vector<Point2> moved = even;
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t before = i > 1 ? i - 2 : closed_ ? i + n - 2 : 0;
      const std::size_t after = closed_ ? (i + 2) % n : std::min(i + 2, n - 1);
      const Vector2 d = even[after] - even[before];
      if (!(core::norm(d) > 0)) continue;
      const Vector2 u = d / core::norm(d);
      const Vector2 normal = core::perpendicular_left(u);
      double sum = 0;
      double count = 0;
      for (std::size_t m = 0; m < members_.size(); ++m) {
        const double offset = crossing(stroke(m), even[i], u, normal);
        if (std::isnan(offset)) continue;
        sum += offset;
        ++count;
      }
      if (count > 0) moved[i] = even[i] + (sum / count) * normal;
    }
    const double wavelength = std::max(6.0, 3 * reach_ / step_);
    line_ =
        smooth_points(moved, std::vector<double>(n, 1), lambda_of_wavelength(wavelength), closed_);
  }

  /// Offset along the normal at which a stroke passes, parallel; NaN where it does not.
  double crossing(const SampledStroke& s, Point2 p, Vector2 u, Vector2 normal) const {
    double best = NAN;
    for (std::size_t i = 0; i < s.points.size(); ++i) {
      const Vector2 d = s.points[i] - p;
      if (std::abs(dot(d, u)) > 0.75 * step_ || std::abs(dot(d, normal)) > 1.5 * reach_) continue;
      if (std::abs(dot(s.tangents[i], u)) < std::cos(1.5 * angle_)) continue;
      const double offset =
          dot(d, normal) - dot(d, u) * dot(s.tangents[i], normal) / dot(s.tangents[i], u);
      if (std::isnan(best) || std::abs(offset) < std::abs(best)) best = offset;
    }
    return best;
  }

  const std::vector<SampledStroke>& strokes_;
  const std::vector<std::size_t>& members_;
  double step_;
  double reach_;
  double angle_;
  std::vector<bool> used_;
  std::vector<Point2> line_;
  bool closed_ = false;
};

}  // namespace

std::vector<MeantLine> consolidate(const std::vector<DrawnStroke>& strokes,
                                   const ConsolidateOptions& options) {
  const double step = std::max(options.width, 1e-12) * 1.5;
  std::vector<SampledStroke> sampled;
  for (const DrawnStroke& s : strokes) {
    if (s.points.size() < 2) throw core::InvalidInput("consolidate needs two points per stroke");
    sampled.push_back(sample_stroke(s.points, s.closed, step));
  }
  const Grouping grouping(sampled, options);
  std::vector<std::vector<std::size_t>> groups(strokes.size());
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < strokes.size(); ++i) {
    auto& group = groups[grouping.root(i)];
    if (group.empty()) order.push_back(grouping.root(i));
    group.push_back(i);
  }
  std::vector<MeantLine> lines;
  for (const std::size_t g : order) {
    lines.push_back(Spine(sampled, groups[g], step, grouping.reach(), options.angle).line());
  }
  return lines;
}

}  // namespace keyline::sketch
