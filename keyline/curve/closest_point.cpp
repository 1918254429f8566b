#include "keyline/curve/closest_point.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "keyline/curve/bernstein.h"
#include "keyline/curve/bounding_box.h"
#include "keyline/numeric/newton_bracket.h"

namespace keyline::curve {

using core::Point2;
using core::Vector2;
using detail::Coefficients;
using detail::combination;
using detail::derivative;
using detail::product;

namespace {

constexpr ClosestPoint kNone{0, {}, std::numeric_limits<double>::infinity()};

template <class C>
void consider(const C& c, Point2 p, double t, ClosestPoint& best) {
  const Point2 q = evaluate(c, t);
  const double d = distance(p, q);
  if (d < best.distance) best = {t, q, d};
}

/// Stationary point of the distance between low and high, by Newton's method kept inside.
template <class C>
double stationary_point(const C& c, Point2 p, double low, double high) {
  numeric::NewtonBracket between{low, high};
  double t = 0.5 * (low + high);
  for (int step = 0; step < 80 && between.low < between.high; ++step) {
    const Jet2 j = jet(c, t);
    const Vector2 offset = j.point - p;
    const double slope = dot(offset, j.first);
    if (slope == 0) break;
    const double bend = dot(j.first, j.first) + dot(offset, j.second);
    const double next = between.next(t, slope, bend);
    if (next == t) break;
    t = next;
  }
  return t;
}

/// Squared distance from p times the squared weight function, and the derivative of the plain
/// squared distance up to a positive factor, both as plain Bernstein coefficients.
struct DistanceForm {
  Coefficients<double> value, slope;
};

DistanceForm distance_form(const Bezier2& c, Point2 p) {
  Coefficients<double> x, y, w;
  for (std::size_t i = 0; i < c.control.size(); ++i) {
    const double weight = is_rational(c) ? c.weights[i] : 1.0;
    x.push_back(weight * (c.control[i].x - p.x));
    y.push_back(weight * (c.control[i].y - p.y));
    w.push_back(weight);
  }
  x = detail::scaled(x);
  y = detail::scaled(y);
  const auto value = combination(product(x, x), 1, product(y, y));
  auto slope = derivative(value);
  if (is_rational(c)) {
    w = detail::scaled(w);
    slope = combination(product(slope, w), -2, product(value, derivative(w)));
  }
  return {detail::unscaled(value), detail::unscaled(slope)};
}

class BezierSearch {
 public:
  BezierSearch(const Bezier2& c, Point2 p, ClosestPoint& best) : c_(c), p_(p), best_(best) {
    consider(c, p, 0, best);
    consider(c, p, 1, best);
    const DistanceForm form = distance_form(c, p);
    weight_ = is_rational(c) ? *std::max_element(c.weights.begin(), c.weights.end()) : 1.0;
    search(form.value, form.slope, 0, 1, 0);
  }

 private:
  void search(const Coefficients<double>& value, const Coefficients<double>& slope, double low,
              double width, int depth) {
    const double bound = *std::min_element(value.begin(), value.end()) / (weight_ * weight_);
    const double nearest = best_.distance * best_.distance;
    if (bound > nearest * (1 - 1e-14)) return;
    const bool falls = std::any_of(slope.begin(), slope.end(), [](double x) { return x < 0; });
    const bool rises = std::any_of(slope.begin(), slope.end(), [](double x) { return x > 0; });
    if (!(falls && rises)) return;  // monotone: the ends are known
    const double high = low + width;
    if (single_minimum(slope) || depth >= 44) {
      consider(c_, p_, stationary_point(c_, p_, low, high), best_);
      return;
    }
    const double middle = low + 0.5 * width;
    consider(c_, p_, middle, best_);
    const auto v = detail::halves(value);
    const auto s = detail::halves(slope);
    search(v.left, s.left, low, 0.5 * width, depth + 1);
    search(v.right, s.right, middle, 0.5 * width, depth + 1);
  }

  /// Falling, then rising: exactly one stationary point, and it is a minimum.
  static bool single_minimum(const Coefficients<double>& slope) {
    if (!(slope.front() < 0 && slope.back() > 0)) return false;
    const auto first = std::find_if(slope.begin(), slope.end(), [](double x) { return x >= 0; });
    return std::all_of(first, slope.end(), [](double x) { return x >= 0; });
  }

  const Bezier2& c_;
  Point2 p_;
  ClosestPoint& best_;
  double weight_ = 1;
};

/// Whether the control polygon's box leaves room for a point nearer than `nearest`.
bool may_be_nearer(const Bezier2& c, Point2 p, double nearest) {
  Box2 hull{c.control.front(), c.control.front()};
  for (const Point2 q : c.control) hull = united(hull, q);
  return distance(hull, p) <= nearest;
}

}  // namespace

ClosestPoint closest_point(const Bezier2& c, Point2 p) {
  ClosestPoint best = kNone;
  BezierSearch(c, p, best);
  return best;
}

namespace {

/// Nearest point of the pieces, piece i standing for [breaks[i], breaks[i+1]].
ClosestPoint closest_of(const std::vector<Bezier2>& pieces, const std::vector<double>& breaks,
                        Point2 p) {
  ClosestPoint best = kNone;
  std::size_t winner = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {  // ends first: they prune most pieces
    for (const double t : {0.0, 1.0}) {
      const double before = best.distance;
      consider(pieces[i], p, t, best);
      if (best.distance < before) winner = i;
    }
  }
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (!may_be_nearer(pieces[i], p, best.distance)) continue;
    const double before = best.distance;
    BezierSearch(pieces[i], p, best);
    if (best.distance < before) winner = i;
  }
  best.t = (1 - best.t) * breaks[winner] + best.t * breaks[winner + 1];
  return best;
}

}  // namespace

ClosestPoint closest_point(const PiecewiseBezier& c, Point2 p) {
  return closest_of(c.pieces, breakpoints(c), p);
}

ClosestPoint closest_point(const BSpline2& c, Point2 p) {
  const auto pieces = to_beziers(c);
  const auto breaks = breakpoints(c);
  if (breaks.size() == pieces.size() + 1) return closest_of(pieces, breaks, p);
  return closest_point(PlanarView(c), p);  // knots too close for the parameter to tell apart
}

ClosestPoint closest_point(const Polyline2& c, Point2 p) {
  if (c.points.size() < 2) throw core::InvalidInput("Polyline: fewer than two points");
  const double edges = static_cast<double>(c.points.size() - 1);
  ClosestPoint best = kNone;
  for (std::size_t i = 0; i + 1 < c.points.size(); ++i) {
    const Vector2 edge = c.points[i + 1] - c.points[i];
    const double size = norm(edge);
    const double u =
        size > 0 ? std::clamp(dot((p - c.points[i]) / size, edge / size), 0.0, 1.0) : 0.0;
    const Point2 q = mix(c.points[i], c.points[i + 1], u);
    const double d = distance(p, q);
    if (d < best.distance) best = {(static_cast<double>(i) + u) / edges, q, d};
  }
  return best;
}

namespace {

class ViewSearch {
 public:
  ViewSearch(const PlanarView& c, Point2 p, ClosestPoint& best) : c_(c), p_(p), best_(best) {}

  void stretch(double low, double high) {
    constexpr int kParts = 16;
    std::array<End, kParts + 1> ends;
    for (int k = 0; k <= kParts; ++k)
      ends[k] = end_at(k == kParts ? std::nextafter(high, low) : low + (high - low) * k / kParts);
    for (int k = 0; k < kParts; ++k) visit(ends[k], ends[k + 1], 0);
  }

 private:
  static constexpr int kDepth = 4;     ///< of halvings, everywhere
  static constexpr int kDeepest = 60;  ///< where the tangent turns between two ends

  struct End {
    double t, distance, speed, slope;
    Vector2 tangent;
  };

  /// By more than half a radian: what lies between may come near and leave again.
  static bool turns(const End& a, const End& b) {
    return dot(a.tangent, b.tangent) < 0.88 * a.speed * b.speed;
  }

  End end_at(double t) {
    const Jet2 j = c_.jet_at(t);
    const double d = distance(j.point, p_);
    if (d < best_.distance) best_ = {t, j.point, d};
    return {t, d, speed(j), dot(j.point - p_, j.first), j.first};
  }

  void visit(const End& a, const End& b, int depth) {
    const double middle = 0.5 * (a.t + b.t);
    const End m = end_at(middle);
    const double length = 1.25 / 6 * (b.t - a.t) * (a.speed + 4 * m.speed + b.speed);
    if (0.5 * (a.distance + b.distance - length) > best_.distance) return;
    if (depth < kDepth || (depth < kDeepest && (turns(a, m) || turns(m, b)))) {
      visit(a, m, depth + 1);
      visit(m, b, depth + 1);
      return;
    }
    if (a.slope < 0 && m.slope >= 0) consider(c_, p_, stationary_point(c_, p_, a.t, m.t), best_);
    if (m.slope < 0 && b.slope >= 0) consider(c_, p_, stationary_point(c_, p_, m.t, b.t), best_);
  }

  const PlanarView& c_;
  Point2 p_;
  ClosestPoint& best_;
};

}  // namespace

ClosestPoint closest_point(const PlanarView& c, Point2 p) {
  ClosestPoint best = kNone;
  const auto& breaks = c.breaks();
  for (const double b : breaks) consider(c, p, b, best);
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i)
    ViewSearch(c, p, best).stretch(breaks[i], breaks[i + 1]);
  return best;
}

}  // namespace keyline::curve
