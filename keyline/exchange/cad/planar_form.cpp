#include "keyline/exchange/cad/planar_form.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "keyline/core/extent.h"
#include "keyline/core/text.h"
#include "keyline/exchange/svg/cubic_path.h"

namespace keyline::exchange {
namespace {

using core::Point2;
using core::Point3;

std::optional<acquire::PlaneFit> plane_of_points(const std::vector<Point3>& points, double most) {
  auto fit = acquire::fit_plane(points);
  const double size = core::reach(points);
  if (!(size > 0) || fit.departure > most * size) return std::nullopt;
  if (fit.departure <= kExactly * size) fit.departure = 0;
  return fit;
}

std::vector<Point2> in_plane(const acquire::Plane& plane, const std::vector<Point3>& points) {
  std::vector<Point2> result;
  for (const Point3 p : points) result.push_back(acquire::to_plane(plane, p));
  return result;
}

}  // namespace

std::string in_words(const acquire::Plane& plane) {
  const auto at = [](double v) { return core::number_text(v + 0.0, 6); };
  if (plane.axis_x == core::Vector3{1, 0, 0} && plane.axis_y == core::Vector3{0, 1, 0})
    return "in the plane z = " + at(plane.origin.z) + "; x and y";
  if (plane.axis_x == core::Vector3{1, 0, 0} && plane.axis_y == core::Vector3{0, 0, 1})
    return "in the plane y = " + at(plane.origin.y) + "; x and z";
  if (plane.axis_x == core::Vector3{0, 1, 0} && plane.axis_y == core::Vector3{0, 0, 1})
    return "in the plane x = " + at(plane.origin.x) + "; y and z";
  return "in a plane of its own";
}

std::optional<PlanarForm> planar_form(const document::SpaceCurve& curve, double most) {
  if (const auto* line = std::get_if<curve::Polyline3>(&curve.value)) {
    const auto fit = plane_of_points(line->points, most);
    if (!fit) return std::nullopt;
    return PlanarForm{
        {curve::Polyline2{in_plane(fit->plane, line->points)}}, fit->plane, fit->departure};
  }
  if (const auto* c = std::get_if<curve::Bezier3>(&curve.value)) {
    const auto fit = plane_of_points(c->control, most);
    if (!fit) return std::nullopt;
    return PlanarForm{
        {curve::Bezier2{in_plane(fit->plane, c->control), c->weights}}, fit->plane, fit->departure};
  }
  if (const auto* c = std::get_if<curve::BSpline3>(&curve.value)) {
    const auto fit = plane_of_points(c->control, most);
    if (!fit) return std::nullopt;
    return PlanarForm{
        {curve::BSpline2{c->degree, c->knots, in_plane(fit->plane, c->control), c->weights}},
        fit->plane,
        fit->departure};
  }
  return std::nullopt;
}

std::vector<Laid> flatten(document::Document& document, double most) {
  std::vector<Laid> planes;
  std::vector<document::NamedSpaceCurve> left;
  for (auto& named : document.space_curves) {
    const bool polygon = std::holds_alternative<curve::Polyline3>(named.curve.value);
    auto form = planar_form(named.curve, polygon ? most : kExactly);
    if (!form) {
      left.push_back(std::move(named));
      continue;
    }
    planes.push_back({form->plane, named.half_breadth, form->departure});
    document::NamedPath path;
    path.label = named.label;
    path.path.closed = distance(evaluate(form->curve, 0), evaluate(form->curve, 1)) == 0;
    path.path.curves.push_back(std::move(form->curve));
    document.paths.push_back(std::move(path));
  }
  document.space_curves = std::move(left);
  return planes;
}

document::SpaceCurve placed(const document::Path& path, const acquire::Plane& plane,
                            double tolerance) {
  curve::BSpline3 spline;
  double knot = 0;
  spline.knots.push_back(knot);
  for (curve::Bezier2 piece : cubic_path(path, "", tolerance).path.pieces) {
    const int missing = 4 - static_cast<int>(piece.control.size());
    if (missing > 0) piece = curve::elevate_degree(piece, missing);
    if (spline.control.empty())
      spline.control.push_back(acquire::from_plane(plane, piece.control[0]));
    spline.knots.insert(spline.knots.end(), 3, knot);
    for (std::size_t i = 1; i < 4; ++i)
      spline.control.push_back(acquire::from_plane(plane, piece.control[i]));
    knot += 1;
  }
  spline.knots.insert(spline.knots.end(), 4, knot);
  for (double& k : spline.knots) k /= std::max(knot, 1.0);
  return {std::move(spline)};
}

}  // namespace keyline::exchange
