#include "keyline/sketch/segments.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "keyline/core/angle.h"
#include "keyline/core/quantile.h"

namespace keyline::sketch {
namespace {

using core::cross;
using core::distance;
using core::norm;
using core::Point2;
using core::Vector2;

constexpr double kOnLine = 1;  ///< pixels about a line's points: its ink is there
/// Of the way from a line to where a corner's arms meet: to a corner of sharp ink it is all, to one
/// of soft ink half, and to a round end nothing.
constexpr double kTowards = 1.0 / 3;

/// Widths over which a corner is rounded: at least, and where it is as sharp as corners are (29°).
constexpr double kRounded = 0.6;
constexpr double kSharpest = 2;

/// Points by running index; closed ones come round again.
struct Line {
  const std::vector<Point2>& points;
  bool closed;
  Point2 at(long i) const {
    const long n = static_cast<long>(points.size());
    return points[static_cast<std::size_t>(closed ? ((i % n) + n) % n : std::clamp(i, 0L, n - 1))];
  }
};

Vector2 direction(const Line& line, long from, long to) {
  std::vector<Point2> part;
  for (long i = from; i <= to; ++i) part.push_back(line.at(i));
  return principal_axis(part, 0, part.size() - 1).direction;
}

struct Arms {
  long gap;
  long arm;
};

Arms arms_of(const SegmentOptions& options) {
  const auto gap = static_cast<long>(std::lround(1 + 0.6 * options.width));
  return {gap, gap + std::max(6L, std::lround(4 + options.width))};
}

/// Turn at point i that the bend of its arms does not account for.
double sharpness(const Line& line, long i, const Arms& a) {
  const Vector2 before = direction(line, i - a.arm, i - a.gap);
  const Vector2 after = direction(line, i + a.gap, i + a.arm);
  const double turn = core::angle_between(before, after);
  const long middle = (a.arm + a.gap) / 2;
  const double half = 0.5 * static_cast<double>(a.arm - a.gap);
  const double bend_before = core::angle_between(direction(line, i - a.arm, i - middle),
                                                 direction(line, i - middle, i - a.gap)) /
                             half;
  const double bend_after = core::angle_between(direction(line, i + a.gap, i + middle),
                                                direction(line, i + middle, i + a.arm)) /
                            half;
  const double smooth = 0.5 * (bend_before + bend_after) * static_cast<double>(a.arm + a.gap);
  if (turn * smooth <= 0) return std::abs(turn);
  return std::max(0.0, std::abs(turn) - std::abs(smooth));
}

/// Splits first … last into groups, each straight within the tolerance.
void add_groups(const std::vector<Point2>& p, std::size_t first, std::size_t last, double tolerance,
                std::vector<Axis>& axes, std::vector<std::size_t>& ends) {
  const Axis axis = principal_axis(p, first, last);
  if (axis.largest_offset > tolerance && last - first >= 7) {
    const std::size_t middle = (first + last) / 2;
    add_groups(p, first, middle, tolerance, axes, ends);
    add_groups(p, middle, last, tolerance, axes, ends);
    return;
  }
  axes.push_back(axis);
  ends.push_back(last);
}

Point2 projection(const Axis& axis, Point2 p) {
  return axis.centre + core::dot(p - axis.centre, axis.direction) * axis.direction;
}

std::optional<Point2> intersection(const Axis& a, const Axis& b) {
  const double sine = cross(a.direction, b.direction);
  if (std::abs(sine) < 0.02) return std::nullopt;
  const double u = cross(b.centre - a.centre, b.direction) / sine;
  return a.centre + u * a.direction;
}

/// Where neighbouring axes meet, near the point between their groups.
Point2 meeting(const Axis& a, const Axis& b, Point2 between, double reach) {
  const auto x = intersection(a, b);
  if (x && distance(*x, between) <= reach) return *x;
  return core::mix(projection(a, between), projection(b, between), 0.5);
}

SegmentRun make_run(const std::vector<Point2>& points, std::size_t first, std::size_t last,
                    bool closed, double tolerance) {
  SegmentRun run{.first = first, .last = last, .closed = closed, .axes = {}, .vertices = {}};
  std::vector<Point2> p;
  for (std::size_t i = first; i <= last; ++i) p.push_back(points[i % points.size()]);
  if (closed) p.push_back(p.front());
  const std::size_t n = p.size();
  const double wanted = std::ceil(1 + std::log2(static_cast<double>(n)));
  const auto groups = std::clamp<std::size_t>(static_cast<std::size_t>(wanted), closed ? 4 : 1,
                                              std::max<std::size_t>(closed ? 4 : 1, (n - 1) / 5));
  std::vector<std::size_t> ends;
  for (std::size_t g = 0; g < groups; ++g)
    add_groups(p, (n - 1) * g / groups, (n - 1) * (g + 1) / groups, tolerance, run.axes, ends);
  if (!closed) run.vertices.push_back(projection(run.axes.front(), p.front()));
  for (std::size_t g = 0; g + (closed ? 0 : 1) < run.axes.size(); ++g) {
    const std::size_t next = (g + 1) % run.axes.size();
    const std::size_t from = g == 0 ? 0 : ends[g - 1];
    const std::size_t after = next == 0 ? ends[0] : ends[next] - ends[g];
    const double reach = 0.6 * static_cast<double>(std::min(ends[g] - from, after));
    run.vertices.push_back(meeting(run.axes[g], run.axes[next], p[ends[g]], reach));
  }
  if (!closed) run.vertices.push_back(projection(run.axes.back(), p.back()));
  return run;
}

/// How far from the line the arms of a corner may meet. In ink the two sides of a corner of angle a
/// are one line up to w / (2 sin(a / 2)) from its tip.
double corner_reach(const Line& line, long i, const Arms& a, const SegmentOptions& options) {
  const Vector2 before = line.at(i - a.arm) - line.at(i - a.gap);
  const Vector2 after = line.at(i + a.arm) - line.at(i + a.gap);
  double widths = kRounded;
  if (options.ink && norm(before) > 0 && norm(after) > 0) {
    const double sine = 0.5 * norm(before / norm(before) - after / norm(after));
    widths = std::clamp(0.5 / sine, kRounded, kSharpest);
  }
  return 2 + widths * options.width;
}

/// Where the lines on both sides of a corner meet, found from the arms clear of its rounding; the
/// point itself where they meet too far away.
Point2 corner_place(const Line& line, long i, const Arms& a, double reach) {
  std::vector<Point2> before;
  std::vector<Point2> after;
  for (long k = a.gap; k <= a.arm; ++k) {
    before.push_back(line.at(i - k));
    after.push_back(line.at(i + k));
  }
  const auto x = intersection(principal_axis(before, 0, before.size() - 1),
                              principal_axis(after, 0, after.size() - 1));
  return x && distance(*x, line.at(i)) <= reach ? *x : line.at(i);
}

/// The same of arms that meet on ink; where they meet on paper, no more than at a blunt corner.
double inked_reach(const Line& line, long i, const Arms& a, const SegmentOptions& options) {
  const double blunt = 2 + kRounded * options.width;
  const double reach = corner_reach(line, i, a, options);
  const Vector2 way = corner_place(line, i, a, reach) - line.at(i);
  const double far = norm(way);
  if (far <= blunt) return blunt;
  const auto end = options.ink(line.at(i), way / far, far);
  return end && *end < far ? blunt : reach;
}

/// Half the width of the ink along the arms of a corner, on its outer side.
std::optional<double> outer_half_width(const Line& line, long i, const Arms& a, Vector2 out,
                                       const SegmentOptions& options) {
  std::vector<double> halves;
  for (long k = a.gap; k <= a.arm; ++k)
    for (const long at : {i - k, i + k}) {
      const Vector2 along = line.at(at + 1) - line.at(at - 1);
      if (!(norm(along) > 0)) continue;
      Vector2 across = core::perpendicular_left(along / norm(along));
      if (core::dot(across, out) < 0) across = -1 * across;
      if (const auto half = options.ink(line.at(at), across, kOnLine)) halves.push_back(*half);
    }
  if (halves.empty()) return {};
  return core::quantile(halves);
}

/// True where the arms of a corner meet on paper, and the middle of the ink goes little of the way
/// there.
bool is_round(const Line& line, long i, const Arms& a, const SegmentOptions& options) {
  if (!options.ink) return false;
  const Point2 from = line.at(i);
  const Vector2 way = corner_place(line, i, a, corner_reach(line, i, a, options)) - from;
  const double far = norm(way);
  if (!(far > 0)) return false;
  const auto end = options.ink(from, way / far, far);
  if (!end || *end >= far) return false;
  const auto half = outer_half_width(line, i, a, way / far, options);
  return half && *end - *half < kTowards * far;
}

/// The point of the line nearest to where the arms of a corner meet.
std::size_t nearest_point(const Line& line, long i, const Arms& a) {
  const Point2 x = corner_place(line, i, a, 1.0 + static_cast<double>(a.gap));
  const long n = static_cast<long>(line.points.size());
  long best = i;
  for (long k = i - a.gap; k <= i + a.gap; ++k) {
    if (!line.closed && (k <= 0 || k >= n - 1)) continue;
    if (distance(line.at(k), x) < distance(line.at(best), x)) best = k;
  }
  return static_cast<std::size_t>(((best % n) + n) % n);
}

}  // namespace

std::vector<std::size_t> find_corners(const std::vector<Point2>& points, bool closed,
                                      const SegmentOptions& options) {
  const Line line{points, closed};
  const Arms arms = arms_of(options);
  const long n = static_cast<long>(points.size());
  std::vector<std::size_t> corners;
  if (n < 2 * arms.arm + 1) return corners;
  std::vector<double> sharp(points.size(), 0);
  const long margin = closed ? 0 : arms.arm;
  for (long i = margin; i < n - margin; ++i) {
    // a quick look first: most places are nearly straight
    const Vector2 u = line.at(i) - line.at(i - arms.arm);
    const Vector2 v = line.at(i + arms.arm) - line.at(i);
    if (std::abs(core::angle_between(u, v)) < 0.6 * options.corner_angle) continue;
    sharp[static_cast<std::size_t>(i)] = sharpness(line, i, arms);
  }
  for (long i = 0; i < n; ++i) {
    const double here = sharp[static_cast<std::size_t>(i)];
    if (here < options.corner_angle) continue;
    bool top = true;
    for (long k = -arms.arm; k <= arms.arm && top; ++k) {
      const long j = closed ? ((i + k) % n + n) % n : i + k;
      if (k == 0 || j < 0 || j >= n) continue;
      const double other = sharp[static_cast<std::size_t>(j)];
      top = other < here || (other == here && k > 0);
    }
    if (!top) continue;
    const std::size_t at = nearest_point(line, i, arms);
    if (!is_round(line, static_cast<long>(at), arms, options)) corners.push_back(at);
  }
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  return corners;
}

std::vector<SegmentRun> fit_segments(const std::vector<Point2>& points, bool closed,
                                     const SegmentOptions& options) {
  const std::vector<std::size_t> corners = find_corners(points, closed, options);
  const std::size_t n = points.size();
  std::vector<SegmentRun> runs;
  std::vector<std::size_t> cuts = corners;
  if (closed && corners.empty()) {
    runs.push_back(make_run(points, 0, n - 1, true, options.straightness));
    return runs;
  }
  if (closed) {
    cuts.push_back(corners.front() + n);
  } else {
    cuts.insert(cuts.begin(), 0);
    cuts.push_back(n - 1);
  }
  for (std::size_t k = 0; k + 1 < cuts.size(); ++k)
    runs.push_back(make_run(points, cuts[k], cuts[k + 1], false, options.straightness));
  const Line line{points, closed};
  const auto meet = [&](SegmentRun& before, SegmentRun& after) {
    const auto i = static_cast<long>(after.first);
    const double reach = inked_reach(line, i, arms_of(options), options);
    before.vertices.back() = after.vertices.front() =
        corner_place(line, i, arms_of(options), reach);
    before.round_last = after.round_first = reach;
  };
  for (std::size_t k = 0; k + 1 < runs.size(); ++k) meet(runs[k], runs[k + 1]);
  if (closed) meet(runs.back(), runs.front());
  return runs;
}

}  // namespace keyline::sketch
