#include "keyline/sketch/meant_line.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "keyline/core/angle.h"
#include "keyline/core/polygon.h"
#include "keyline/core/quantile.h"
#include "keyline/sketch/align_strokes.h"
#include "keyline/sketch/hold_line.h"
#include "keyline/sketch/lone_strokes.h"
#include "keyline/sketch/strip.h"
#include "keyline/sketch/whittaker.h"

namespace keyline::sketch {
namespace {

using core::dot;
using core::Point2;
using core::Vector2;

constexpr double kMostSamples = 400;    ///< of the longest stroke
constexpr int kRounds = 2;              ///< of alignment and mean
constexpr double kFarOnes = 0.9;        ///< rank of the distances to the next stroke …
constexpr double kReachOfSpacing = 2;   ///< … that strokes are looked for at, so many times
constexpr double kReachOfSpread = 1.5;  ///< and so many times where the strokes reach
constexpr double kAskew = 4;            ///< spreads that a strip cut askew reaches past its end
constexpr double kMostOff = 1.5;        ///< widths of the pen: what is farther lies on paper
constexpr double kOffShare = 0.02;      ///< of a line that may lie on paper, or it is none
constexpr double kChangesOff = 0.01;    ///< of a line, for going over gently between strokes
constexpr std::array kSteeper = {1.0, 1.4, 2.0, 4.0};  ///< times the angle; the last a step
constexpr double kAway = 3;      ///< times how near passes lie: a loop goes so far away, or is none
constexpr double kOnStroke = 1;  ///< widths: where lines are held, so that curves stay on
constexpr double kGoOver = 2;    ///< reaches, from the mean of several strokes to one alone
constexpr double kMostly =
    2.0 / 3;  ///< of a stroke runs beside its line: twice as much as does not

class Line {
 public:
  Line(const std::vector<SampledStroke>& strokes, const std::vector<std::size_t>& members,
       const LineOptions& options)
      : width_(options.width), angle_(options.passes.angle), passes_(options.passes) {
    double longest = 0;
    for (const std::size_t m : members) longest = std::max(longest, strokes[m].length);
    step_ = std::max(options.step, longest / kMostSamples);
    for (const std::size_t m : members)
      strokes_.push_back(sample_stroke(strokes[m].points, strokes[m].closed, step_));
    const double most = std::max(2 * width_, pass_distance(passes_, longest));
    near_ = std::clamp(kReachOfSpacing * spacing(most), 2 * width_, most);
  }

  void find() {
    Strip strip = lay_strip(strokes_, near_, step_);
    const double spread = spread_of(strip, strokes_, step_);
    reach_ = std::max(near_, kReachOfSpread * spread);
    cut_ends(strip, kAskew * spread);
    set_line(middle_of(strip, strokes_, step_, 2 * reach_), false);
    close();
    close_gap();
    for (int round = 0; round < kRounds; ++round) average();
    const double off = hold();
    if (off > kOffShare) return take_longest();
    const SampledStroke held = line_;
    set_line(follow_lone_strokes(line_, strokes_, reach_, kGoOver * reach_), line_.closed);
    if (share_off() > off) line_ = held;
  }

  /// Of the line, on paper.
  double share_off() const {
    return sketch::share_off(line_.points, line_.closed, strokes_, kMostOff * width_);
  }

  /// Keeps the line to its strokes, going over from one to another as gently as little paper
  /// allows; the share that lies on paper.
  double hold() {
    const SampledStroke before = line_;
    double off = 0;
    for (const double steeper : kSteeper) {
      const Going going{4 * near_, std::min(steeper * angle_, M_PI / 2)};
      set_line(hold_to_strokes(before, strokes_, kOnStroke * width_, reach_, going), before.closed);
      off = share_off();
      if (off <= kChangesOff) break;
    }
    return off;
  }

  /// A stroke is a line that lies on strokes, whatever the others do.
  void take_longest() {
    line_ = *std::max_element(strokes_.begin(), strokes_.end(),
                              [](const auto& a, const auto& b) { return a.length < b.length; });
    reach_ = near_;
  }

  /// The line with those of the strokes, so numbered, that run beside it; the one that does so for
  /// longest if none does for long enough.
  MeantLine meant(const std::vector<std::size_t>& numbers) const {
    MeantLine found{line_.points, line_.closed, {}, 0};
    std::size_t longest = 0;
    double most = -1;
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      const double along = beside(k);
      if (along > most) longest = k, most = along;
      if (along < kMostly * strokes_[k].length) continue;
      found.members.push_back(numbers[k]);
      found.explained += along;
    }
    if (found.members.empty()) found.members = {numbers[longest]};
    return found;
  }

 private:
  /// Length of a stroke, by index, that runs beside the line.
  double beside(std::size_t k) const {
    const SampledStroke& s = strokes_[k];
    const double reach = std::min(reach_, pass_distance(passes_, s.length));
    const Alignment a = align(s, line_, reach_);
    const std::size_t n = a.at.size();
    std::size_t count = 0;
    for (std::size_t i = 0; i < n; ++i) {
      if (a.at[i] < 0) continue;
      const Point2 p = s.points[a.reversed ? n - 1 - i : i];
      const Point2 q = line_.points[static_cast<std::size_t>(a.at[i])];
      count += core::distance(p, q) < reach ? 1 : 0;
    }
    return s.length * static_cast<double>(count) / static_cast<double>(n);
  }

  /// Usual distance of a place on a stroke from the next stroke that runs along it, at most `most`.
  double spacing(double most) const {
    const StrokeGrid grid(strokes_, most);
    std::vector<double> nearest;
    for (std::size_t i = 0; i < strokes_.size(); ++i)
      for (std::size_t k = 0; k < strokes_[i].points.size(); ++k) {
        const Point2 p = strokes_[i].points[k];
        const Vector2 t = strokes_[i].tangents[k];
        double least = most;
        grid.visit_others(p, most, i, [&](std::size_t j, std::size_t m) {
          if (std::abs(dot(t, strokes_[j].tangents[m])) > std::cos(angle_))
            least = std::min(least, core::distance(p, strokes_[j].points[m]));
        });
        if (least < most) nearest.push_back(least);
      }
    if (nearest.empty()) return most;
    return core::value_at(nearest, kFarOnes);
  }

  void set_line(const std::vector<Point2>& points, bool closed) {
    line_ = sample_stroke(points, closed, step_);
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
      if (i > 0) turned += core::angle_between(line_.tangents[i - 1], line_.tangents[i]);
      if (i < n / 3 || away < std::max(kAway * near_, std::min(4 * near_, 0.2 * line_.length)))
        continue;
      const double laps = turned / (2 * M_PI);
      if (std::abs(laps - std::round(laps)) > 0.2 || std::abs(laps) > 1.3) continue;
      for (std::size_t j = 0; j < heads; ++j) {
        if (core::distance(p[i], p[j]) > 1.5 * near_) continue;
        if (dot(line_.tangents[i], line_.tangents[j]) < std::cos(1.5 * angle_)) continue;
        if (i - j < n / 4 || !runs_on(i, j)) continue;
        set_line({p.begin() + static_cast<long>(j), p.begin() + static_cast<long>(i)}, true);
        return;
      }
    }
  }

  /// Closes a line whose end faces its start.
  void close_gap() {
    if (line_.closed || line_.points.size() < 12 || line_.length < 8 * near_) return;
    const Vector2 gap = line_.points.front() - line_.points.back();
    if (core::norm(gap) > 2 * near_) return;
    if (dot(line_.tangents.front(), line_.tangents.back()) < std::cos(3 * angle_)) return;
    set_line(line_.points, true);
  }

  /// True where the line from sample i on keeps beside the line from sample j on, to its end.
  bool runs_on(std::size_t i, std::size_t j) const {
    const std::vector<Point2>& p = line_.points;
    for (std::size_t k = i; k < p.size(); ++k) {
      double least = 4 * near_;
      for (std::size_t m = j; m < std::min(i, j + 2 * (k - i) + 8); ++m)
        least = std::min(least, core::distance(p[k], p[m]));
      if (least > 2 * near_) return false;
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
    const Alignment a = align(s, line_, reach_);
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
    constexpr double kFully = 1e9;  // samples: beyond any ramp of weights at an end
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
  double width_;
  double near_ = 0;   ///< how far apart neighbours lie, twice over
  double reach_ = 0;  ///< how far from the line its strokes run
  double angle_;
  PassModel passes_;
};

}  // namespace

MeantLine meant_line(const std::vector<SampledStroke>& strokes,
                     const std::vector<std::size_t>& members, const LineOptions& options,
                     std::vector<std::size_t>& strays) {
  strays.clear();
  const SampledStroke& only = strokes[members.front()];
  if (members.size() == 1) return {only.points, only.closed, members, only.length};
  std::vector<std::size_t> passes = members;
  while (true) {
    Line line(strokes, passes, options);
    line.find();
    const MeantLine meant = line.meant(passes);
    if (meant.members.size() == passes.size()) return meant;
    for (const std::size_t m : passes)
      if (std::ranges::find(meant.members, m) == meant.members.end()) strays.push_back(m);
    passes = meant.members;
    if (passes.size() > 1) continue;
    const SampledStroke& last = strokes[passes.front()];
    return {last.points, last.closed, passes, last.length};
  }
}

}  // namespace keyline::sketch
