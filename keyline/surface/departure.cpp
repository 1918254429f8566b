#include "keyline/surface/departure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <unordered_map>
#include <utility>

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
  constexpr int kSteps = 6;
  SurfaceJet j = s.jet(u, v);
  SurfacePoint at{u, v, j.point, distance(j.point, p)};
  for (int i = 0; i < kSteps; ++i) {
    const auto [du, dv] = foot_step(j, j.point - p, at.u, at.v);
    SurfacePoint next;
    next.u = std::clamp(at.u + du, 0.0, 1.0);
    next.v = std::clamp(at.v + dv, 0.0, 1.0);
    j = s.jet(next.u, next.v);
    next.point = j.point;
    next.distance = distance(next.point, p);
    if (!(next.distance < at.distance)) break;
    const bool settled = next.distance > 0.9999 * at.distance;
    at = next;
    if (settled) break;
  }
  return at;
}

constexpr int kFinest = 128;      // cells along a side
constexpr double kSlack = 0.005;  // of the bound

/// One of `cells` by `cells` parts of a patch, with the feet of its corners (0 0), (1 0), (0 1), (1
/// 1).
struct Cell {
  int cells = 1, i = 0, j = 0;
  std::array<SurfacePoint, 4> foot;
  double bound = 0;
  bool operator<(const Cell& other) const { return bound < other.bound; }
};

/// How the image of a cell runs along one parameter: its own slope, |1 - slope^2| and the slope of
/// the other parameter, each largest.
struct Image {
  double slope = 0, unlike = 0, aside = 0;
};

/// Along the sides from a0 to a1 and from b0 to b1.
Image image(int cells, const SurfacePoint& a0, const SurfacePoint& a1, const SurfacePoint& b0,
            const SurfacePoint& b1, double SurfacePoint::* own, double SurfacePoint::* other) {
  const double a = (a1.*own - a0.*own) * cells;
  const double b = (b1.*own - b0.*own) * cells;
  Image m{std::max(std::abs(a), std::abs(b)), std::max(std::abs(1 - a * a), std::abs(1 - b * b)),
          cells * std::max(std::abs(a1.*other - a0.*other), std::abs(b1.*other - b0.*other))};
  if (!(a > 0 && b > 0)) m.unlike = std::max(m.unlike, 1.0);  // 0 lies between them
  return m;
}

/// One way: every point of `from` against `onto`, both of the same degrees.
class OneWay {
 public:
  OneWay(const BezierSurface& from, const BezierSurface& onto)
      : here_(from), there_(onto), onto_bounds_(bounds_of(vectors_of(onto.net))) {
    VectorNet apart = vectors_of(from.net);
    for (std::size_t i = 0; i < apart.v.size(); ++i)
      apart.v[i] = from.net.points[i] - onto.net.points[i];
    apart_ = bounds_of(apart);
  }

  /// The cell of the largest bound is halved until it is as near its corners as is asked, or small.
  double bound(double wanted) {
    std::priority_queue<Cell> open;
    open.push(cell(1, 0, 0, {foot_at(0, 0), foot_at(1, 0), foot_at(0, 1), foot_at(1, 1)}));
    while (open.top().cells < kFinest &&
           open.top().bound > std::max(wanted, (1 + kSlack) * farthest_)) {
      const Cell whole = open.top();
      open.pop();
      for (Cell& part : quarters(whole)) open.push(std::move(part));
    }
    return open.top().bound;
  }

 private:
  /// Cells side by side share it.
  SurfacePoint foot_at(double u, double v) {
    const int place = static_cast<int>(kFinest * u) * (kFinest + 1) + static_cast<int>(kFinest * v);
    const auto [known, is_new] = feet_.try_emplace(place);
    if (is_new) known->second = foot(there_, here_.point(u, v), u, v);
    farthest_ = std::max(farthest_, known->second.distance);
    return known->second;
  }

  Cell cell(int cells, int i, int j, const std::array<SurfacePoint, 4>& feet) const {
    Cell made{cells, i, j, feet, 0};
    for (const SurfacePoint& f : feet) made.bound = std::max(made.bound, f.distance);
    made.bound += remainder(made);
    return made;
  }

  std::array<Cell, 4> quarters(const Cell& c) {
    const int n = 2 * c.cells, i = 2 * c.i, j = 2 * c.j;
    const auto at = [&](int di, int dj) {
      return foot_at(static_cast<double>(i + di) / n, static_cast<double>(j + dj) / n);
    };
    const auto& [f00, f20, f02, f22] = c.foot;
    const SurfacePoint f10 = at(1, 0), f01 = at(0, 1), f11 = at(1, 1), f21 = at(2, 1),
                       f12 = at(1, 2);
    return {cell(n, i, j, {f00, f10, f01, f11}), cell(n, i + 1, j, {f10, f20, f11, f21}),
            cell(n, i, j + 1, {f01, f11, f02, f12}), cell(n, i + 1, j + 1, {f11, f21, f12, f22})};
  }

  double remainder(const Cell& c) const {
    double du = 0, dv = 0;
    for (std::size_t k = 0; k < c.foot.size(); ++k) {
      const int i = c.i + static_cast<int>(k % 2), j = c.j + static_cast<int>(k / 2);
      du = std::max(du, std::abs(c.foot[k].u - static_cast<double>(i) / c.cells));
      dv = std::max(dv, std::abs(c.foot[k].v - static_cast<double>(j) / c.cells));
    }
    const auto& [f00, f10, f01, f11] = c.foot;
    const DerivativeBounds& b = onto_bounds_;
    const Image u = image(c.cells, f00, f10, f01, f11, &SurfacePoint::u, &SurfacePoint::v);
    const Image v = image(c.cells, f00, f01, f10, f11, &SurfacePoint::v, &SurfacePoint::u);
    const double second_u = apart_.uu + b.uuu * du + b.uuv * dv + b.uu * u.unlike +
                            2 * b.uv * u.slope * u.aside + b.vv * u.aside * u.aside;
    const double second_v = apart_.vv + b.vvv * dv + b.uvv * du + b.vv * v.unlike +
                            2 * b.uv * v.slope * v.aside + b.uu * v.aside * v.aside;
    return (second_u + second_v) / (8.0 * c.cells * c.cells);
  }

  Places here_, there_;
  DerivativeBounds onto_bounds_, apart_;
  std::unordered_map<int, SurfacePoint> feet_;  ///< by place, in finest cells
  double farthest_ = 0;                         ///< of the feet found
};

}  // namespace

double departure_bound(const BezierSurface& a, const BezierSurface& b, double wanted) {
  if (is_rational(a) || is_rational(b))
    throw core::InvalidInput("departure_bound: a rational patch");
  const int rows = std::max(a.net.rows, b.net.rows);
  const int columns = std::max(a.net.columns, b.net.columns);
  const BezierSurface x = elevate_degree(a, rows - a.net.rows, columns - a.net.columns);
  const BezierSurface y = elevate_degree(b, rows - b.net.rows, columns - b.net.columns);
  if (x.net == y.net) return 0;
  const double there = OneWay(x, y).bound(wanted);
  return std::max(there, OneWay(y, x).bound(std::max(wanted, there)));
}

}  // namespace keyline::surface
