#include "keyline/figure/path.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace keyline::figure {

using core::Point2;

Path& Path::move_to(Point2 p) {
  steps.push_back({PathVerb::move, {p, p, p}});
  return *this;
}

Path& Path::line_to(Point2 p) {
  steps.push_back({PathVerb::line, {p, p, p}});
  return *this;
}

Path& Path::cubic_to(Point2 handle0, Point2 handle1, Point2 end) {
  steps.push_back({PathVerb::cubic, {handle0, handle1, end}});
  return *this;
}

Path& Path::close() {
  steps.push_back({PathVerb::close, {}});
  return *this;
}

void include(Box& b, Point2 p) {
  if (!core::is_finite(p)) return;
  if (is_empty(b)) {
    b = {p, p};
    return;
  }
  b.min = {std::min(b.min.x, p.x), std::min(b.min.y, p.y)};
  b.max = {std::max(b.max.x, p.x), std::max(b.max.y, p.y)};
}

Box grown(const Box& b, double margin) {
  return {{b.min.x - margin, b.min.y - margin}, {b.max.x + margin, b.max.y + margin}};
}

Box box_of(std::span<const Point2> points) {
  Box box;
  for (const Point2& p : points) include(box, p);
  return box;
}

Path rectangle(const Box& box) {
  Path path;
  path.move_to(box.min).line_to({box.max.x, box.min.y}).line_to(box.max);
  path.line_to({box.min.x, box.max.y}).close();
  return path;
}

Path circle(Point2 center, double radius) {
  const double h = 0.5522847498307936 * radius;
  const double r = radius;
  const auto at = [center](double x, double y) { return Point2{center.x + x, center.y + y}; };
  Path path;
  path.move_to(at(r, 0));
  path.cubic_to(at(r, h), at(h, r), at(0, r));
  path.cubic_to(at(-h, r), at(-r, h), at(-r, 0));
  path.cubic_to(at(-r, -h), at(-h, -r), at(0, -r));
  path.cubic_to(at(h, -r), at(r, -h), at(r, 0));
  return path.close();
}

Path polyline(std::span<const Point2> points, bool closed) {
  Path path;
  bool pen_down = false;
  bool whole = true;
  for (const Point2& p : points) {
    if (!core::is_finite(p)) {
      pen_down = false;
      whole = false;
      continue;
    }
    pen_down ? path.line_to(p) : path.move_to(p);
    pen_down = true;
  }
  if (closed && whole && !points.empty()) path.close();
  return path;
}

namespace {

/// Part of [0, 1] in which a + u d stays within [low, high]; false where none is left.
bool clip_axis(double a, double d, double low, double high, double& u0, double& u1) {
  if (d == 0) return low <= a && a <= high;
  double enter = (low - a) / d;
  double leave = (high - a) / d;
  if (enter > leave) std::swap(enter, leave);
  u0 = std::max(u0, enter);
  u1 = std::min(u1, leave);
  return u0 <= u1;
}

/// Liang and Barsky; the part of ab inside the box.
std::optional<std::pair<Point2, Point2>> clip_line(Point2 a, Point2 b, const Box& box) {
  double u0 = 0;
  double u1 = 1;
  if (!clip_axis(a.x, b.x - a.x, box.min.x, box.max.x, u0, u1)) return std::nullopt;
  if (!clip_axis(a.y, b.y - a.y, box.min.y, box.max.y, u0, u1)) return std::nullopt;
  const Point2 from = u0 > 0 ? core::mix(a, b, u0) : a;
  const Point2 to = u1 < 1 ? core::mix(a, b, u1) : b;
  return std::pair{from, to};
}

}  // namespace

std::vector<std::vector<Point2>> clip_to_box(std::span<const Point2> points, const Box& box) {
  std::vector<std::vector<Point2>> runs;
  bool open = false;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Point2 a = points[i - 1];
    const Point2 b = points[i];
    const auto part =
        core::is_finite(a) && core::is_finite(b) ? clip_line(a, b, box) : std::nullopt;
    if (!part) {
      open = false;
      continue;
    }
    if (!open || part->first != a) runs.push_back({part->first});
    runs.back().push_back(part->second);
    open = part->second == b;
  }
  return runs;
}

namespace {

double distance_to_segment(Point2 p, Point2 a, Point2 b) {
  const core::Vector2 d = b - a;
  const double square = dot(d, d);
  const double u = square > 0 ? std::clamp(dot(p - a, d) / square, 0.0, 1.0) : 0;
  return core::distance(p, core::mix(a, b, u));
}

}  // namespace

std::vector<Point2> simplify(std::span<const Point2> points, double tolerance) {
  if (points.size() < 3) return {points.begin(), points.end()};
  std::vector<char> keep(points.size(), 0);
  keep.front() = keep.back() = 1;
  std::vector<std::pair<std::size_t, std::size_t>> open{{0, points.size() - 1}};
  while (!open.empty()) {
    const auto [first, last] = open.back();
    open.pop_back();
    std::size_t worst = first;
    double largest = tolerance;
    for (std::size_t i = first + 1; i < last; ++i) {
      const double d = distance_to_segment(points[i], points[first], points[last]);
      if (d > largest) {
        largest = d;
        worst = i;
      }
    }
    if (worst == first) continue;
    keep[worst] = 1;
    open.push_back({first, worst});
    open.push_back({worst, last});
  }
  std::vector<Point2> kept;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (keep[i]) kept.push_back(points[i]);
  return kept;
}

Path finite_part(const Path& path) {
  Path clean;
  bool pen_down = false;
  for (PathStep step : path.steps) {
    if (step.verb == PathVerb::close) {
      if (pen_down) clean.close();
      continue;
    }
    const auto& p = step.point;
    if (!core::is_finite(p[2])) {
      pen_down = false;
      continue;
    }
    const bool handles = core::is_finite(p[0]) && core::is_finite(p[1]);
    if (!pen_down) step = {PathVerb::move, {p[2], p[2], p[2]}};
    if (step.verb == PathVerb::cubic && !handles) step.verb = PathVerb::line;
    clean.steps.push_back(step);
    pen_down = true;
  }
  return clean;
}

}  // namespace keyline::figure
