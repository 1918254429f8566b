#include "keyline/exchange/occt/conic.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace keyline::exchange::occt {
namespace {

using core::Point2;
using core::Vector2;

/// The conic in the frame about the same origin whose first axis is x.
Conic turned(const Conic& q, Vector2 x) {
  return {q.a * x.x * x.x + q.b * x.x * x.y + q.c * x.y * x.y,
          2 * (q.c - q.a) * x.x * x.y + q.b * (x.x * x.x - x.y * x.y),
          q.a * x.y * x.y - q.b * x.x * x.y + q.c * x.x * x.x,
          q.d * x.x + q.e * x.y,
          q.e * x.x - q.d * x.y,
          q.f};
}

Vector2 quarter_turn(Vector2 x) { return {-x.y, x.x}; }

/// The direction in which a x^2 + b x y + c y^2 is least; half the angle of (c - a, -b), without
/// cancellation.
Vector2 least_axis(const Conic& q) {
  const double length = std::hypot(q.c - q.a, q.b);
  if (length == 0) return {1, 0};
  const double cosine = (q.c - q.a) / length;
  const double sine = -q.b / length;
  const double longer = std::sqrt((1 + std::abs(cosine)) / 2);
  const double shorter = sine / (2 * longer);
  return cosine >= 0 ? Vector2{longer, shorter} : Vector2{shorter, longer};
}

/// y^2 = 4 f x, from c y^2 + d x + e y + f = 0.
std::optional<StandardConic> parabola(const Conic& given, Vector2 x) {
  Conic q = turned(given, x);
  if (q.d / q.c > 0) q = turned(given, x = -x);
  const double y = -q.e / (2 * q.c);
  const Point2 apex{(q.c * y * y - q.f) / q.d, y};
  const Point2 origin = Point2{} + apex.x * x + apex.y * quarter_turn(x);
  if (q.d == 0 || !std::isfinite(origin.x) || !std::isfinite(origin.y)) return {};
  return StandardConic{{0, 0, 1, q.d / q.c, 0, 0}, x, quarter_turn(x), origin};
}

/// (x / m)^2 +- (y / n)^2 = 1, times m n.
std::optional<StandardConic> central(const Conic& given, ConicKind kind, Vector2 x, Point2 first) {
  Conic q = turned(given, x);
  const auto middle = [&q] { return Vector2{-q.d / (2 * q.a), -q.e / (2 * q.c)}; };
  // a x^2 + c y^2 = right from there
  const auto right = [&] {
    return q.a * middle().x * middle().x + q.c * middle().y * middle().y - q.f;
  };
  if (kind == ConicKind::hyperbola && right() / q.a < 0) q = turned(given, x = quarter_turn(x));
  const double m = std::sqrt(right() / q.a);
  const double n = std::sqrt(std::abs(right() / q.c));
  if (!(m > 0 && n > 0 && std::isfinite(m / n) && std::isfinite(n / m))) return {};
  if ((q.a * q.c > 0) != (kind == ConicKind::ellipse)) return {};
  const double side = kind == ConicKind::ellipse ? 1 : -1;
  StandardConic made{{n / m, 0, side * m / n, 0, 0, -m * n},
                     x,
                     quarter_turn(x),
                     Point2{} + middle().x * x + middle().y * quarter_turn(x)};
  if (side < 0 && made.local(first).x < 0) std::tie(made.x, made.y) = std::pair(-made.x, -made.y);
  return made;
}

}  // namespace

ConicKind kind_of(const Conic& q) {
  const double product = 4 * q.a * q.c;
  const double difference = q.b * q.b - product;
  constexpr double kRounding = 8 * std::numeric_limits<double>::epsilon();
  if (std::abs(difference) <= kRounding * std::max(q.b * q.b, std::abs(product)))
    return ConicKind::parabola;
  return difference < 0 ? ConicKind::ellipse : ConicKind::hyperbola;
}

std::optional<StandardConic> standard_conic(const Conic& conic, ConicKind kind, Point2 first,
                                            Point2 last) {
  Conic q = conic;
  if (q.a + q.c < 0) q = {-q.a, -q.b, -q.c, -q.d, -q.e, -q.f};
  const Vector2 x = least_axis(q);
  auto made = kind == ConicKind::parabola ? parabola(q, x) : central(q, kind, x, first);
  if (made && kind != ConicKind::ellipse && made->local(first).y > made->local(last).y)
    made->y = -made->y;
  return made;
}

}  // namespace keyline::exchange::occt
