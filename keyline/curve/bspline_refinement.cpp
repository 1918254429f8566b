#include <algorithm>
#include <array>

#include "keyline/curve/bspline.h"
#include "keyline/curve/homogeneous.h"

namespace keyline::curve {

using core::Point2;
using core::Point3;

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

/// Boehm's insertion of u, which lies in the domain, once. `beyond`: values of the net that stand
/// behind those given, which are all that u concerns.
template <class V>
void insert_once(Net<V>& net, double u, std::size_t beyond = 0) {
  const int p = net.degree;
  const int n = static_cast<int>(net.d.size() + beyond);
  int k = static_cast<int>(std::upper_bound(net.knots.begin(), net.knots.end(), u) -
                           net.knots.begin()) -
          1;
  if (k >= n) k = n - 1;
  while (!(net.knots[k] < net.knots[k + 1])) --k;
  std::array<V, kMaxBezierDegree> d;
  for (int i = k - p + 1; i <= k; ++i) {
    const double a = (u - net.knots[i]) / (net.knots[i + p] - net.knots[i]);
    d[i - (k - p + 1)] = (1 - a) * net.d[i - 1] + a * net.d[i];
  }
  net.d.insert(net.d.begin() + k, V{});
  std::copy(d.begin(), d.begin() + p, net.d.begin() + (k - p + 1));
  net.knots.insert(net.knots.begin() + k + 1, u);
}

template <class V>
void insert_up_to(Net<V>& net, double u, int wanted) {
  for (int m = multiplicity(net, u); m < wanted; ++m) insert_once(net, u);
}

/// Every knot of [from, to] as often as the degree, in time that grows as the net: what stands
/// behind a knot waits until it is that knot's turn.
template <class V>
Net<V> with_full_knots(const Net<V>& net, double from, double to) {
  const auto p = static_cast<std::size_t>(net.degree);
  Net<V> done{net.degree, {}, {}};
  std::size_t knots = 0;  // taken over so far, and control values
  std::size_t values = 0;
  const auto take = [&](std::size_t wanted) {
    for (; done.knots.size() < wanted && knots < net.knots.size(); ++knots)
      done.knots.push_back(net.knots[knots]);
    for (; done.d.size() < wanted && values < net.d.size(); ++values)
      done.d.push_back(net.d[values]);
  };
  for (const double u : net.knots) {
    if (u < from || u > to) continue;
    while (knots < net.knots.size() && net.knots[knots] <= u) take(done.knots.size() + 1);
    for (auto m = static_cast<std::size_t>(multiplicity(done, u)); m < p; ++m) {
      const auto behind = std::upper_bound(done.knots.begin(), done.knots.end(), u);
      take(static_cast<std::size_t>(behind - done.knots.begin()) + p + 1);
      insert_once(done, u, net.d.size() - values);
    }
  }
  take(net.knots.size() + done.knots.size());
  return done;
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
/// the blossom over leaving one of them out ([Ramshaw 1989]).
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
  domain(c);  // checks the counts
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
    return extract(with_full_knots(net, range.low, range.high), range.low, range.high);
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
  const double from = exact_knot_at(c, t0);
  const double to = exact_knot_at(c, t1);
  if (!(from < to)) throw core::InvalidInput("subcurve: empty");
  return through_net(c, [&](auto net) { return extract(std::move(net), from, to); });
}

template <class P>
std::pair<BSpline<P>, BSpline<P>> split(const BSpline<P>& c, double t) {
  return {subcurve(c, 0, t), subcurve(c, t, 1)};
}

#define KEYLINE_INSTANTIATE(P)                                                     \
  template BSpline<P> insert_knot(const BSpline<P>&, double, int);                 \
  template BSpline<P> refine_knots(const BSpline<P>&, const std::vector<double>&); \
  template BSpline<P> clamp_ends(const BSpline<P>&);                               \
  template std::vector<Bezier<P>> to_beziers(const BSpline<P>&);                   \
  template BSpline<P> elevate_degree(const BSpline<P>&, int);                      \
  template BSpline<P> subcurve(const BSpline<P>&, double, double);                 \
  template std::pair<BSpline<P>, BSpline<P>> split(const BSpline<P>&, double);
KEYLINE_INSTANTIATE(Point2)
KEYLINE_INSTANTIATE(Point3)
#undef KEYLINE_INSTANTIATE

}  // namespace keyline::curve
