#include "keyline/surface/bspline_surface.h"

#include <algorithm>
#include <functional>
#include <string>

#include "keyline/curve/bspline.h"
#include "keyline/surface/tensor.h"

namespace keyline::surface {

using core::Point3;
using curve::BSpline3;

namespace {

bool knots_fit(int degree, int count, const std::vector<double>& knots) {
  return degree >= 1 && degree <= curve::kMaxBezierDegree && count > degree &&
         knots.size() == static_cast<std::size_t>(count) + static_cast<std::size_t>(degree) + 1 &&
         knots[degree] < knots[count];
}

void require_counts(const BSplineSurface& s) {
  const Net& net = s.net;
  const bool ok = net.points.size() == static_cast<std::size_t>(net.rows) * net.columns &&
                  (!is_rational(s) || s.weights.size() == net.points.size()) &&
                  knots_fit(s.degree[0], net.rows, s.knots[0]) &&
                  knots_fit(s.degree[1], net.columns, s.knots[1]);
  if (!ok) throw core::InvalidInput("BSplineSurface: degrees, counts or domain");
}

/// What curve::validate says of the knots of one direction.
core::Result<void> validate_direction(const BSplineSurface& s, int direction) {
  const int count = direction == 0 ? s.net.rows : s.net.columns;
  const auto sound = curve::validate(
      BSpline3{s.degree[direction], s.knots[direction], std::vector<Point3>(count), {}});
  if (sound) return {};
  core::Failure failure = sound.error();
  const std::string index = "[" + std::to_string(direction) + "]";
  if (failure.path.starts_with("knots")) {
    failure.path.insert(5, index);
  } else {
    failure.path = failure.path == "degree" ? "degree" + index : "points";
  }
  return std::unexpected(std::move(failure));
}

BSpline3 row_curve(const BSplineSurface& s, int row) {
  BSpline3 c{s.degree[1], s.knots[1], row_of(s.net, row), {}};
  for (int j = 0; j < s.net.columns && is_rational(s); ++j)
    c.weights.push_back(s.weights[s.net.index(row, j)]);
  return c;
}

/// The surface with every row replaced by `change` of it; all come back with the same knots.
template <class Change>
BSplineSurface with_rows(const BSplineSurface& s, const Change& change) {
  BSplineSurface changed{s.degree, s.knots, {s.net.rows, 0, {}}, {}};
  for (int i = 0; i < s.net.rows; ++i) {
    const BSpline3 c = change(row_curve(s, i));
    changed.degree[1] = c.degree;
    changed.knots[1] = c.knots;
    changed.net.columns = static_cast<int>(c.control.size());
    changed.net.points.insert(changed.net.points.end(), c.control.begin(), c.control.end());
    changed.weights.insert(changed.weights.end(), c.weights.begin(), c.weights.end());
  }
  return changed;
}

SurfaceJet jet_to_order(const BSplineSurface& s, double u, double v, int orders) {
  require_counts(s);
  detail::Strip strip;
  detail::contract({&s.net, &s.weights}, detail::spline_basis(s.degree[0], s.knots[0], u), orders,
                   strip);
  return detail::combine(strip, detail::spline_basis(s.degree[1], s.knots[1], v), orders);
}

/// One strip of Bézier columns for each span in v; rows are still B-spline points in u.
std::vector<BSplineSurface> cut_columns(const BSplineSurface& s) {
  std::vector<BSplineSurface> strips;
  for (int i = 0; i < s.net.rows; ++i) {
    const auto beziers = curve::to_beziers(row_curve(s, i));
    strips.resize(beziers.size(),
                  {s.degree, {s.knots[0], {}}, {s.net.rows, s.degree[1] + 1, {}}, {}});
    for (std::size_t k = 0; k < beziers.size(); ++k) {
      auto& part = strips[k];
      const auto& b = beziers[k];
      part.net.points.insert(part.net.points.end(), b.control.begin(), b.control.end());
      part.weights.insert(part.weights.end(), b.weights.begin(), b.weights.end());
    }
  }
  for (BSplineSurface& part : strips) {
    part.knots[1].assign(s.degree[1] + 1, 0.0);
    part.knots[1].insert(part.knots[1].end(), s.degree[1] + 1, 1.0);
  }
  return strips;
}

/// Whether breakpoints grow from 0 to 1 and cut as many spans.
bool cut_spans(const std::vector<double>& breaks, int spans) {
  return static_cast<int>(breaks.size()) == spans + 1 && breaks.front() == 0 &&
         breaks.back() == 1 &&
         std::adjacent_find(breaks.begin(), breaks.end(), std::greater_equal<>()) == breaks.end();
}

std::vector<double> full_knots(const std::vector<double>& breaks, int degree) {
  std::vector<double> knots{breaks.front()};
  for (const double t : breaks) knots.insert(knots.end(), degree, t);
  knots.push_back(breaks.back());
  return knots;
}

std::vector<double> bezier_knots(int count) {
  std::vector<double> knots(count, 0.0);
  knots.insert(knots.end(), count, 1.0);
  return knots;
}

}  // namespace

core::Result<void> validate(const BSplineSurface& s) {
  if (auto sound = validate(s.net, s.weights); !sound) return sound;
  if (auto sound = validate_direction(s, 0); !sound) return sound;
  return validate_direction(s, 1);
}

Point3 evaluate(const BSplineSurface& s, double u, double v) {
  return jet_to_order(s, u, v, 1).point;
}

SurfaceJet jet(const BSplineSurface& s, double u, double v) {
  return jet_to_order(s, u, v, detail::kOrders);
}

std::vector<double> breakpoints_v(const BSplineSurface& s) {
  require_counts(s);
  return curve::breakpoints(row_curve(s, 0));
}
std::vector<double> breakpoints_u(const BSplineSurface& s) { return breakpoints_v(transposed(s)); }

BSplineSurface elevate_degree(const BSplineSurface& s, int by_u, int by_v) {
  require_counts(s);
  const auto raised = [](const BSplineSurface& given, int by) {
    if (by == 0) return given;
    return with_rows(given, [by](const BSpline3& c) { return curve::elevate_degree(c, by); });
  };
  return transposed(raised(transposed(raised(s, by_v)), by_u));
}

BSplineSurface transposed(const BSplineSurface& s) {
  const BezierSurface turned = transposed(BezierSurface{s.net, s.weights});
  return {{s.degree[1], s.degree[0]}, {s.knots[1], s.knots[0]}, turned.net, turned.weights};
}

PatchGrid to_beziers(const BSplineSurface& s) {
  require_counts(s);
  PatchGrid grid;
  const auto strips = cut_columns(s);
  grid.columns = static_cast<int>(strips.size());
  std::vector<std::vector<BSplineSurface>> cut;
  for (const BSplineSurface& strip : strips) cut.push_back(cut_columns(transposed(strip)));
  grid.rows = static_cast<int>(cut[0].size());
  for (int i = 0; i < grid.rows; ++i)
    for (int j = 0; j < grid.columns; ++j)
      grid.patches.push_back(transposed(BezierSurface{cut[j][i].net, cut[j][i].weights}));
  return grid;
}

std::optional<BSplineSurface> joined(const PatchGrid& grid, const std::vector<double>& u,
                                     const std::vector<double>& v, double gap) {
  if (!cut_spans(u, grid.rows) || !cut_spans(v, grid.columns)) return std::nullopt;
  const int p = grid.patches.front().net.rows - 1;
  const int q = grid.patches.front().net.columns - 1;
  BSplineSurface s{{p, q}, {full_knots(u, p), full_knots(v, q)}, {}, {}};
  s.net.rows = p * grid.rows + 1;
  s.net.columns = q * grid.columns + 1;
  s.net.points.resize(static_cast<std::size_t>(s.net.rows) * s.net.columns);
  std::vector<bool> set(s.net.points.size(), false);
  for (int k = 0; k < grid.rows * grid.columns; ++k) {
    const BezierSurface& patch = grid.patches[static_cast<std::size_t>(k)];
    if (is_rational(patch) || patch.net.rows != p + 1 || patch.net.columns != q + 1)
      return std::nullopt;
    for (int i = 0; i <= p; ++i)
      for (int j = 0; j <= q; ++j) {
        const auto at = s.net.index(p * (k / grid.columns) + i, q * (k % grid.columns) + j);
        const Point3& point = patch.net.at(i, j);
        if (set[at] && !(distance(s.net.points[at], point) <= gap)) return std::nullopt;
        if (!set[at]) s.net.points[at] = point;
        set[at] = true;
      }
  }
  return s;
}

BSplineSurface to_bspline(const BezierSurface& s) {
  return {{s.net.rows - 1, s.net.columns - 1},
          {bezier_knots(s.net.rows), bezier_knots(s.net.columns)},
          s.net,
          s.weights};
}

}  // namespace keyline::surface
