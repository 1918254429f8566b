#include "keyline/curve/bspline.h"

#include <algorithm>
#include <array>
#include <cmath>
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
  const auto in_knots = [&](auto d) {
    return detail::to_jet<P>(
        detail::spline_derivatives(d.data(), c.knots.data(), c.degree, span, u));
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

namespace {

/// Control values with their knots, polynomial or lifted.
template <class V>
struct Net {
  int degree;
  std::vector<double> knots;
  std::vector<V> d;
};

template <class P>
Net<core::Displacement<P>> plain_net(const BSpline<P>& c) {
  Net<core::Displacement<P>> net{c.degree, c.knots, {}};
  for (const P& p : c.control) net.d.push_back(detail::from_origin(p));
  return net;
}
template <class P>
Net<detail::Homogeneous<P>> lifted_net(const BSpline<P>& c) {
  Net<detail::Homogeneous<P>> net{c.degree, c.knots, {}};
  for (std::size_t i = 0; i < c.control.size(); ++i)
    net.d.push_back(detail::lift(c.control[i], c.weights[i]));
  return net;
}

template <class P>
BSpline<P> from_net(const Net<core::Displacement<P>>& net) {
  BSpline<P> c{net.degree, net.knots, {}, {}};
  for (const auto& v : net.d) c.control.push_back(P{} + v);
  return c;
}
template <class P>
BSpline<P> from_net(const Net<detail::Homogeneous<P>>& net) {
  BSpline<P> c{net.degree, net.knots, {}, {}};
  for (const auto& h : net.d) {
    c.control.push_back(detail::project(h));
    c.weights.push_back(h.weight);
  }
  return c;
}

template <class V>
int multiplicity(const Net<V>& net, double u) {
  const auto [first, last] = std::equal_range(net.knots.begin(), net.knots.end(), u);
  return static_cast<int>(last - first);
}

/// Boehm's insertion of u, which lies in the domain, once.
template <class V>
void insert_once(Net<V>& net, double u) {
  const int p = net.degree;
  const int n = static_cast<int>(net.d.size());
  int k = static_cast<int>(std::upper_bound(net.knots.begin(), net.knots.end(), u) -
                           net.knots.begin()) -
          1;
  if (k >= n) k = n - 1;
  while (!(net.knots[k] < net.knots[k + 1])) --k;
  std::vector<V> d(net.d.begin(), net.d.begin() + (k - p + 1));
  d.reserve(n + 1);
  for (int i = k - p + 1; i <= k; ++i) {
    const double a = (u - net.knots[i]) / (net.knots[i + p] - net.knots[i]);
    d.push_back((1 - a) * net.d[i - 1] + a * net.d[i]);
  }
  d.insert(d.end(), net.d.begin() + k, net.d.end());
  net.d = std::move(d);
  net.knots.insert(net.knots.begin() + k + 1, u);
}

template <class V>
void insert_up_to(Net<V>& net, double u, int wanted) {
  for (int m = multiplicity(net, u); m < wanted; ++m) insert_once(net, u);
}

/// The curve over [from, to] with clamped ends.
template <class V>
Net<V> extract(Net<V> net, double from, double to) {
  const int p = net.degree;
  insert_up_to(net, from, p);
  insert_up_to(net, to, p);
  const auto begin = net.knots.begin();
  const auto k = std::upper_bound(begin, net.knots.end(), from) - begin - 1;
  const auto f = std::lower_bound(begin, net.knots.end(), to) - begin;
  Net<V> part{p, {}, {net.d.begin() + (k - p), net.d.begin() + f}};
  part.knots.assign(p + 1, from);
  part.knots.insert(part.knots.end(), begin + k + 1, begin + f);
  part.knots.insert(part.knots.end(), p + 1, to);
  return part;
}

/// Blossom of the polynomial of a span at the given degree arguments.
template <class V>
V blossom(const Net<V>& net, int span, const double* arguments) {
  const int p = net.degree;
  std::array<V, kMaxBezierDegree + 1> d;
  for (int j = 0; j <= p; ++j) d[j] = net.d[span - p + j];
  for (int r = 1; r <= p; ++r) {
    for (int j = p; j >= r; --j) {
      const double low = net.knots[span - p + j];
      const double high = net.knots[span + 1 - r + j];
      const double a = (arguments[r - 1] - low) / (high - low);
      d[j] = (1 - a) * d[j - 1] + a * d[j];
    }
  }
  return d[p];
}

/// Control value of the elevated curve that belongs to its inner knots at[0..degree]: the mean of
/// the blossom over leaving one of them out (Ramshaw, "Blossoms are polar forms", 1989).
template <class V>
V elevated_value(const Net<V>& net, int span, const double* at) {
  const int count = net.degree + 1;
  std::array<double, kMaxBezierDegree + 1> rest;
  V sum{};
  for (int skip = 0; skip < count; ++skip) {
    std::copy(at, at + skip, rest.begin());
    std::copy(at + skip + 1, at + count, rest.begin() + skip);
    sum = sum + (1.0 / count) * blossom(net, span, rest.data());
  }
  return sum;
}

/// Longest span of the domain that meets [low, high].
template <class V>
int widest_span(const Net<V>& net, double low, double high) {
  int best = -1;
  for (int s = net.degree; s < static_cast<int>(net.d.size()); ++s) {
    if (net.knots[s] < low || net.knots[s + 1] > high) continue;
    const double width = net.knots[s + 1] - net.knots[s];
    if (width > 0 && (best < 0 || width > net.knots[best + 1] - net.knots[best])) best = s;
  }
  return best;
}

/// One degree more; net is clamped.
template <class V>
Net<V> elevate_once(const Net<V>& net) {
  Net<V> raised{net.degree + 1, {}, {}};
  for (std::size_t i = 0; i < net.knots.size(); ++i) {
    raised.knots.push_back(net.knots[i]);
    if (i + 1 == net.knots.size() || net.knots[i + 1] != net.knots[i])
      raised.knots.push_back(net.knots[i]);
  }
  const std::size_t count = raised.knots.size() - raised.degree - 1;
  for (std::size_t i = 0; i < count; ++i) {
    const int span = widest_span(net, raised.knots[i], raised.knots[i + raised.degree + 1]);
    raised.d.push_back(elevated_value(net, span, &raised.knots[i + 1]));
  }
  return raised;
}

/// Calls f with the net of the curve, polynomial or lifted, and makes a curve of its answer.
template <class P, class F>
BSpline<P> through_net(const BSpline<P>& c, F f) {
  require_counts(c);
  return is_rational(c) ? from_net<P>(f(lifted_net(c))) : from_net<P>(f(plain_net(c)));
}

}  // namespace

template <class P>
BSpline<P> refine_knots(const BSpline<P>& c, const std::vector<double>& inserted) {
  const core::Interval range = domain(c);
  return through_net(c, [&](auto net) {
    for (const double u : inserted) {
      if (!(u >= range.low && u <= range.high))
        throw core::InvalidInput("insert_knot: outside the domain");
      if (multiplicity(net, u) > c.degree)
        throw core::InvalidInput("insert_knot: multiplicity above degree + 1");
      insert_once(net, u);
    }
    return net;
  });
}

template <class P>
BSpline<P> insert_knot(const BSpline<P>& c, double u, int times) {
  return refine_knots(c, std::vector<double>(std::max(times, 0), u));
}

template <class P>
BSpline<P> clamp_ends(const BSpline<P>& c) {
  const core::Interval range = domain(c);
  return through_net(c, [&](auto net) { return extract(std::move(net), range.low, range.high); });
}

template <class P>
std::vector<Bezier<P>> to_beziers(const BSpline<P>& c) {
  const core::Interval range = domain(c);
  const int p = c.degree;
  const BSpline<P> fine = through_net(c, [&](auto net) {
    const auto knots = net.knots;
    for (const double u : knots)
      if (u >= range.low && u <= range.high) insert_up_to(net, u, p);
    return extract(std::move(net), range.low, range.high);
  });
  std::vector<Bezier<P>> pieces;
  for (std::size_t k = p; k < fine.control.size(); ++k) {
    if (!(fine.knots[k] < fine.knots[k + 1])) continue;
    Bezier<P> piece;
    piece.control.assign(fine.control.begin() + (k - p), fine.control.begin() + k + 1);
    if (is_rational(c))
      piece.weights.assign(fine.weights.begin() + (k - p), fine.weights.begin() + k + 1);
    pieces.push_back(std::move(piece));
  }
  return pieces;
}

template <class P>
BSpline<P> elevate_degree(const BSpline<P>& c, int by) {
  const core::Interval range = domain(c);
  if (by < 0 || c.degree + by > kMaxBezierDegree)
    throw core::InvalidInput("elevate_degree: degree out of range");
  return through_net(c, [&](auto net) {
    net = extract(std::move(net), range.low, range.high);
    for (int i = 0; i < by; ++i) net = elevate_once(net);
    return net;
  });
}

template <class P>
BSpline<P> subcurve(const BSpline<P>& c, double t0, double t1) {
  require_counts(c);
  const double from = locate(c, t0).knot;
  const double to = t1 >= 1 ? domain(c).high : locate(c, t1).knot;
  if (!(from < to)) throw core::InvalidInput("subcurve: empty");
  return through_net(c, [&](auto net) { return extract(std::move(net), from, to); });
}

template <class P>
std::pair<BSpline<P>, BSpline<P>> split(const BSpline<P>& c, double t) {
  return {subcurve(c, 0, t), subcurve(c, t, 1)};
}

template <class P>
BSpline<P> reverse(const BSpline<P>& c) {
  BSpline<P> r = c;
  std::reverse(r.control.begin(), r.control.end());
  std::reverse(r.weights.begin(), r.weights.end());
  std::reverse(r.knots.begin(), r.knots.end());
  const double sum = c.knots.empty() ? 0 : c.knots.front() + c.knots.back();
  for (double& u : r.knots) u = sum - u;
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

#define KEYLINE_INSTANTIATE(P)                                                     \
  template core::Result<void> validate(const BSpline<P>&);                         \
  template core::Interval domain(const BSpline<P>&);                               \
  template P evaluate(const BSpline<P>&, double);                                  \
  template Jet<P> jet(const BSpline<P>&, double);                                  \
  template std::vector<double> breakpoints(const BSpline<P>&);                     \
  template BSpline<P> insert_knot(const BSpline<P>&, double, int);                 \
  template BSpline<P> refine_knots(const BSpline<P>&, const std::vector<double>&); \
  template BSpline<P> clamp_ends(const BSpline<P>&);                               \
  template std::vector<Bezier<P>> to_beziers(const BSpline<P>&);                   \
  template BSpline<P> elevate_degree(const BSpline<P>&, int);                      \
  template BSpline<P> subcurve(const BSpline<P>&, double, double);                 \
  template std::pair<BSpline<P>, BSpline<P>> split(const BSpline<P>&, double);     \
  template BSpline<P> reverse(const BSpline<P>&);
KEYLINE_INSTANTIATE(Point2)
KEYLINE_INSTANTIATE(Point3)
#undef KEYLINE_INSTANTIATE

}  // namespace keyline::curve
