#include "keyline/exchange/dxf/dxf_shape.h"

#include <algorithm>
#include <cmath>

#include "keyline/core/angle.h"
#include "keyline/curve/conversion.h"
#include "keyline/document/arc.h"
#include "keyline/exchange/cad/flat_points.h"
#include "keyline/exchange/cad/spline_corners.h"

namespace keyline::exchange::detail {
namespace {

using core::Point2;
using core::Point3;
using core::Vector3;
using curve::Bezier3;

Point3 on(const EllipseArc& e, double t, double reach = 1) {
  return e.center + reach * (std::cos(t) * e.major + std::sin(t) * e.minor);
}

/// Rational quadratics of at most a quarter turn each.
std::vector<Bezier3> quadratics(const EllipseArc& e) {
  const double quarters = std::abs(e.to - e.from) / (core::kPi / 2);
  const int count = std::clamp(static_cast<int>(std::ceil(quarters - 1e-9)), 1, 4);
  const double step = (e.to - e.from) / count;
  const double weight = std::cos(step / 2);
  std::vector<Bezier3> pieces;
  Point3 last = on(e, e.from);
  for (int i = 0; i < count; ++i) {
    const double t = e.from + i * step;
    const Point3 end = on(e, i + 1 == count ? e.to : t + step);
    pieces.push_back({{last, on(e, t + step / 2, 1 / weight), end}, {1, weight, 1}});
    last = end;
  }
  const bool whole = std::abs(e.to - e.from) >= 2 * core::kPi * (1 - kFlat);
  if (whole) pieces.back().control.back() = pieces.front().control.front();
  return pieces;
}

template <class Visit>
void for_each_point(const DxfShape& shape, Visit&& visit) {
  if (const auto* line = std::get_if<curve::Polyline3>(&shape))
    for (const Point3& p : line->points) visit(p);
  if (const auto* e = std::get_if<EllipseArc>(&shape)) {
    visit(e->center + e->major);
    visit(e->center + e->minor);
    visit(e->center - e->major);
  }
  if (const auto* pieces = std::get_if<std::vector<Bezier3>>(&shape))
    for (const Bezier3& piece : *pieces)
      for (const Point3& p : piece.control) visit(p);
  if (const auto* spline = std::get_if<curve::BSpline3>(&shape))
    for (const Point3& p : spline->control) visit(p);
}

bool is_flat(const DxfShape& shape) {
  std::vector<Point3> points;
  for_each_point(shape, [&](Point3 p) { points.push_back(p); });
  return are_flat(points);
}

/// The circle an ellipse in z = 0 is; empty where it is none.
std::optional<document::Arc> circle_of(const EllipseArc& e) {
  const core::Vector2 a{e.major.x, e.major.y};
  const core::Vector2 b{e.minor.x, e.minor.y};
  const double r = norm(a);
  if (std::abs(norm(b) - r) > kFlat * r || std::abs(dot(a, b)) > kFlat * r * r) return std::nullopt;
  const double side = cross(a, b) > 0 ? 1 : -1;
  const double start = core::wrap_angle(core::direction_of(a) + side * e.from);
  return document::Arc{{e.center.x, e.center.y}, r, start, side * (e.to - e.from)};
}

std::vector<document::PlanarCurve> flat_curves(const DxfShape& shape) {
  if (const auto* line = std::get_if<curve::Polyline3>(&shape)) {
    if (line->points.size() == 2) return {{curve::Bezier2{flat(line->points), {}}}};
    return {{curve::Polyline2{flat(line->points)}}};
  }
  if (const auto* spline = std::get_if<curve::BSpline3>(&shape))
    return parted_at_corners(
        {spline->degree, spline->knots, flat(spline->control), spline->weights});
  const auto* ellipse = std::get_if<EllipseArc>(&shape);
  if (ellipse)
    if (const auto arc = circle_of(*ellipse)) return {{document::chain_of(*arc)}};
  const auto& pieces = ellipse ? quadratics(*ellipse) : std::get<std::vector<Bezier3>>(shape);
  std::vector<document::PlanarCurve> curves;
  for (const Bezier3& piece : pieces)
    curves.push_back({curve::Bezier2{flat(piece.control), piece.weights}});
  return curves;
}

document::SpaceCurve space_curve(const DxfShape& shape) {
  if (const auto* line = std::get_if<curve::Polyline3>(&shape)) return {*line};
  if (const auto* spline = std::get_if<curve::BSpline3>(&shape)) return {*spline};
  const auto* ellipse = std::get_if<EllipseArc>(&shape);
  const auto& pieces = ellipse ? quadratics(*ellipse) : std::get<std::vector<Bezier3>>(shape);
  if (pieces.size() == 1) return {pieces.front()};
  return {curve::to_bspline(pieces, 0).value()};
}

/// Straight or circular edge from a to b.
void add_edge(std::vector<Bezier3>& pieces, const BulgeVertex& a, Point3 b) {
  const double turn = 4 * std::atan(a.bulge);
  if (turn == 0) {
    pieces.push_back({{a.point, b}, {}});
    return;
  }
  const Vector3 half = 0.5 * (b - a.point);
  const Vector3 left{-half.y, half.x, 0};
  // One piece needs no centre: that of a slight arc is so far away that differences from it are
  // rounding alone.
  if (std::abs(turn) <= core::kPi / 2) {
    const double square = a.bulge * a.bulge;
    const Point3 handle = a.point + half - (2 * a.bulge / (1 - square)) * left;
    pieces.push_back({{a.point, handle, b}, {1, (1 - square) / (1 + square), 1}});
    return;
  }
  // The centre lies cot(turn / 2) half chords to the left of the chord's middle.
  const double k = (1 - a.bulge * a.bulge) / (2 * a.bulge);
  EllipseArc arc;
  arc.center = a.point + half + k * left;
  arc.major = a.point - arc.center;
  arc.minor = {-arc.major.y, arc.major.x, 0};
  arc.to = turn;
  std::vector<Bezier3> bent = quadratics(arc);
  bent.front().control.front() = a.point;
  bent.back().control.back() = b;
  std::move(bent.begin(), bent.end(), std::back_inserter(pieces));
}

/// Slopes at the knots of the C2 cubic; natural or clamped ends (tridiagonal system).
std::vector<Vector3> spline_slopes(const std::vector<Point3>& p, const std::vector<double>& h,
                                   Vector3 start, Vector3 end) {
  const std::size_t n = p.size();
  std::vector<double> diagonal(n, 1);
  std::vector<double> upper(n, 0);
  std::vector<Vector3> right(n);
  const auto chord = [&](std::size_t i) { return (p[i + 1] - p[i]) / h[i]; };
  const auto direction = [](Vector3 v) { return v / norm(v); };
  const bool held_start = norm(start) > 0;
  const bool held_end = norm(end) > 0;
  diagonal[0] = held_start ? 1 : 2;
  upper[0] = held_start ? 0 : 1;
  right[0] = held_start ? direction(start) : 3 * chord(0);
  for (std::size_t i = 1; i < n; ++i) {
    const bool last = i + 1 == n;
    double lower = 0;
    if (!last) {
      lower = h[i];
      diagonal[i] = 2 * (h[i - 1] + h[i]);
      upper[i] = h[i - 1];
      right[i] = 3 * (h[i] * chord(i - 1) + h[i - 1] * chord(i));
    } else if (held_end) {
      right[i] = direction(end);
    } else {
      lower = 1;
      diagonal[i] = 2;
      right[i] = 3 * chord(i - 1);
    }
    const double factor = lower / diagonal[i - 1];
    diagonal[i] -= factor * upper[i - 1];
    right[i] = right[i] - factor * right[i - 1];
  }
  std::vector<Vector3> slope(n);
  for (std::size_t i = n; i-- > 0;)
    slope[i] = (right[i] - (i + 1 < n ? upper[i] * slope[i + 1] : Vector3{})) / diagonal[i];
  return slope;
}

}  // namespace

DxfShape mapped(const DxfShape& shape, const Affine3& map) {
  DxfShape result = shape;
  const auto move = [&](std::vector<Point3>& points) {
    for (Point3& p : points) p = apply(map, p);
  };
  if (auto* line = std::get_if<curve::Polyline3>(&result)) move(line->points);
  if (auto* spline = std::get_if<curve::BSpline3>(&result)) move(spline->control);
  if (auto* pieces = std::get_if<std::vector<Bezier3>>(&result))
    for (Bezier3& piece : *pieces) move(piece.control);
  if (auto* e = std::get_if<EllipseArc>(&result))
    *e = {apply(map, e->center), apply(map, e->major), apply(map, e->minor), e->from, e->to};
  return result;
}

std::size_t point_count(const DxfShape& shape) {
  if (std::holds_alternative<EllipseArc>(shape)) return 12;
  std::size_t count = 4;
  for_each_point(shape, [&](Point3) { ++count; });
  return count;
}

bool is_finite(const DxfShape& shape) {
  bool finite = true;
  for_each_point(shape, [&](Point3 p) { finite = finite && core::is_finite(p); });
  return finite;
}

core::Result<void> add_shape(document::Document& document, const DxfShape& shape, bool closed,
                             document::Label label) {
  if (is_flat(shape)) {
    document::Path path{flat_curves(shape), closed};
    if (auto sound = validate(path); !sound) return sound;
    document.paths.push_back({std::move(label), std::move(path), 0});
    return {};
  }
  document::SpaceCurve curve = space_curve(shape);
  if (auto sound = validate(curve); !sound) return sound;
  document.space_curves.push_back({std::move(label), std::move(curve)});
  return {};
}

Affine3 extrusion_frame(Vector3 direction) {
  const double length = norm(direction);
  if (!(length > 0) || !std::isfinite(length)) return {};
  const Vector3 z = direction / length;
  if (z == Vector3{0, 0, 1}) return {};
  const bool near_z = std::abs(z.x) < 1.0 / 64 && std::abs(z.y) < 1.0 / 64;
  const Vector3 x = cross(near_z ? Vector3{0, 1, 0} : Vector3{0, 0, 1}, z);
  const Vector3 unit = x / norm(x);
  return {unit, cross(z, unit), z, {}};
}

DxfShape polyline_shape(const std::vector<BulgeVertex>& vertices, bool closed) {
  std::vector<BulgeVertex> kept;
  for (const BulgeVertex& v : vertices) {
    if (!kept.empty() && kept.back().point == v.point) kept.pop_back();
    kept.push_back(v);
  }
  if (closed && kept.size() > 1 && kept.front().point != kept.back().point)
    kept.push_back({kept.front().point, 0});
  const bool bent = std::any_of(kept.begin(), kept.empty() ? kept.end() : kept.end() - 1,
                                [](const BulgeVertex& v) { return v.bulge != 0; });
  if (!bent) {
    curve::Polyline3 line;
    for (const BulgeVertex& v : kept) line.points.push_back(v.point);
    return line;
  }
  std::vector<Bezier3> pieces;
  for (std::size_t i = 1; i < kept.size(); ++i) add_edge(pieces, kept[i - 1], kept[i].point);
  return pieces;
}

std::vector<Bezier3> fit_point_spline(std::vector<Point3> p, Vector3 start, Vector3 end,
                                      bool closed) {
  if (closed && p.front() != p.back()) p.push_back(p.front());
  // A periodic spline is that of the points run through again and again: what lies twenty points
  // away counts less than 1e-11.
  const std::size_t spans = p.size() - 1;
  const std::size_t around = closed ? std::min<std::size_t>(20, 20 * spans) : 0;
  std::vector<Point3> points;
  for (std::size_t i = 0; i < p.size() + 2 * around; ++i)
    points.push_back(closed ? p[(i + 20 * spans - around) % spans] : p[i]);
  std::vector<double> h;
  for (std::size_t i = 1; i < points.size(); ++i) h.push_back(distance(points[i - 1], points[i]));
  const auto slope = spline_slopes(points, h, closed ? Vector3{} : start, closed ? Vector3{} : end);
  std::vector<Bezier3> pieces;
  for (std::size_t i = around; i < around + spans; ++i) {
    const double third = h[i] / 3;
    pieces.push_back({{points[i], points[i] + third * slope[i],
                       points[i + 1] - third * slope[i + 1], points[i + 1]},
                      {}});
  }
  return pieces;
}

}  // namespace keyline::exchange::detail
