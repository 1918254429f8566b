#include "keyline/surface/departure.h"

#include <algorithm>
#include <cmath>

#include "keyline/surface/closest_point.h"
#include "keyline/surface/tensor.h"

namespace keyline::surface {
namespace {

using core::Point3;
using core::Vector3;

/// Bounds of the derivatives of order (i, j), i + j = 2 and 3, from the differences of the net.
struct DerivativeBounds {
  double uu = 0, uv = 0, vv = 0, uuu = 0, uuv = 0, uvv = 0, vvv = 0;
};

/// The net's vectors, differenced along its rows or columns and scaled to those of the derivative.
struct VectorNet {
  int rows = 0, columns = 0;
  std::vector<Vector3> v;
  Vector3 at(int i, int j) const {
    return v[static_cast<std::size_t>(i) * static_cast<std::size_t>(columns) +
             static_cast<std::size_t>(j)];
  }
};

VectorNet differenced(const VectorNet& n, bool along_u) {
  VectorNet d{n.rows - (along_u ? 1 : 0), n.columns - (along_u ? 0 : 1), {}};
  if (d.rows < 1 || d.columns < 1) return {0, 0, {}};
  const double factor = along_u ? d.rows : d.columns;
  for (int i = 0; i < d.rows; ++i)
    for (int j = 0; j < d.columns; ++j)
      d.v.push_back(factor * ((along_u ? n.at(i + 1, j) : n.at(i, j + 1)) - n.at(i, j)));
  return d;
}

double largest(const VectorNet& n) {
  double most = 0;
  for (const Vector3& v : n.v) most = std::max(most, norm(v));
  return most;
}

DerivativeBounds bounds_of(const VectorNet& n) {
  const VectorNet u = differenced(n, true), v = differenced(n, false);
  const VectorNet uu = differenced(u, true), uv = differenced(u, false), vv = differenced(v, false);
  return {largest(uu),
          largest(uv),
          largest(vv),
          largest(differenced(uu, true)),
          largest(differenced(uu, false)),
          largest(differenced(uv, false)),
          largest(differenced(vv, false))};
}

VectorNet vectors_of(const Net& net) {
  VectorNet n{net.rows, net.columns, {}};
  for (const Point3& p : net.points) n.v.push_back(p - Point3{});
  return n;
}

/// A polynomial patch at many places: value and first derivatives.
class Places {
 public:
  explicit Places(const BezierSurface& s) : s_(s) {}
  SurfaceJet jet(double u, double v, int orders = 2) {
    detail::contract({&s_.net, &s_.weights}, detail::bernstein_basis(s_.net.rows - 1, u, orders),
                     orders, strip_);
    return detail::combine(strip_, detail::bernstein_basis(s_.net.columns - 1, v, orders), orders);
  }
  Point3 point(double u, double v) { return jet(u, v, 1).point; }

 private:
  const BezierSurface& s_;
  detail::Strip strip_;
};

/// Close to the nearest point of the patch to p, from (u, v): any point makes a sound bound.
SurfacePoint foot(Places& s, const Point3& p, double u, double v) {
  SurfacePoint at{u, v, s.point(u, v), 0};
  at.distance = distance(at.point, p);
  for (int i = 0; i < 4; ++i) {
    const SurfaceJet j = s.jet(at.u, at.v);
    const Vector3 off = j.point - p;
    const double gu = dot(off, j.u), gv = dot(off, j.v);
    const double a = dot(j.u, j.u), b = dot(j.u, j.v), c = dot(j.v, j.v);
    const double det = a * c - b * b;
    if (!(det > 1e-14 * a * c)) break;
    SurfacePoint next;
    next.u = std::clamp(at.u + (b * gv - c * gu) / det, 0.0, 1.0);
    next.v = std::clamp(at.v + (b * gu - a * gv) / det, 0.0, 1.0);
    next.point = s.point(next.u, next.v);
    next.distance = distance(next.point, p);
    if (!(next.distance < at.distance)) break;
    const bool settled = next.distance > 0.9999 * at.distance;
    at = next;
    if (settled) break;
  }
  return at;
}

/// One way: every point of `from` against `onto`, both of the same degrees.
class OneWay {
 public:
  OneWay(const BezierSurface& from, const BezierSurface& onto, int cells)
      : cells_(cells), onto_bounds_(bounds_of(vectors_of(onto.net))) {
    VectorNet apart = vectors_of(from.net);
    for (std::size_t i = 0; i < apart.v.size(); ++i)
      apart.v[i] = from.net.points[i] - onto.net.points[i];
    apart_ = bounds_of(apart);
    Places here(from);
    Places there(onto);
    for (int i = 0; i <= cells; ++i)
      for (int j = 0; j <= cells; ++j)
        feet_.push_back(foot(there, here.point(share(i), share(j)), share(i), share(j)));
  }

  /// The bound, and how much of it is not distance at a corner.
  void run() {
    for (int i = 0; i < cells_; ++i)
      for (int j = 0; j < cells_; ++j) {
        const double rest = remainder(i, j);
        const double corner = std::max({at(i, j).distance, at(i + 1, j).distance,
                                        at(i, j + 1).distance, at(i + 1, j + 1).distance});
        if (corner + rest <= bound) continue;
        bound = corner + rest;
        slack = rest;
      }
  }

  double bound = 0;
  double slack = 0;

 private:
  double share(int i) const { return static_cast<double>(i) / cells_; }
  const SurfacePoint& at(int i, int j) const {
    return feet_[static_cast<std::size_t>(i * (cells_ + 1) + j)];
  }

  /// How the image runs along one parameter in a cell: its own slope, |1 - slope^2| and the slope
  /// of the other parameter, each largest.
  struct Image {
    double slope = 0, unlike = 0, aside = 0;
  };
  Image image(const SurfacePoint& a0, const SurfacePoint& a1, const SurfacePoint& b0,
              const SurfacePoint& b1, double SurfacePoint::* own,
              double SurfacePoint::* other) const {
    const double a = (a1.*own - a0.*own) * cells_;
    const double b = (b1.*own - b0.*own) * cells_;
    Image m{std::max(std::abs(a), std::abs(b)), std::max(std::abs(1 - a * a), std::abs(1 - b * b)),
            cells_ * std::max(std::abs(a1.*other - a0.*other), std::abs(b1.*other - b0.*other))};
    if (!(a > 0 && b > 0)) m.unlike = std::max(m.unlike, 1.0);  // 0 lies between them
    return m;
  }

  double remainder(int i, int j) const {
    double du = 0, dv = 0;
    for (const int k : {i, i + 1})
      for (const int l : {j, j + 1}) {
        du = std::max(du, std::abs(at(k, l).u - share(k)));
        dv = std::max(dv, std::abs(at(k, l).v - share(l)));
      }
    const DerivativeBounds& b = onto_bounds_;
    const Image u = image(at(i, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1), &SurfacePoint::u,
                          &SurfacePoint::v);
    const Image v = image(at(i, j), at(i, j + 1), at(i + 1, j), at(i + 1, j + 1), &SurfacePoint::v,
                          &SurfacePoint::u);
    const double second_u = apart_.uu + b.uuu * du + b.uuv * dv + b.uu * u.unlike +
                            2 * b.uv * u.slope * u.aside + b.vv * u.aside * u.aside;
    const double second_v = apart_.vv + b.vvv * dv + b.uvv * du + b.vv * v.unlike +
                            2 * b.uv * v.slope * v.aside + b.uu * v.aside * v.aside;
    return (second_u + second_v) / (8.0 * cells_ * cells_);
  }

  int cells_;
  DerivativeBounds onto_bounds_, apart_;
  std::vector<SurfacePoint> feet_;
};

double one_way(const BezierSurface& from, const BezierSurface& onto, double wanted) {
  double bound = 0;
  for (int cells = 16; cells <= 128; cells *= 2) {
    OneWay way(from, onto, cells);
    way.run();
    bound = way.bound;
    if (bound <= wanted || way.slack <= 0.005 * std::max(bound, wanted)) break;
  }
  return bound;
}

}  // namespace

double departure_bound(const BezierSurface& a, const BezierSurface& b, double wanted) {
  if (is_rational(a) || is_rational(b))
    throw core::InvalidInput("departure_bound: a rational patch");
  const int rows = std::max(a.net.rows, b.net.rows);
  const int columns = std::max(a.net.columns, b.net.columns);
  const BezierSurface x = elevate_degree(a, rows - a.net.rows, columns - a.net.columns);
  const BezierSurface y = elevate_degree(b, rows - b.net.rows, columns - b.net.columns);
  if (x.net == y.net) return 0;
  return std::max(one_way(x, y, wanted), one_way(y, x, wanted));
}

}  // namespace keyline::surface
