#include "keyline/curve/bspline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <string>

#include "keyline/curve/homogeneous.h"

namespace keyline::curve {

using core::ErrorCode;
using core::fail;
using core::Point2;
using core::Point3;

namespace {

template <class P>
void require_counts(const BSpline<P>& c) {
  const bool ok = c.degree >= 1 && c.degree <= kMaxBezierDegree &&
                  c.control.size() > static_cast<std::size_t>(c.degree) &&
                  c.knots.size() == c.control.size() + c.degree + 1 &&
                  (!is_rational(c) || c.weights.size() == c.control.size()) &&
                  c.knots[c.degree] < c.knots[c.control.size()];
  if (!ok) throw core::InvalidInput("BSpline: degree, counts or domain");
}

/// Span (index of a knot followed by a larger one) that t belongs to. Knots are compared as
/// breakpoints() prints them, so that a breakpoint belongs to the span that starts there.
template <class P>
int find_span(const BSpline<P>& c, double t) {
  const auto first = c.knots.begin() + c.degree;
  const auto last = c.knots.begin() + c.control.size();
  const auto after =
      std::partition_point(first + 1, last, [&](double u) { return parameter_at_knot(c, u) <= t; });
  auto at = after - 1;
  while (!(*at < at[1])) --at;  // t = 1, or knots closer than t can tell apart
  return static_cast<int>(at - c.knots.begin());
}

struct Place {
  int span;
  double knot;
};

template <class P>
Place locate(const BSpline<P>& c, double t) {
  t = std::clamp(t, 0.0, 1.0);
  const int span = find_span(c, t);
  if (parameter_at_knot(c, c.knots[span]) == t) return {span, c.knots[span]};
  return {span, std::clamp(knot_at(c, t), c.knots[span], c.knots[span + 1])};
}

template <class P>
auto local_plain(const BSpline<P>& c, int span) {
  std::array<core::Displacement<P>, kMaxBezierDegree + 1> d;
  for (int j = 0; j <= c.degree; ++j) d[j] = detail::from_origin(c.control[span - c.degree + j]);
  return d;
}
template <class P>
auto local_lifted(const BSpline<P>& c, int span) {
  std::array<detail::Homogeneous<P>, kMaxBezierDegree + 1> d;
  for (int j = 0; j <= c.degree; ++j) {
    const int i = span - c.degree + j;
    d[j] = detail::lift(c.control[i], c.weights[i]);
  }
  return d;
}

}  // namespace

template <class P>
core::Interval domain(const BSpline<P>& c) {
  require_counts(c);
  return {c.knots[c.degree], c.knots[c.control.size()]};
}

template <class P>
double exact_knot_at(const BSpline<P>& c, double t) {
  require_counts(c);
  return t >= 1 ? c.knots[c.control.size()] : locate(c, t).knot;
}

template <class P>
P evaluate(const BSpline<P>& c, double t) {
  require_counts(c);
  const auto [span, u] = locate(c, t);
  if (!is_rational(c)) {
    auto d = local_plain(c, span);
    return P{} + detail::de_boor(d.data(), c.knots.data(), c.degree, span, u);
  }
  auto d = local_lifted(c, span);
  return detail::project(detail::de_boor(d.data(), c.knots.data(), c.degree, span, u));
}

template <class P>
Jet<P> jet(const BSpline<P>& c, double t) {
  require_counts(c);
  const auto [span, u] = locate(c, t);
  const double scale = core::length(domain(c));
  const auto in_knots = [&c, at = span, parameter = u](auto d) {
    return detail::to_jet<P>(
        detail::spline_derivatives(d.data(), c.knots.data(), c.degree, at, parameter));
  };
  return rescaled(is_rational(c) ? in_knots(local_lifted(c, span)) : in_knots(local_plain(c, span)),
                  scale);
}

template <class P>
std::vector<double> breakpoints(const BSpline<P>& c) {
  require_counts(c);
  std::vector<double> t{0.0};
  for (std::size_t i = c.degree + 1; i < c.control.size(); ++i) {
    const double at = parameter_at_knot(c, c.knots[i]);
    if (at > t.back() && at < 1) t.push_back(at);
  }
  t.push_back(1.0);
  return t;
}

template <class P>
BSpline<P> reverse(const BSpline<P>& c) {
  BSpline<P> r = c;
  std::reverse(r.control.begin(), r.control.end());
  std::reverse(r.weights.begin(), r.weights.end());
  const double sum = c.knots.empty() ? 0 : c.knots.front() + c.knots.back();
  const auto reversed_about = [&](double total) {
    std::transform(c.knots.rbegin(), c.knots.rend(), r.knots.begin(),
                   [total](double u) { return total - u; });
  };
  const auto distinct = [](const std::vector<double>& knots) {
    return std::inner_product(knots.begin() + !knots.empty(), knots.end(), knots.begin(), 0,
                              std::plus<>(), std::not_equal_to<>());
  };
  reversed_about(sum);
  if (distinct(r.knots) < distinct(c.knots)) reversed_about(0);
  return r;
}

BSpline2 transform(const BSpline2& c, const core::Similarity2& map) {
  BSpline2 moved = c;
  for (Point2& p : moved.control) p = core::apply(map, p);
  return moved;
}

namespace {

template <class P>
core::Result<void> validate_knots(const BSpline<P>& c) {
  const auto path = [](std::size_t i) { return "knots[" + std::to_string(i) + "]"; };
  for (std::size_t i = 0; i < c.knots.size(); ++i) {
    if (!std::isfinite(c.knots[i]))
      return fail(ErrorCode::bad_input, "knot is not a finite number", "", path(i));
    if (i > 0 && c.knots[i] < c.knots[i - 1])
      return fail(ErrorCode::bad_input, "knots must not decrease", "", path(i));
    const std::size_t back = c.degree + 1;
    if (i >= back && c.knots[i] == c.knots[i - back])
      return fail(ErrorCode::bad_input, "knot is repeated more than degree + 1 times", "", path(i));
  }
  const double length = c.knots[c.control.size()] - c.knots[c.degree];
  if (!(length > 0) || !std::isfinite(length))
    return fail(ErrorCode::bad_input, "the knots leave no parameter range for the curve", "",
                path(c.degree));
  return {};
}

template <class P>
core::Result<void> validate_counts(const BSpline<P>& c) {
  if (c.degree < 1 || c.degree > kMaxBezierDegree)
    return fail(ErrorCode::bad_input, "degree must lie in 1 … 30", "", "degree");
  if (c.control.size() <= static_cast<std::size_t>(c.degree))
    return fail(ErrorCode::bad_input, "there must be more control points than the degree", "",
                "control");
  if (c.knots.size() != c.control.size() + c.degree + 1)
    return fail(ErrorCode::bad_input,
                "there must be " + std::to_string(c.control.size() + c.degree + 1) +
                    " knots (control points + degree + 1), not " + std::to_string(c.knots.size()),
                "", "knots");
  if (is_rational(c) && c.weights.size() != c.control.size())
    return fail(ErrorCode::bad_input, "there must be as many weights as control points, or none",
                "", "weights");
  return {};
}

}  // namespace

template <class P>
core::Result<void> validate(const BSpline<P>& c) {
  if (auto counts = validate_counts(c); !counts) return counts;
  for (std::size_t i = 0; i < c.control.size(); ++i) {
    if (!is_finite(c.control[i]))
      return fail(ErrorCode::bad_input, "coordinate is not a finite number", "",
                  "control[" + std::to_string(i) + "]");
  }
  for (std::size_t i = 0; i < c.weights.size(); ++i) {
    if (!(std::isfinite(c.weights[i]) && c.weights[i] > 0))
      return fail(ErrorCode::bad_input, "weight is not a positive finite number", "",
                  "weights[" + std::to_string(i) + "]");
  }
  return validate_knots(c);
}

#define KEYLINE_INSTANTIATE(P)                                 \
  template core::Result<void> validate(const BSpline<P>&);     \
  template core::Interval domain(const BSpline<P>&);           \
  template double exact_knot_at(const BSpline<P>&, double);    \
  template P evaluate(const BSpline<P>&, double);              \
  template Jet<P> jet(const BSpline<P>&, double);              \
  template std::vector<double> breakpoints(const BSpline<P>&); \
  template BSpline<P> reverse(const BSpline<P>&);
KEYLINE_INSTANTIATE(Point2)
KEYLINE_INSTANTIATE(Point3)
#undef KEYLINE_INSTANTIATE

}  // namespace keyline::curve
