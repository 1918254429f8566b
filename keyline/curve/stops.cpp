#include "keyline/curve/stops.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "keyline/core/interval.h"
#include "keyline/curve/bernstein.h"
#include "keyline/curve/bezier_ends.h"

namespace keyline::curve {
namespace {

using core::Vector2;
using detail::Coefficients;

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

/// The derivative, of a rational curve its numerator, in plain Bernstein coefficients.
struct Hodograph {
  Coefficients<double> x, y;
  double rounding = 0;  ///< a coefficient below it is zero
  double size = 0;      ///< largest coefficient

  Vector2 at(std::size_t i) const { return {x[i], y[i]}; }
  std::size_t count() const { return x.size(); }
};

double largest(const std::vector<double>& values) {
  double most = 0;
  for (const double v : values) most = std::max(most, std::abs(v));
  return most;
}

Hodograph hodograph(const Bezier2& c) {
  constexpr double kRoundings = 8;  // of a coordinate, that make up an edge of no length
  std::vector<double> x, y;
  double reach = 0;
  for (const core::Point2& p : c.control) {
    reach = std::max({reach, std::abs(p.x), std::abs(p.y)});
    x.push_back(p.x - c.control.front().x);
    y.push_back(p.y - c.control.front().y);
  }
  const double weight = is_rational(c) ? largest(c.weights) : 1;
  for (std::size_t i = 0; i < x.size() && is_rational(c); ++i) {
    x[i] *= c.weights[i] / weight;
    y[i] *= c.weights[i] / weight;
  }
  x = detail::scaled(x);
  y = detail::scaled(y);
  Hodograph h;
  if (is_rational(c)) {
    std::vector<double> w = c.weights;
    for (double& each : w) each /= weight;
    w = detail::scaled(w);
    const auto dw = detail::derivative(w);
    const auto numerator = [&](const Coefficients<double>& of) {
      return detail::unscaled(detail::combination(detail::product(detail::derivative(of), w), -1,
                                                  detail::product(of, dw)));
    };
    h.x = numerator(x);
    h.y = numerator(y);
  } else {
    h.x = detail::unscaled(detail::derivative(x));
    h.y = detail::unscaled(detail::derivative(y));
  }
  h.rounding = kRoundings * kEpsilon * degree(c) * reach;
  h.size = std::max(largest(h.x), largest(h.y));
  return h;
}

/// The part of [0, 1] up to t, and the rest.
std::pair<Hodograph, Hodograph> parted(const Hodograph& h, double t) {
  Hodograph left = h, right = h;
  const auto part = [t](Coefficients<double> b, Coefficients<double>& low,
                        Coefficients<double>& high) {
    const std::size_t n = b.size() - 1;
    for (std::size_t level = 0; level <= n; ++level) {
      low[level] = b[0];
      high[n - level] = b[n - level];
      for (std::size_t i = 0; i + level < n; ++i) b[i] = std::lerp(b[i], b[i + 1], t);
    }
  };
  part(h.x, left.x, right.x);
  part(h.y, left.y, right.y);
  return {left, right};
}

/// h / (t^first (1 - t)^last), of which that many coefficients at its ends are zero.
Hodograph without_ends(const Hodograph& h, std::size_t first, std::size_t last) {
  const auto all = detail::binomials<double>(h.count() - 1);
  const auto own = detail::binomials<double>(h.count() - 1 - first - last);
  Hodograph rest = h;
  rest.x.clear();
  rest.y.clear();
  for (std::size_t i = 0; i < own.size(); ++i) {
    rest.x.push_back(all[i + first] / own[i] * h.x[i + first]);
    rest.y.push_back(all[i + first] / own[i] * h.y[i + first]);
  }
  return rest;
}

/// Taylor coefficients at 0: C(d, j) times the j-th forward difference.
std::vector<Vector2> taylor(const Hodograph& h) {
  const auto factors = detail::binomials<double>(h.count() - 1);
  std::vector<Vector2> differences, found;
  for (std::size_t i = 0; i < h.count(); ++i) differences.push_back(h.at(i));
  for (std::size_t j = 0; j < h.count(); ++j) {
    found.push_back(factors[j] * differences[0]);
    for (std::size_t i = 0; i + 1 + j < h.count(); ++i)
      differences[i] = differences[i + 1] - differences[i];
  }
  return found;
}

/// Coefficients at the start that are zero.
std::size_t zeros_of(const Hodograph& h) {
  std::size_t order = 0;
  while (order < h.count() && norm(h.at(order)) <= h.rounding) ++order;
  return order;
}

/// What points with growing t see of a stop at 0, if there is one.
std::optional<StopSide> leaving(const Hodograph& h, double weight) {
  constexpr double kParallel = 1e-12;  // sine of an angle that is none
  const std::size_t order = zeros_of(h);
  if (order == 0 || order == h.count()) return std::nullopt;
  const std::vector<Vector2> c = taylor(without_ends(h, order, 0));
  const double length = norm(c[0]);
  const Vector2 along = c[0] / length;
  double most = 0;
  for (const Vector2& each : c) most = std::max(most, norm(each));
  StopSide side{along, 0};
  for (std::size_t k = 1; k < c.size(); ++k) {
    const double aside = cross(along, c[k]);
    if (std::abs(aside) <= kParallel * most) continue;
    if (k <= order)
      side.curvature = std::copysign(std::numeric_limits<double>::infinity(), aside);
    else if (k == order + 1)
      side.curvature = static_cast<double>(k) * aside / (length * length) * weight * weight;
    break;
  }
  return side;
}

Hodograph reversed(Hodograph h) {
  for (auto* b : {&h.x, &h.y}) {
    std::ranges::reverse(*b);
    for (double& each : *b) each = -each;
  }
  return h;
}

/// The same of points that come from the left to a stop at 1.
std::optional<StopSide> arriving(const Hodograph& h, double weight) {
  auto side = leaving(reversed(h), weight);
  if (side) *side = {-side->tangent, -side->curvature};
  return side;
}

/// Ranges of parameters in which the derivative comes to zero: parts whose coefficients leave it
/// out are left out.
void find_inside(const Hodograph& h, core::Interval t, int depth,
                 std::vector<core::Interval>& found) {
  constexpr int kDepth = 48;
  constexpr double kApart = 1e-6;
  const auto [x0, x1] = std::ranges::minmax(h.x);
  const auto [y0, y1] = std::ranges::minmax(h.y);
  if (std::max(x0, y0) > h.rounding || std::min(x1, y1) < -h.rounding) return;
  const bool still = std::min(x0, y0) >= -h.rounding && std::max(x1, y1) <= h.rounding;
  if (still || depth == kDepth) {
    if (!found.empty() && t.low - found.back().high < kApart)
      found.back().high = t.high;
    else
      found.push_back(t);
    return;
  }
  const auto [left, right] = parted(h, 0.5);
  const double middle = 0.5 * (t.low + t.high);
  find_inside(left, {t.low, middle}, depth + 1, found);
  find_inside(right, {middle, t.high}, depth + 1, found);
}

std::vector<double> places_inside(const Hodograph& h) {
  std::vector<core::Interval> ranges;
  const std::size_t first = zeros_of(h);
  if (first == h.count()) return {};
  find_inside(without_ends(h, first, zeros_of(reversed(h))), {0, 1}, 0, ranges);
  std::vector<double> places;
  for (const core::Interval& t : ranges)
    if (t.low > 0 && t.high < 1) places.push_back(0.5 * (t.low + t.high));
  return places;
}

double weight_at(const Bezier2& c, double t) {
  if (!is_rational(c)) return 1;
  return detail::value_at(c.weights, t) / largest(c.weights);
}

Stop stop_inside(const Bezier2& c, const Hodograph& h, double t) {
  auto [left, right] = parted(h, t);
  left.x.back() = left.y.back() = right.x.front() = right.y.front() = 0;
  return {t, arriving(left, weight_at(c, t)), leaving(right, weight_at(c, t))};
}

}  // namespace

std::vector<Stop> stops_of(const Bezier2& c) {
  const Hodograph h = hodograph(c);
  if (!(h.size > h.rounding)) return {};
  std::vector<Stop> stops;
  if (auto side = leaving(h, weight_at(c, 0))) stops.push_back({0, std::nullopt, side});
  for (const double t : places_inside(h)) stops.push_back(stop_inside(c, h, t));
  if (auto side = arriving(h, weight_at(c, 1))) stops.push_back({1, side, std::nullopt});
  return stops;
}

std::vector<Stop> stops_of(const BSpline2& c) {
  const std::vector<double> breaks = bezier_ends(c);
  const std::vector<Bezier2> pieces = to_beziers(c);
  std::vector<Stop> stops;
  for (std::size_t i = 0; i < pieces.size(); ++i)
    for (Stop stop : stops_of(pieces[i])) {
      stop.t = stop.t == 1 ? breaks[i + 1] : std::lerp(breaks[i], breaks[i + 1], stop.t);
      if (!stops.empty() && stops.back().t == stop.t)
        stops.back().after = stop.after;
      else
        stops.push_back(stop);
    }
  return stops;
}

}  // namespace keyline::curve
