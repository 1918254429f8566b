#include "keyline/sketch/meant_line.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "keyline/core/polygon.h"
#include "keyline/sketch/align_strokes.h"
#include "keyline/sketch/polyline_tools.h"
#include "keyline/sketch/whittaker.h"

namespace keyline::sketch {
namespace {

using core::dot;
using core::Point2;
using core::Vector2;

constexpr double kMostSamples = 400;    ///< of the longest stroke
constexpr double kLongShare = 0.75;     ///< of the longest: strokes that may be the spine
constexpr double kStripShare = 0.08;    ///< of their length: strokes farther apart are no strip
constexpr double kStrayReach = 1;       ///< reaches: samples farther off are not beside the line
constexpr std::size_t kCandidates = 9;  ///< spines tried
constexpr std::size_t kCompared = 24;   ///< strokes each is compared with
constexpr int kRounds = 3;              ///< of alignment and mean

class Line {
 public:
  Line(const std::vector<SampledStroke>& strokes, const std::vector<std::size_t>& members,
       double step, double reach, double angle)
      : reach_(reach), angle_(angle) {
    double longest = 0;
    for (const std::size_t m : members) longest = std::max(longest, strokes[m].length);
    step_ = std::max(step, longest / kMostSamples);
    for (const std::size_t m : members)
      strokes_.push_back(sample_stroke(strokes[m].points, strokes[m].closed, step_));
    spread_ = std::max(reach_, 2 * strip_width());
  }

  void find() {
    line_ = strokes_[spine()];
    close();
    prolong();
    close_gap();
    for (int round = 0; round < kRounds; ++round) average();
  }

  const SampledStroke& line() const { return line_; }

  /// Strokes, by index, of which less than half runs beside the line.
  std::vector<std::size_t> strays() const {
    std::vector<std::size_t> out;
    for (std::size_t k = 0; k < strokes_.size(); ++k) {
      const Alignment a = align(strokes_[k], line_, spread_);
      const std::size_t n = a.at.size();
      std::size_t beside = 0;
      for (std::size_t i = 0; i < n; ++i) {
        if (a.at[i] < 0) continue;
        const Point2 p = strokes_[k].points[a.reversed ? n - 1 - i : i];
        const Point2 q = line_.points[static_cast<std::size_t>(a.at[i])];
        beside += core::distance(p, q) < kStrayReach * spread_ ? 1 : 0;
      }
      if (2 * beside < n) out.push_back(k);
    }
    return out.size() < strokes_.size() ? out : std::vector<std::size_t>{};
  }

 private:
  /// Indices of the strokes, longest first.
  std::vector<std::size_t> by_length() const {
    std::vector<std::size_t> order(strokes_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return strokes_[a].length > strokes_[b].length;
    });
    return order;
  }

  /// The long strokes, longest first.
  std::vector<std::size_t> long_strokes() const {
    std::vector<std::size_t> order = by_length();
    std::size_t count = 1;
    while (count < std::min(kCandidates, order.size()) &&
           strokes_[order[count]].length > kLongShare * strokes_[order[0]].length)
      ++count;
    order.resize(count);
    return order;
  }

  /// Usual distance of equal shares of the way of two long strokes: strokes that were all drawn
  /// from one end of the line to the other make a strip, however close its windings lie.
  double strip_width() const {
    constexpr int kShares = 16;
    const std::vector<std::size_t> order = long_strokes();
    std::vector<double> apart;
    for (std::size_t a = 0; a < order.size(); ++a)
      for (std::size_t b = 0; b < a; ++b) {
        const std::vector<Point2>& p = strokes_[order[a]].points;
        const std::vector<Point2>& q = strokes_[order[b]].points;
        double forward = 0;
        double backward = 0;
        for (std::size_t k = 0; k <= kShares; ++k) {
          const Point2 at = p[(p.size() - 1) * k / kShares];
          forward += core::distance(at, q[(q.size() - 1) * k / kShares]) / (kShares + 1);
          backward +=
              core::distance(at, q[(q.size() - 1) * (kShares - k) / kShares]) / (kShares + 1);
        }
        const double least = std::min(forward, backward);
        if (least < kStripShare * strokes_[order[a]].length) apart.push_back(least);
      }
    if (apart.empty()) return 0;
    const auto middle = apart.begin() + static_cast<long>(apart.size() / 2);
    std::nth_element(apart.begin(), middle, apart.end());
    return *middle;
  }

  /// Of the long strokes the one that the others lie nearest to.
  std::size_t spine() const {
    const std::vector<std::size_t> order = by_length();
    const std::size_t candidates = long_strokes().size();
    std::size_t best = order[0];
    double least = -1;
    for (std::size_t c = 0; c < candidates && candidates > 1; ++c) {
      double cost = 0;
      for (std::size_t k = 0; k < std::min(kCompared, order.size()); ++k)
        if (k != c) cost += align(strokes_[order[k]], strokes_[order[c]], spread_).cost;
      if (least >= 0 && cost >= least) continue;
      least = cost;
      best = order[c];
    }
    return best;
  }

  void set_line(const std::vector<Point2>& points, bool closed) {
    line_ = sample_stroke(points, closed, step_);
  }

  /// What of a stroke runs past the line's end (of its start where `before`), in the line's order;
  /// nothing where it does not go on from there.
  std::vector<Point2> overhang(const SampledStroke& s, const Alignment& a, bool before) const {
    std::vector<Point2> over;
    const std::size_t n = s.points.size();
    for (std::size_t i = 0; i < n; ++i)
      if (a.at[i] == (before ? Alignment::kBefore : Alignment::kAfter))
        over.push_back(s.points[a.reversed ? n - 1 - i : i]);
    if (over.size() < 3 || over.size() == n) return {};
    const Point2 end = before ? line_.points.front() : line_.points.back();
    const Vector2 way = before ? line_.tangents.front() : line_.tangents.back();
    const std::size_t near = before ? over.size() - 1 : 0;
    const Vector2 d = before ? over[near] - over[near - 2] : over[2] - over[0];
    const bool goes_on = core::distance(over[near], end) < 2 * spread_ + step_ &&
                         dot(d, way) > std::cos(3 * angle_) * core::norm(d);
    return goes_on ? over : std::vector<Point2>{};
  }

  /// Adds to either end the longest of what runs past it, again and again.
  void prolong() {
    for (std::size_t round = 0; round < 2 * strokes_.size() && !line_.closed; ++round) {
      std::vector<Point2> best;
      bool at_start = false;
      for (const SampledStroke& s : strokes_) {
        const Alignment a = align(s, line_, spread_);
        for (const bool before : {false, true}) {
          std::vector<Point2> over = overhang(s, a, before);
          if (over.size() > best.size()) best = std::move(over), at_start = before;
        }
      }
      if (best.size() < 3) return;
      std::vector<Point2> points = line_.points;
      points.insert(at_start ? points.begin() : points.end(), best.begin(), best.end());
      set_line(points, false);
      close();
    }
  }

  /// Closes a line whose last part runs along its first in the same direction; what overlaps goes.
  void close() {
    if (line_.closed || line_.points.size() < 12) return;
    const std::vector<Point2>& p = line_.points;
    const std::size_t n = p.size();
    const std::size_t heads = std::min<std::size_t>(n / 4, 12);
    double turned = 0;  // a loop turns once around, or not at all (an eight)
    std::size_t i = 0;
    double away = 0;
    for (; i < n; ++i) {
      away = std::max(away, core::distance(p[i], p[0]));
      if (i > 0)
        turned += std::atan2(core::cross(line_.tangents[i - 1], line_.tangents[i]),
                             dot(line_.tangents[i - 1], line_.tangents[i]));
      if (i < n / 3 || away < std::min(4 * reach_, 0.2 * line_.length)) continue;
      const double laps = turned / (2 * M_PI);
      if (std::abs(laps - std::round(laps)) > 0.2 || std::abs(laps) > 1.3) continue;
      for (std::size_t j = 0; j < heads; ++j) {
        if (core::distance(p[i], p[j]) > 1.5 * reach_) continue;
        if (dot(line_.tangents[i], line_.tangents[j]) < std::cos(1.5 * angle_)) continue;
        if (i - j < n / 4 || !runs_on(i, j)) continue;
        set_line({p.begin() + static_cast<long>(j), p.begin() + static_cast<long>(i)}, true);
        return;
      }
    }
  }

  /// Closes a line whose end faces its start.
  void close_gap() {
    if (line_.closed || line_.points.size() < 12 || line_.length < 8 * reach_) return;
    const Vector2 gap = line_.points.front() - line_.points.back();
    if (core::norm(gap) > 2 * reach_) return;
    if (dot(line_.tangents.front(), line_.tangents.back()) < std::cos(3 * angle_)) return;
    set_line(line_.points, true);
  }

  /// True where the line from sample i on keeps beside the line from sample j on, to its end.
  bool runs_on(std::size_t i, std::size_t j) const {
    const std::vector<Point2>& p = line_.points;
    for (std::size_t k = i; k < p.size(); ++k) {
      double least = 4 * reach_;
      for (std::size_t m = j; m < std::min(i, j + 2 * (k - i) + 8); ++m)
        least = std::min(least, core::distance(p[k], p[m]));
      if (least > 2 * reach_) return false;
    }
    return true;
  }

  /// The line becomes the mean of the strokes beside its samples; strokes count less towards ends
  /// that lie within the line, so that no step shows where they begin.
  void average() {
    const std::size_t m = line_.points.size();
    if (m < 5) return;
    std::vector<Vector2> sum(m);
    std::vector<double> weight(m, 0);
    for (const SampledStroke& s : strokes_) add(s, sum, weight);
    std::vector<Point2> moved = line_.points;
    std::vector<double> certain(m, 1e-3);
    for (std::size_t j = 0; j < m; ++j) {
      if (weight[j] <= 0) continue;
      moved[j] = Point2{} + sum[j] / weight[j];
      certain[j] = 1;
    }
    const double wavelength = std::max(6.0, 3 * reach_ / step_);
    set_line(smooth_points(moved, certain, lambda_of_wavelength(wavelength), line_.closed),
             line_.closed);
  }

  /// Adds a stroke's offsets across the line, which its samples do not move along it.
  void add(const SampledStroke& s, std::vector<Vector2>& sum, std::vector<double>& weight) const {
    const Alignment a = align(s, line_, spread_);
    const std::size_t m = line_.points.size();
    std::vector<double> offset(m, 0);
    std::vector<double> count(m, 0);
    std::vector<double> inside(m, 0);
    spread_offsets(s, a, offset, count, inside);
    const double ramp = std::max(1.0, 2 * reach_ / step_);
    if (!line_.closed) hold_ends(static_cast<std::size_t>(2 * ramp), offset, count, inside);
    for (std::size_t j = 0; j < m; ++j) {
      if (count[j] <= 0) continue;
      const double w = std::min(1.0, (inside[j] + 0.5) / ramp);
      const Vector2 across = core::perpendicular_left(line_.tangents[j]);
      sum[j] = sum[j] + w * (line_.points[j] - Point2{} + (offset[j] / count[j]) * across);
      weight[j] += w;
    }
  }

  /// By sample of the line: sum and number of offsets of the stroke's samples beside it, and how
  /// many samples away the stroke's nearer end is. Samples that were stepped over take the next.
  void spread_offsets(const SampledStroke& s, const Alignment& a, std::vector<double>& offset,
                      std::vector<double>& count, std::vector<double>& inside) const {
    const std::size_t m = line_.points.size();
    const std::size_t n = a.at.size();
    int last = -1;
    for (std::size_t i = 0; i < n; ++i) {
      if (a.at[i] < 0) continue;
      const auto j = static_cast<std::size_t>(a.at[i]);
      const Point2 p = s.points[a.reversed ? n - 1 - i : i];
      std::size_t k = last < 0 || a.at[i] == last ? j : (static_cast<std::size_t>(last) + 1) % m;
      while (true) {
        offset[k] += dot(p - line_.points[k], core::perpendicular_left(line_.tangents[k]));
        count[k] += 1;
        inside[k] = std::max(inside[k], static_cast<double>(std::min(i, n - 1 - i)));
        if (k == j) break;
        k = (k + 1) % m;
      }
      last = a.at[i];
    }
  }

  /// A stroke that ends close to an end of the line goes on beside it to that end and counts fully.
  static void hold_ends(std::size_t near, std::vector<double>& offset, std::vector<double>& count,
                        std::vector<double>& inside) {
    constexpr double kFully = 1e9;
    const std::size_t m = count.size();
    std::size_t first = 0;
    while (first < m && count[first] <= 0) ++first;
    if (first == m) return;
    std::size_t last = m - 1;
    while (count[last] <= 0) --last;
    const auto fill = [&](std::size_t from, std::size_t to, std::size_t like) {
      for (std::size_t j = from; j < to; ++j) {
        inside[j] = kFully;
        if (count[j] > 0) continue;
        offset[j] = offset[like] / count[like];
        count[j] = 1;
      }
    };
    if (first <= near) fill(0, std::min(m, first + near), first);
    if (m - 1 - last <= near) fill(last > near ? last - near : 0, m, last);
  }

  std::vector<SampledStroke> strokes_;
  SampledStroke line_;
  double step_ = 1;
  double reach_;
  double spread_ = 0;  ///< how far apart strokes lie that were drawn whole, or reach
  double angle_;
};

}  // namespace

MeantLine meant_line(const std::vector<SampledStroke>& strokes,
                     const std::vector<std::size_t>& members, double step, double reach,
                     double angle, std::vector<std::size_t>& strays) {
  strays.clear();
  const SampledStroke& only = strokes[members.front()];
  if (members.size() == 1) return {only.points, only.closed, members};
  Line line(strokes, members, step, reach, angle);
  line.find();
  MeantLine meant{line.line().points, line.line().closed, {}};
  for (const std::size_t k : line.strays()) strays.push_back(members[k]);
  for (const std::size_t m : members)
    if (std::find(strays.begin(), strays.end(), m) == strays.end()) meant.members.push_back(m);
  return meant;
}

}  // namespace keyline::sketch
