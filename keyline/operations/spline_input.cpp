#include "keyline/operations/spline_input.h"

#include <algorithm>
#include <cmath>

#include "keyline/core/extent.h"
#include "keyline/curve/conversion.h"
#include "keyline/lac/cad/cad.h"

namespace keyline::operations {
namespace {

using core::Point3;
using core::Result;
using curve::BSpline3;

std::vector<Point3> lifted(const std::vector<core::Point2>& points) {
  std::vector<Point3> all;
  for (const core::Point2 p : points) all.push_back({p.x, p.y, 0});
  return all;
}

template <class Point>
BSpline3 as_spline(const curve::Bezier<Point>& c, std::vector<Point3> control) {
  std::vector<double> knots(control.size(), 0.0);
  knots.insert(knots.end(), control.size(), 1.0);
  return {static_cast<int>(control.size()) - 1, std::move(knots), std::move(control), c.weights};
}

/// Even knots over the points.
BSpline3 as_spline(std::vector<Point3> points) {
  BSpline3 s{1, {0}, std::move(points), {}};
  for (std::size_t i = 0; i < s.control.size(); ++i) s.knots.push_back(static_cast<double>(i));
  s.knots.push_back(static_cast<double>(s.control.size() - 1));
  return s;
}

/// One curve as a spline; what is not exact within the tolerance.
struct AsSpline {
  double tolerance;

  Result<SplineInput> operator()(const curve::Polyline2& c) const {
    return SplineInput{as_spline(lifted(c.points)), 0, true};
  }
  Result<SplineInput> operator()(const curve::Polyline3& c) const {
    return SplineInput{as_spline(c.points), 0, false};
  }
  Result<SplineInput> operator()(const curve::Bezier2& c) const {
    return SplineInput{as_spline(c, lifted(c.control)), 0, true};
  }
  Result<SplineInput> operator()(const curve::Bezier3& c) const {
    return SplineInput{as_spline(c, c.control), 0, false};
  }
  Result<SplineInput> operator()(const curve::BSpline2& c) const {
    return SplineInput{{c.degree, c.knots, lifted(c.control), c.weights}, 0, true};
  }
  Result<SplineInput> operator()(const BSpline3& c) const { return SplineInput{c, 0, false}; }
  Result<SplineInput> operator()(const lac::Chain& c) const {
    const auto made = lac::to_bspline(c, {5, tolerance, true});
    if (!made) return std::unexpected(made.error());
    const curve::BSpline2& s = made->curve;
    return SplineInput{{s.degree, s.knots, lifted(s.control), s.weights}, made->deviation, true};
  }
  Result<SplineInput> operator()(const lac::SpaceChain& c) const {
    const lac::SpaceBeziers made = lac::approximate_by_quintics(c, tolerance);
    auto spline = curve::to_bspline(made.pieces, tolerance);
    if (!spline) return std::unexpected(spline.error());
    return SplineInput{std::move(*spline), made.deviation, false};
  }
};

Result<SplineInput> joined(const std::vector<SplineInput>& parts, double tolerance) {
  if (parts.size() == 1) return parts.front();
  SplineInput whole;
  std::vector<curve::Bezier3> pieces;
  for (const SplineInput& part : parts) {
    for (auto& piece : curve::to_beziers(part.curve)) pieces.push_back(std::move(piece));
    whole.deviation = std::max(whole.deviation, part.deviation);
    whole.planar = whole.planar && part.planar;
  }
  auto spline = curve::to_bspline(pieces, tolerance);
  if (!spline) return std::unexpected(spline.error());
  whole.curve = std::move(*spline);
  return whole;
}

template <class Curve>
Result<SplineInput> of_members(const std::vector<Curve>& members, double tolerance) {
  std::vector<SplineInput> parts;
  for (const Curve& member : members) {
    auto part = std::visit(AsSpline{tolerance}, member.value);
    if (!part) return part;
    parts.push_back(std::move(*part));
  }
  return joined(parts, tolerance);
}

/// Box of the points and lengths of all members seen.
struct Measure {
  core::Box3 box;
  double length = 0;

  template <class Point>
  void operator()(const curve::Polyline<Point>& c) {
    for (const Point& p : c.points) box.take(p);
  }
  template <class Curve>
  void operator()(const Curve& c) {
    if constexpr (requires { c.control; })
      for (const auto& p : c.control) box.take(p);
    else
      for (const auto& piece : c.pieces) length += std::abs(piece.length);
  }
  double size() const { return std::max(longest_side(box), length); }
};

}  // namespace

Result<SplineInput> spline_of(const AnyCurve& curve, double tolerance) {
  if (const auto path = planar_path(curve)) return of_members(path->curves, tolerance);
  if (const auto* path = std::get_if<SpacePath>(&curve)) return of_members(path->curves, tolerance);
  return std::visit(AsSpline{tolerance}, std::get<document::SpaceCurve>(curve).value);
}

double size_of(const AnyCurve& curve) {
  Measure measure;
  const auto visit = [&](const auto& c) {
    std::visit([&](const auto& v) { measure(v); }, c.value);
  };
  if (const auto path = planar_path(curve))
    for (const auto& member : path->curves) visit(member);
  else if (const auto* space = std::get_if<SpacePath>(&curve))
    for (const auto& member : space->curves) visit(member);
  else
    visit(std::get<document::SpaceCurve>(curve));
  const double size = measure.size();
  return size > 0 && std::isfinite(size) ? size : 1;
}

}  // namespace keyline::operations
