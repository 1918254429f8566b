#include "keyline/curve/polyline.h"

#include <algorithm>
#include <string>

#include "keyline/curve/shares.h"

namespace keyline::curve {

using core::Point2;
using core::Point3;

namespace {

/// The edge and the fraction of it at t.
template <class P>
Share locate(const Polyline<P>& c, double t) {
  if (c.points.size() < 2) throw core::InvalidInput("Polyline: fewer than two points");
  return share_of(c.points.size() - 1, t);
}

/// The next edge that has length after one that has none; at the end the last one; else zero.
template <class P>
core::Displacement<P> way_on(const Polyline<P>& c, std::size_t edge) {
  const P& here = c.points[edge];
  for (std::size_t i = edge + 1; i < c.points.size(); ++i)
    if (c.points[i] != here) return c.points[i] - here;
  for (std::size_t i = edge; i-- > 0;)
    if (c.points[i] != here) return here - c.points[i];
  return {};
}

}  // namespace

template <class P>
core::Result<void> validate(const Polyline<P>& c) {
  if (c.points.size() < 2) {
    return core::fail(core::ErrorCode::bad_input, "a polyline has two or more points", "",
                      "points");
  }
  for (std::size_t i = 0; i < c.points.size(); ++i) {
    if (!is_finite(c.points[i])) {
      return core::fail(core::ErrorCode::bad_input, "coordinate is not a finite number", "",
                        "points[" + std::to_string(i) + "]");
    }
  }
  return {};
}

template <class P>
P evaluate(const Polyline<P>& c, double t) {
  const Share at = locate(c, t);
  return mix(c.points[at.index], c.points[at.index + 1], at.t);
}

template <class P>
Jet<P> jet(const Polyline<P>& c, double t) {
  const Share at = locate(c, t);
  const P& a = c.points[at.index];
  const P& b = c.points[at.index + 1];
  const auto edges = static_cast<double>(c.points.size() - 1);
  // The third derivative alone is read as a direction both by what leaves and by what arrives.
  return {mix(a, b, at.t), edges * (b - a), {}, edges * (a == b ? way_on(c, at.index) : b - b)};
}

template <class P>
std::vector<double> breakpoints(const Polyline<P>& c) {
  if (c.points.size() < 2) throw core::InvalidInput("Polyline: fewer than two points");
  std::vector<double> t(c.points.size());
  const double edges = static_cast<double>(t.size() - 1);
  for (std::size_t i = 0; i < t.size(); ++i) t[i] = static_cast<double>(i) / edges;
  return t;
}

template <class P>
std::pair<Polyline<P>, Polyline<P>> split(const Polyline<P>& c, double t) {
  return {subcurve(c, 0, t), subcurve(c, t, 1)};
}

template <class P>
Polyline<P> subcurve(const Polyline<P>& c, double t0, double t1) {
  const Share from = locate(c, t0);
  const Share to = locate(c, std::max(t0, t1));
  Polyline<P> part;
  part.points.push_back(mix(c.points[from.index], c.points[from.index + 1], from.t));
  for (std::size_t i = from.index + 1; i <= to.index; ++i) part.points.push_back(c.points[i]);
  if (to.t > 0 || part.points.size() < 2) {
    part.points.push_back(mix(c.points[to.index], c.points[to.index + 1], to.t));
  }
  return part;
}

template <class P>
Polyline<P> reverse(const Polyline<P>& c) {
  Polyline<P> r = c;
  std::reverse(r.points.begin(), r.points.end());
  return r;
}

Polyline2 transform(const Polyline2& c, const core::Similarity2& map) {
  Polyline2 moved = c;
  for (Point2& p : moved.points) p = core::apply(map, p);
  return moved;
}

#define KEYLINE_INSTANTIATE(P)                                                    \
  template core::Result<void> validate(const Polyline<P>&);                       \
  template P evaluate(const Polyline<P>&, double);                                \
  template Jet<P> jet(const Polyline<P>&, double);                                \
  template std::vector<double> breakpoints(const Polyline<P>&);                   \
  template std::pair<Polyline<P>, Polyline<P>> split(const Polyline<P>&, double); \
  template Polyline<P> subcurve(const Polyline<P>&, double, double);              \
  template Polyline<P> reverse(const Polyline<P>&);
KEYLINE_INSTANTIATE(Point2)
KEYLINE_INSTANTIATE(Point3)
#undef KEYLINE_INSTANTIATE

}  // namespace keyline::curve
