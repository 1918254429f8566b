#include "keyline/classa/control_matrix.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <string>

#include "keyline/core/angle.h"
#include "keyline/core/coordinate.h"
#include "keyline/curve/least_edge.h"
#include "keyline/numeric/newton_bracket.h"
#include "keyline/numeric/roots.h"

namespace keyline::classa {

using core::ErrorCode;
using core::fail;
using core::Point2;
using core::Vector2;
using Complex = std::complex<double>;

bool is_class_a(const ControlMatrix& m, double slack) {
  const double c = std::cos(m.alpha);
  return c > 0 && m.s > 0 && (m.s >= 1 / c - slack || m.s <= c + slack);
}

double plane_distance(const ControlMatrix& a, const ControlMatrix& b) {
  return std::hypot(std::abs(a.alpha) - std::abs(b.alpha), a.s - b.s);
}

core::Result<void> validate(const MatrixCurve& c) {
  if (!is_finite(c.start))
    return fail(ErrorCode::bad_input, "the start is not finite", {}, "start");
  if (!is_finite(c.tangent) || norm(c.tangent) == 0 || !std::isfinite(norm(c.tangent)))
    return fail(ErrorCode::bad_input, "the tangent has no direction",
                "give a finite vector that is not zero", "tangent");
  if (!(std::isfinite(c.beta) && c.beta > 0))
    return fail(ErrorCode::bad_input, "beta has to be positive", {}, "beta");
  if (!(std::abs(c.matrix.alpha) < core::kPi))
    return fail(ErrorCode::bad_input, "alpha has to lie between -pi and pi", {}, "alpha");
  if (!(std::isfinite(c.matrix.s) && c.matrix.s > 0))
    return fail(ErrorCode::bad_input, "s has to be positive", {}, "s");
  if (c.degree < 1 || c.degree > curve::kMaxBezierDegree)
    return fail(ErrorCode::bad_input,
                "the degree has to lie between 1 and " + std::to_string(curve::kMaxBezierDegree),
                {}, "degree");
  if (core::is_too_large(c.beta * norm(c.tangent) *
                         std::pow(std::max(1.0, c.matrix.s), c.degree - 1)) ||
      !std::isfinite(std::pow(c.matrix.s, c.degree)))
    return fail(ErrorCode::bad_input, "an edge is longer than 1e100",
                "give a smaller scale or degree", "s");
  return {};
}

curve::Bezier2 to_bezier(const MatrixCurve& c) {
  curve::Bezier2 bezier;
  bezier.control.push_back(c.start);
  Vector2 edge = c.beta * c.tangent;
  for (int i = 0; i < c.degree; ++i) {
    bezier.control.push_back(bezier.control.back() + edge);
    edge = c.matrix.s * core::rotate_ccw(edge, c.matrix.alpha);
  }
  return bezier;
}

Vector2 end_in_frame(const ControlMatrix& m, int degree) {
  const Complex z = std::polar(m.s, m.alpha);
  Complex sum = 0;
  for (int i = 0; i < degree; ++i) sum = sum * z + 1.0;
  return {sum.real(), sum.imag()};
}

double end_angle(const ControlMatrix& m, int degree) {
  if ((degree - 1) * std::abs(m.alpha) <= core::kPi)
    return core::direction_of(end_in_frame(m, degree));
  // (z^n - 1)/(z - 1) with the powers taken out that turn more than half way round.
  if (m.s <= 1) {
    return std::arg(1.0 - std::polar(std::pow(m.s, degree), degree * m.alpha)) -
           std::arg(1.0 - std::polar(m.s, m.alpha));
  }
  return (degree - 1) * m.alpha +
         std::arg(1.0 - std::polar(std::pow(m.s, -degree), -degree * m.alpha)) -
         std::arg(1.0 - std::polar(1 / m.s, -m.alpha));
}

namespace {

/// Zero of the polynomial with the n coefficients c (highest last), which rises through it between
/// low and high: Newton's method, halving where it leaves the bracket.
double rising_root(const double* c, int n, double low, double high) {
  numeric::NewtonBracket between{low, high};
  double x = low;
  for (int iteration = 0; iteration < 100; ++iteration) {
    double value = 0;
    double slope = 0;
    for (int i = n - 1; i >= 0; --i) {
      slope = slope * x + value;
      value = value * x + c[i];
    }
    if (value == 0) return x;
    const double next = between.next(x, value, slope);
    if (std::abs(next - x) <= 2e-16 * x) return next;
    x = next;
  }
  return x;
}

}  // namespace

double scale_at_end_angle(double alpha, double angle, int degree, const core::Interval& s) {
  if (!(s.low < s.high)) return s.low;
  if ((degree - 1) * alpha > core::kPi) {  // winding: the angle itself tells the turns apart
    const auto f = [&](double x) { return end_angle({alpha, std::exp(x)}, degree) - angle; };
    if (f(std::log(s.high)) <= 0) return s.high;
    const auto root = numeric::bracketed_root(f, std::log(s.low), std::log(s.high), 1e-16);
    return std::exp(root.value_or(std::log(s.low)));
  }
  if (angle <= 0) return s.low;
  if (angle >= (degree - 1) * alpha) return s.high;
  // The part of 1 + z + … + z^(n-1) across the angle, by powers of s.
  std::array<double, curve::kMaxBezierDegree> across;
  for (int k = 0; k < degree; ++k) across[k] = std::sin(k * alpha - angle);
  const auto value = [&](double x) {
    double sum = 0;
    for (int k = degree - 1; k >= 0; --k) sum = sum * x + across[k];
    return sum;
  };
  if (value(s.low) >= 0) return s.low;
  if (value(s.high) <= 0) return s.high;
  return rising_root(across.data(), degree, s.low, s.high);
}

namespace {

/// Length below which an edge counts as none.
template <class Point>
double least_edge(std::span<const Point> control) {
  double longest = 0;
  for (std::size_t i = 0; i + 1 < control.size(); ++i)
    longest = std::max(longest, distance(control[i], control[i + 1]));
  return curve::kLeastEdge * longest;
}

template <class Point>
core::Displacement<Point> edge_at_start(std::span<const Point> control) {
  const double least = least_edge(control);
  const auto next = std::find_if(control.begin(), control.end(), [&](const Point& p) {
    return distance(p, control.front()) > least;
  });
  return *next - control.front();
}

}  // namespace

Vector2 leaving_edge(std::span<const Point2> control) { return edge_at_start(control); }
core::Vector3 leaving_edge(std::span<const core::Point3> control) { return edge_at_start(control); }

std::vector<std::optional<ControlMatrix>> ratios(std::span<const Point2> control) {
  std::vector<Vector2> edges;
  for (std::size_t i = 0; i + 1 < control.size(); ++i) edges.push_back(control[i + 1] - control[i]);
  const double least = least_edge(control);
  std::vector<std::optional<ControlMatrix>> r;
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    const double before = norm(edges[i]);
    const double after = norm(edges[i + 1]);
    if (before > least && after > least)
      r.push_back(ControlMatrix{core::angle_between(edges[i], edges[i + 1]), after / before});
    else
      r.push_back(std::nullopt);
  }
  return r;
}

namespace {

/// -1, 0, 1 where the list starts lower than it ends, is the same from both ends (to 1e-12), starts
/// higher.
int first_against_last(const std::vector<double>& list) {
  for (std::size_t i = 0, j = list.size(); i + 1 < j; ++i) {
    --j;
    if (std::abs(list[i] - list[j]) > 1e-12 * std::max(std::abs(list[i]), std::abs(list[j])))
      return list[i] < list[j] ? -1 : 1;
  }
  return 0;
}

}  // namespace

bool edges_shrink(std::span<const Point2> control) {
  std::vector<double> lengths;
  std::vector<double> turning;
  for (std::size_t i = 0; i + 1 < control.size(); ++i)
    lengths.push_back(distance(control[i], control[i + 1]));
  for (const auto& r : ratios(control)) turning.push_back(r ? std::abs(r->alpha) : 0);
  const int by_length = first_against_last(lengths);
  return by_length != 0 ? by_length > 0 : first_against_last(turning) < 0;
}

}  // namespace keyline::classa
