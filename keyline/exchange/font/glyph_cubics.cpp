#include "keyline/exchange/font/glyph_cubics.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "keyline/core/angle.h"
#include "keyline/curve/closest_point.h"
#include "keyline/curve/conversion.h"
#include "keyline/lac/chain/closest_point.h"
#include "keyline/numeric/roots.h"

namespace keyline::exchange::detail {
namespace {

using core::Point2;
using core::Vector2;
using curve::Bezier2;
using document::PlanarCurve;

constexpr int kSteps = 48;  // between breakpoints, to find changes of sign

/// What changes its sign at an extremum of x, of y, and at an inflection.
double watched(const PlanarCurve& c, double t, int which) {
  const curve::Jet2 j = jet(c, t);
  if (which == 0) return j.first.x;
  if (which == 1) return j.first.y;
  return cross(j.first, j.second);
}

/// Adds the parameters, not at breakpoints, where something changes its sign.
template <typename Watched>
void add_changes(std::vector<double>& nodes, const PlanarCurve& c, const Watched& watched) {
  const auto breaks = breakpoints(c);
  for (std::size_t i = 1; i < breaks.size(); ++i) {
    const double a = breaks[i - 1];
    const double step = (breaks[i] - a) / kSteps;
    const double inside = 1e-9 * (breaks[i] - a);
    for (int k = 0; k < kSteps; ++k) {
      const double from = a + k * step + (k == 0 ? inside : 0);
      const double to = a + (k + 1) * step - (k + 1 == kSteps ? inside : 0);
      if (const auto root = numeric::bracketed_root(watched, from, to, 0)) nodes.push_back(*root);
    }
  }
}

/// In order, those closer than this made one.
std::vector<double> parted(std::vector<double> nodes) {
  std::sort(nodes.begin(), nodes.end());
  std::vector<double> out;
  for (const double t : nodes)
    if (out.empty() || t - out.back() > 1e-4) out.push_back(t);
  out.back() = 1;
  return out;
}

/// Parameters at which nodes stand: breakpoints with a corner, extrema, inflections, both ends.
std::vector<double> node_parameters(const PlanarCurve& c) {
  const auto breaks = breakpoints(c);
  std::vector<double> nodes{0, 1};
  for (int which = 0; which < 3; ++which)
    add_changes(nodes, c, [&](double t) { return watched(c, t, which); });
  for (std::size_t i = 1; i + 1 < breaks.size(); ++i) {
    const double inside = 1e-9 * (breaks[i] - breaks[i - 1]);
    const auto before = jet(c, breaks[i] - inside).first;
    const auto after = jet(c, breaks[i] + inside).first;
    if (std::abs(core::angle_between(before, after)) > 1e-6) nodes.push_back(breaks[i]);
  }
  return parted(std::move(nodes));
}

/// A curve whose control points lie on a line to 1e-9 of its size, as lines between its ends and
/// the places where it turns back; none for others. Curvature is rounding alone there, and its
/// changes of sign are no inflections.
std::optional<GlyphCubics> straight_lines(const PlanarCurve& c,
                                          const std::vector<Point2>& control) {
  const Point2 start = control.front();
  const auto far =
      std::ranges::max_element(control, {}, [start](Point2 p) { return core::distance(start, p); });
  const Vector2 along = *far - start;
  GlyphCubics made;
  for (const Point2 p : control)
    made.deviation = std::max(made.deviation, std::abs(cross(along, p - start)) / norm(along));
  if (!(made.deviation <= 1e-9 * norm(along))) return std::nullopt;
  std::vector<double> nodes{0, 1};
  add_changes(nodes, c, [&](double t) { return dot(jet(c, t).first, along); });
  nodes = parted(std::move(nodes));
  for (std::size_t i = 1; i < nodes.size(); ++i)
    made.pieces.push_back({{evaluate(c, nodes[i - 1]), evaluate(c, nodes[i])}, {}});
  return made;
}

PlanarCurve part_of(const PlanarCurve& c, double t0, double t1) {
  if (const auto* chain = std::get_if<lac::Chain>(&c.value)) return {lac::part(*chain, t0, t1)};
  if (const auto* bezier = std::get_if<Bezier2>(&c.value))
    return {curve::subcurve(*bezier, t0, t1)};
  if (const auto* spline = std::get_if<curve::BSpline2>(&c.value))
    return {curve::subcurve(*spline, t0, t1)};
  return {curve::subcurve(std::get<curve::Polyline2>(c.value), t0, t1)};
}

/// Directions and curvatures at both ends.
struct Ends {
  Point2 a;
  Point2 b;
  Vector2 along_a;
  Vector2 along_b;
  double bend_a = 0;
  double bend_b = 0;
};

std::optional<Ends> ends_of(const PlanarCurve& c) {
  const double inside = 1e-9;
  const curve::Jet2 a = jet(c, inside);
  const curve::Jet2 b = jet(c, 1 - inside);
  const double la = norm(a.first);
  const double lb = norm(b.first);
  if (!(la > 0 && lb > 0)) return std::nullopt;
  Ends e{evaluate(c, 0), evaluate(c, 1), a.first / la, b.first / lb, curvature(a), curvature(b)};
  if (!std::isfinite(e.bend_a) || !std::isfinite(e.bend_b)) return std::nullopt;
  return e;
}

/// The cubic with tangents and curvatures of both ends ([de Boor 1987]): handles of
/// lengths f and g with 3/2 bend f^2 = distance of the other handle from the tangent, by Newton's
/// method from a third of the chord. Empty where it does not settle.
std::optional<Bezier2> curvature_cubic(const Ends& e) {
  const Vector2 chord = e.b - e.a;
  const double length = norm(chord);
  const double turn = cross(e.along_a, e.along_b);
  double f = length / 3;
  double g = f;
  bool settled = false;
  for (int i = 0; i < 40 && !settled; ++i) {
    // cross(along_a, b - g along_b - a) = 3/2 bend_a f^2, and the same seen from the other end.
    const double ra = cross(e.along_a, chord) - g * turn - 1.5 * e.bend_a * f * f;
    const double rb = cross(chord, e.along_b) - f * turn - 1.5 * e.bend_b * g * g;
    const double faf = -3 * e.bend_a * f;
    const double gbg = -3 * e.bend_b * g;
    const double det = faf * gbg - turn * turn;
    if (!(std::abs(det) > 0)) return std::nullopt;
    const double df = (gbg * ra + turn * rb) / det;
    const double dg = (faf * rb + turn * ra) / det;
    f -= df;
    g -= dg;
    settled = std::abs(df) + std::abs(dg) < 1e-12 * length;
  }
  const bool sound =
      settled && f > 0.02 * length && g > 0.02 * length && f < 2 * length && g < 2 * length;
  if (!sound) return std::nullopt;
  return Bezier2{{e.a, e.a + f * e.along_a, e.b - g * e.along_b, e.b}, {}};
}

/// One cubic, or those of both halves, halved up to `halvings` times.
void add_stretch(GlyphCubics& made, const PlanarCurve& c, double tolerance, int halvings = 4) {
  if (const auto ends = ends_of(c))
    if (auto cubic = curvature_cubic(*ends)) {
      const double deviation = measured_deviation(*cubic, c);
      if (deviation <= tolerance) {
        made.deviation = std::max(made.deviation, deviation);
        made.pieces.push_back(std::move(*cubic));
        return;
      }
    }
  if (halvings > 0) {
    add_stretch(made, part_of(c, 0, 0.5), tolerance, halvings - 1);
    return add_stretch(made, part_of(c, 0.5, 1), tolerance, halvings - 1);
  }
  auto cubics = std::visit(
      [&](const auto& v) { return curve::approximate_by_cubics(v, tolerance); }, c.value);
  made.deviation = std::max(made.deviation, cubics.deviation);
  for (Bezier2& piece : cubics.pieces)
    made.pieces.push_back(piece.control.size() == 3 ? curve::elevate_degree(piece)
                                                    : std::move(piece));
}

}  // namespace

double measured_deviation(const Bezier2& c, const PlanarCurve& exact) {
  double largest = 0;
  for (int i = 0; i <= 32; ++i) {
    const Point2 p = evaluate(c, i / 32.0);
    const double d =
        std::visit([&](const auto& v) { return closest_point(v, p).distance; }, exact.value);
    largest = std::max(largest, d);
  }
  return largest;
}

GlyphCubics glyph_cubics(const PlanarCurve& c, double tolerance) {
  GlyphCubics made;
  if (const auto* line = std::get_if<curve::Polyline2>(&c.value)) {
    for (std::size_t i = 1; i < line->points.size(); ++i)
      if (line->points[i] != line->points[i - 1])
        made.pieces.push_back({{line->points[i - 1], line->points[i]}, {}});
    return made;
  }
  if (const auto* bezier = std::get_if<Bezier2>(&c.value); bezier && bezier->control.size() == 2)
    return {{*bezier}, 0};
  const std::vector<Point2>* control = nullptr;
  if (const auto* bezier = std::get_if<Bezier2>(&c.value)) control = &bezier->control;
  if (const auto* spline = std::get_if<curve::BSpline2>(&c.value)) control = &spline->control;
  if (control != nullptr)
    if (auto lines = straight_lines(c, *control)) return *lines;
  const auto nodes = node_parameters(c);
  for (std::size_t i = 1; i < nodes.size(); ++i)
    add_stretch(made, part_of(c, nodes[i - 1], nodes[i]), tolerance);
  for (std::size_t i = 1; i < made.pieces.size(); ++i)
    made.pieces[i].control.front() = made.pieces[i - 1].control.back();
  return made;
}

}  // namespace keyline::exchange::detail
