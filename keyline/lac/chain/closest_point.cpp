#include "keyline/lac/chain/closest_point.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "keyline/core/angle.h"
#include "keyline/numeric/newton_bracket.h"

namespace keyline::lac {
namespace {

using core::Point2;
using core::Vector2;
using curve::ClosestPoint;

constexpr int kHalvings = 20;
constexpr int kMostHalvings = 2000;  ///< of one search: near the centre of a near circle all tie

struct End {
  double t = 0;
  Point2 point;
  double distance = 0;
};

/// Searches a segment for points nearer than the best so far.
class Search {
 public:
  Search(const Segment& segment, Point2 p, double best) : segment_(segment), p_(p) {
    found_.distance = best;
  }

  void run();
  bool improved() const { return improved_; }
  const ClosestPoint& found() const { return found_; }

 private:
  End end_at(double t) const {
    const Point2 point = evaluate(segment_, t);
    return {t, point, distance(point, p_)};
  }
  void offer(const End& end) {
    if (!(end.distance < found_.distance)) return;
    found_ = {end.t, end.point, end.distance};
    improved_ = true;
  }
  /// Half the derivative of the squared distance by arc length, and its own derivative.
  struct Slope {
    double value, rate;
  };
  Slope slope_at(const End& end) const {
    const Vector2 tangent = core::unit_vector(tangent_angle(segment_, end.t));
    const Vector2 away = end.point - p_;
    const double k = curvature(segment_, end.t);
    return {dot(away, tangent), 1 + k * dot(away, core::perpendicular_left(tangent))};
  }
  enum class Bend { convex, concave, unknown };
  Bend bend_of(const End& a, const End& b) const;
  void look(const End& a, const End& b, int halvings);
  void refine(End low, End high);

  const Segment& segment_;
  Point2 p_;
  ClosestPoint found_;
  bool improved_ = false;
  int halved_ = 0;
};

void Search::run() {
  const double turned = std::abs(total_turning(segment_));
  const int steps = static_cast<int>(std::min(2000.0, 8 + 4 * turned));
  const auto points = sample(segment_, steps + 1);
  std::vector<End> ends;
  for (int i = 0; i <= steps; ++i) {
    ends.push_back({double(i) / steps, points[i], distance(points[i], p_)});
    offer(ends.back());
  }
  for (int i = 0; i < steps; ++i) look(ends[i], ends[i + 1], kHalvings);
}

/// How the squared distance bends on a stretch: its second derivative at the ends, less or plus
/// what it can change by in between.
Search::Bend Search::bend_of(const End& a, const End& b) const {
  const double length = (b.t - a.t) * segment_.length;
  const double farthest = (a.distance + b.distance + length) / 2;
  const double k = std::max(std::abs(curvature(segment_, a.t)), std::abs(curvature(segment_, b.t)));
  if (k * farthest < 1) return Bend::convex;
  const Slope s0 = slope_at(a);
  const Slope s1 = slope_at(b);
  const double change =
      std::max(std::abs(curvature_rate(segment_, a.t)), std::abs(curvature_rate(segment_, b.t)));
  const double lean = std::min(
      farthest, std::max(std::abs(s0.value), std::abs(s1.value)) + length * (1 + k * farthest));
  const double most = length * (change * farthest + k * k * lean);
  if (std::min(s0.rate, s1.rate) > most) return Bend::convex;
  return std::max(s0.rate, s1.rate) < -most ? Bend::concave : Bend::unknown;
}

void Search::look(const End& a, const End& b, int halvings) {
  const double length = (b.t - a.t) * segment_.length;
  if ((a.distance + b.distance - length) / 2 >= found_.distance) return;
  const Bend bend = bend_of(a, b);
  if (bend == Bend::concave) return;  // an end is the nearest
  if (bend == Bend::convex || halvings == 0 || halved_ > kMostHalvings) {
    refine(a, b);
    return;
  }
  ++halved_;
  const End middle = end_at(0.5 * (a.t + b.t));
  offer(middle);
  look(a, middle, halvings - 1);
  look(middle, b, halvings - 1);
}

/// Newton's method for the zero of the slope between two ends.
void Search::refine(End low, End high) {
  if (slope_at(low).value >= 0 || slope_at(high).value <= 0) return;  // an end is the nearest
  numeric::NewtonBracket between{low.t, high.t};
  End at = end_at(0.5 * (low.t + high.t));
  offer(at);
  for (int i = 0; i < 60; ++i) {
    const Slope slope = slope_at(at);
    const double next = between.next(at.t, slope.value, slope.rate * segment_.length);
    const double step = std::abs(next - at.t);
    at = end_at(next);
    offer(at);
    if (step < 1e-15) break;
  }
}

}  // namespace

ClosestPoint closest_point(const Segment& segment, Point2 p) {
  Search search(segment, p, INFINITY);
  search.run();
  return search.found();
}

ClosestPoint closest_point(const Chain& chain, Point2 p) {
  const auto placed = segments(chain);
  const double whole = arc_length(chain);
  ClosestPoint best{0, chain.start.position, distance(chain.start.position, p)};
  double before = 0;
  for (const Segment& s : placed) {
    if (distance(s.start.position, p) - s.length < best.distance) {
      Search search(s, p, best.distance);
      search.run();
      if (search.improved()) {
        best = search.found();
        best.t = (before + best.t * s.length) / whole;
      }
    }
    before += s.length;
  }
  return best;
}

}  // namespace keyline::lac
