#include "keyline/surface/bezier_surface.h"

#include <algorithm>

#include "keyline/surface/tensor.h"

namespace keyline::surface {

using core::ErrorCode;
using core::fail;
using core::Point3;
using curve::Bezier3;

namespace {

void require_counts(const BezierSurface& s) {
  const Net& net = s.net;
  const bool ok = net.rows >= 1 && net.columns >= 1 && net.rows <= curve::kMaxBezierDegree + 1 &&
                  net.columns <= curve::kMaxBezierDegree + 1 &&
                  net.points.size() == static_cast<std::size_t>(net.rows) * net.columns &&
                  (!is_rational(s) || s.weights.size() == net.points.size());
  if (!ok) throw core::InvalidInput("BezierSurface: number of control points or weights");
}

/// Row `row` as a curve along v.
Bezier3 row_curve(const BezierSurface& s, int row) {
  Bezier3 c{row_of(s.net, row), {}};
  if (is_rational(s))
    c.weights.assign(s.weights.begin() + static_cast<std::ptrdiff_t>(s.net.index(row, 0)),
                     s.weights.begin() + static_cast<std::ptrdiff_t>(s.net.index(row + 1, 0)));
  return c;
}

/// Degree raised along the rows only.
BezierSurface elevate_rows(const BezierSurface& s, int by) {
  BezierSurface raised{{s.net.rows, s.net.columns + by, {}}, {}};
  for (int i = 0; i < s.net.rows; ++i) {
    const Bezier3 c = curve::elevate_degree(row_curve(s, i), by);
    raised.net.points.insert(raised.net.points.end(), c.control.begin(), c.control.end());
    raised.weights.insert(raised.weights.end(), c.weights.begin(), c.weights.end());
  }
  return raised;
}

SurfaceJet jet_to_order(const BezierSurface& s, double u, double v, int orders) {
  require_counts(s);
  detail::Strip strip;
  detail::contract({&s.net, &s.weights}, detail::bernstein_basis(s.net.rows - 1, u, orders), orders,
                   strip);
  return detail::combine(strip, detail::bernstein_basis(s.net.columns - 1, v, orders), orders);
}

}  // namespace

core::Result<void> validate(const BezierSurface& s) {
  if (auto sound = validate(s.net, s.weights); !sound) return sound;
  if (std::max(s.net.rows, s.net.columns) > curve::kMaxBezierDegree + 1)
    return fail(ErrorCode::bad_input, "the degree is outside 1 … 30",
                "use a B-spline surface for larger nets", "points");
  return {};
}

Point3 evaluate(const BezierSurface& s, double u, double v) {
  return jet_to_order(s, u, v, 1).point;
}

SurfaceJet jet(const BezierSurface& s, double u, double v) {
  return jet_to_order(s, u, v, detail::kOrders);
}

BezierSurface elevate_degree(const BezierSurface& s, int by_u, int by_v) {
  require_counts(s);
  return transposed(elevate_rows(transposed(elevate_rows(s, by_v)), by_u));
}

BezierSurface transposed(const BezierSurface& s) {
  BezierSurface turned{transposed(s.net), {}};
  for (int j = 0; j < s.net.columns && is_rational(s); ++j)
    for (int i = 0; i < s.net.rows; ++i) turned.weights.push_back(s.weights[s.net.index(i, j)]);
  return turned;
}

BezierSurface reversed_u(const BezierSurface& s) {
  BezierSurface turned = s;
  for (int i = 0; i < s.net.rows; ++i) {
    for (int j = 0; j < s.net.columns; ++j) {
      const std::size_t from = s.net.index(s.net.rows - 1 - i, j);
      turned.net.at(i, j) = s.net.points[from];
      if (is_rational(s)) turned.weights[s.net.index(i, j)] = s.weights[from];
    }
  }
  return turned;
}

Bezier3 iso_u(const BezierSurface& s, double u) {
  require_counts(s);
  detail::Strip strip;
  detail::contract({&s.net, &s.weights}, detail::bernstein_basis(s.net.rows - 1, u), 1, strip);
  Bezier3 c;
  c.weights = strip.weight[0];
  for (int j = 0; j < s.net.columns; ++j) {
    const double w = c.weights.empty() ? 1 : c.weights[j];
    c.control.push_back(Point3{} + strip.vector[0][j] / w);
  }
  return c;
}

Bezier3 iso_v(const BezierSurface& s, double v) { return iso_u(transposed(s), v); }

}  // namespace keyline::surface
