#include "keyline/curve/bezier.h"

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

static_assert(kMaxBezierDegree == detail::kMaxDegree);

namespace {

template <class V>
using Buffer = std::array<V, kMaxBezierDegree + 1>;

template <class P>
void require_counts(const Bezier<P>& c) {
  if (c.control.empty() || degree(c) > kMaxBezierDegree ||
      (is_rational(c) && c.weights.size() != c.control.size())) {
    throw core::InvalidInput("Bezier: number of control points or weights");
  }
}

template <class P>
Buffer<core::Displacement<P>> plain_coefficients(const Bezier<P>& c) {
  Buffer<core::Displacement<P>> b;
  for (std::size_t i = 0; i < c.control.size(); ++i) b[i] = detail::from_origin(c.control[i]);
  return b;
}

template <class P>
Buffer<detail::Homogeneous<P>> lifted_coefficients(const Bezier<P>& c) {
  Buffer<detail::Homogeneous<P>> b;
  for (std::size_t i = 0; i < c.control.size(); ++i)
    b[i] = detail::lift(c.control[i], c.weights[i]);
  return b;
}

template <class P>
void store(Bezier<P>& c, std::size_t i, const core::Displacement<P>& v) {
  c.control[i] = P{} + v;
}
template <class P>
void store(Bezier<P>& c, std::size_t i, const detail::Homogeneous<P>& h) {
  c.control[i] = detail::project(h);
  c.weights[i] = h.weight;
}

template <class P, class V>
std::pair<Bezier<P>, Bezier<P>> split_coefficients(const Bezier<P>& c, V* b, double t) {
  std::pair<Bezier<P>, Bezier<P>> parts{c, c};
  const int n = degree(c);
  for (int level = 0; level <= n; ++level) {
    store(parts.first, level, b[0]);
    store(parts.second, n - level, b[n - level]);
    detail::casteljau_level(b, n + 1 - level, t);
  }
  parts.first.control.front() = c.control.front();
  parts.second.control.back() = c.control.back();
  return parts;
}

template <class P, class V>
Bezier<P> elevate_once(const Bezier<P>& c, const V* b) {
  const int n = degree(c) + 1;
  Bezier<P> raised = c;
  raised.control.push_back(c.control.back());
  if (is_rational(c)) raised.weights.push_back(c.weights.back());
  for (int i = 1; i < n; ++i) {
    const double share = static_cast<double>(i) / n;
    store(raised, i, share * b[i - 1] + (1 - share) * b[i]);
  }
  return raised;
}

}  // namespace

template <class P>
core::Result<void> validate(const Bezier<P>& c) {
  if (c.control.size() < 2 || degree(c) > kMaxBezierDegree) {
    return fail(ErrorCode::bad_input, "a Bezier curve has 2 to 31 control points", "", "control");
  }
  for (std::size_t i = 0; i < c.control.size(); ++i) {
    if (!is_finite(c.control[i])) {
      return fail(ErrorCode::bad_input, "coordinate is not a finite number", "",
                  "control[" + std::to_string(i) + "]");
    }
  }
  if (is_rational(c) && c.weights.size() != c.control.size()) {
    return fail(ErrorCode::bad_input, "there must be as many weights as control points, or none",
                "", "weights");
  }
  for (std::size_t i = 0; i < c.weights.size(); ++i) {
    if (!(std::isfinite(c.weights[i]) && c.weights[i] > 0)) {
      return fail(ErrorCode::bad_input, "weight is not a positive finite number", "",
                  "weights[" + std::to_string(i) + "]");
    }
  }
  return {};
}

template <class P>
P evaluate(const Bezier<P>& c, double t) {
  require_counts(c);
  t = std::clamp(t, 0.0, 1.0);
  if (!is_rational(c)) {
    auto b = plain_coefficients(c);
    return P{} + detail::bezier_value(b.data(), degree(c), t);
  }
  auto b = lifted_coefficients(c);
  return detail::project(detail::bezier_value(b.data(), degree(c), t));
}

template <class P>
Jet<P> jet(const Bezier<P>& c, double t) {
  require_counts(c);
  t = std::clamp(t, 0.0, 1.0);
  if (!is_rational(c)) {
    auto b = plain_coefficients(c);
    return detail::to_jet<P>(detail::bezier_derivatives(b.data(), degree(c), t));
  }
  auto b = lifted_coefficients(c);
  return detail::to_jet<P>(detail::bezier_derivatives(b.data(), degree(c), t));
}

template <class P>
std::pair<Bezier<P>, Bezier<P>> split(const Bezier<P>& c, double t) {
  require_counts(c);
  t = std::clamp(t, 0.0, 1.0);
  if (!is_rational(c)) {
    auto b = plain_coefficients(c);
    return split_coefficients(c, b.data(), t);
  }
  auto b = lifted_coefficients(c);
  return split_coefficients(c, b.data(), t);
}

template <class P>
Bezier<P> subcurve(const Bezier<P>& c, double t0, double t1) {
  t0 = std::clamp(t0, 0.0, 1.0);
  t1 = std::clamp(t1, t0, 1.0);
  Bezier<P> part = t1 < 1 ? split(c, t1).first : c;
  if (t0 > 0) part = split(part, t1 > 0 ? t0 / t1 : 0.0).second;
  return part;
}

template <class P>
Bezier<P> reverse(const Bezier<P>& c) {
  Bezier<P> r = c;
  std::reverse(r.control.begin(), r.control.end());
  std::reverse(r.weights.begin(), r.weights.end());
  return r;
}

template <class P>
Bezier<P> elevate_degree(const Bezier<P>& c, int by) {
  require_counts(c);
  if (by < 0 || degree(c) + by > kMaxBezierDegree) {
    throw core::InvalidInput("elevate_degree: degree out of range");
  }
  Bezier<P> raised = c;
  for (; by > 0; --by) {
    raised = is_rational(raised) ? elevate_once(raised, lifted_coefficients(raised).data())
                                 : elevate_once(raised, plain_coefficients(raised).data());
  }
  return raised;
}

Bezier2 transform(const Bezier2& c, const core::Similarity2& map) {
  Bezier2 moved = c;
  for (Point2& p : moved.control) p = core::apply(map, p);
  return moved;
}

#define KEYLINE_INSTANTIATE(P)                                              \
  template core::Result<void> validate(const Bezier<P>&);                   \
  template P evaluate(const Bezier<P>&, double);                            \
  template Jet<P> jet(const Bezier<P>&, double);                            \
  template std::pair<Bezier<P>, Bezier<P>> split(const Bezier<P>&, double); \
  template Bezier<P> subcurve(const Bezier<P>&, double, double);            \
  template Bezier<P> reverse(const Bezier<P>&);                             \
  template Bezier<P> elevate_degree(const Bezier<P>&, int);
KEYLINE_INSTANTIATE(Point2)
KEYLINE_INSTANTIATE(Point3)
#undef KEYLINE_INSTANTIATE

}  // namespace keyline::curve
