#include "keyline/curve/bounding_box.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "keyline/curve/bernstein.h"
#include "keyline/numeric/roots.h"

namespace keyline::curve {

using core::Point2;
using core::Vector2;
using detail::Coefficients;
using detail::combination;
using detail::derivative;
using detail::product;

double distance(const Box2& b, core::Point2 p) {
  const double dx = std::max({b.low.x - p.x, p.x - b.high.x, 0.0});
  const double dy = std::max({b.low.y - p.y, p.y - b.high.y, 0.0});
  return std::hypot(dx, dy);
}

Box2 united(const Box2& a, const Box2& b) {
  return {{std::min(a.low.x, b.low.x), std::min(a.low.y, b.low.y)},
          {std::max(a.high.x, b.high.x), std::max(a.high.y, b.high.y)}};
}

Box2 united(const Box2& a, Point2 p) { return united(a, Box2{p, p}); }

namespace {

/// Where the coordinate picked by `pick` has its extrema.
template <class Pick>
std::vector<double> extrema(const Bezier2& c, Pick pick) {
  Coefficients<double> x;
  for (const Point2& p : c.control) x.push_back(pick(p) - pick(c.control.front()));
  if (!is_rational(c)) {
    Coefficients<double> slope;
    for (std::size_t i = 0; i + 1 < x.size(); ++i) slope.push_back(x[i + 1] - x[i]);
    return detail::roots_in_unit(slope);
  }
  for (std::size_t i = 0; i < x.size(); ++i) x[i] *= c.weights[i];
  const auto a = detail::scaled(x);
  const auto w = detail::scaled(Coefficients<double>(c.weights));
  const auto numerator = combination(product(derivative(a), w), -1, product(a, derivative(w)));
  return detail::roots_in_unit(detail::unscaled(numerator));
}

Box2 around(std::span<const Point2> points) {
  Box2 box{points.front(), points.front()};
  for (const Point2& p : points) box = united(box, p);
  return box;
}

template <class Pick>
void add_extrema(const PlanarView& c, double low, double high, Pick pick, Box2& box) {
  constexpr int kParts = 32;
  double before = low;
  const auto velocity_at = [&](double t) { return pick(c.jet_at(t).first); };
  double velocity = velocity_at(low);
  for (int i = 1; i <= kParts; ++i) {
    const double t = i < kParts ? low + (high - low) * i / kParts : std::nextafter(high, low);
    const double next = velocity_at(t);
    if ((velocity > 0) != (next > 0))
      if (const auto still = numeric::bracketed_root(velocity_at, before, t, 0))
        box = united(box, c.point(*still));
    before = t;
    velocity = next;
  }
}

}  // namespace

Box2 bounding_box(const Bezier2& c) {
  const Point2 start = evaluate(c, 0);
  const Box2 ends = united(Box2{start, start}, evaluate(c, 1));
  Box2 box = ends;
  for (const double t : extrema(c, [](Point2 p) { return p.x; })) box = united(box, evaluate(c, t));
  for (const double t : extrema(c, [](Point2 p) { return p.y; })) box = united(box, evaluate(c, t));
  return box;
}

Box2 bounding_box(const PiecewiseBezier& c) {
  const Point2 start = evaluate(c, 0);
  Box2 box{start, start};
  for (const Bezier2& piece : c.pieces) box = united(box, bounding_box(piece));
  return box;
}

Box2 bounding_box(const BSpline2& c) { return bounding_box(PiecewiseBezier{to_beziers(c), 0}); }

Box2 bounding_box(const Polyline2& c) {
  if (c.points.empty()) throw core::InvalidInput("Polyline: fewer than two points");
  return around(c.points);
}

Box2 bounding_box(const PlanarView& c) {
  const Point2 start = c.point(0);
  Box2 box{start, start};
  const auto& breaks = c.breaks();
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    box = united(box, c.point(std::nextafter(breaks[i + 1], 0)));
    box = united(box, c.point(breaks[i + 1]));
    add_extrema(c, breaks[i], breaks[i + 1], [](Vector2 v) { return v.x; }, box);
    add_extrema(c, breaks[i], breaks[i + 1], [](Vector2 v) { return v.y; }, box);
  }
  return box;
}

}  // namespace keyline::curve
