#include "keyline/exchange/occt/shapes.h"

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRep_Builder.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_Circle.hxx>
#include <Geom_Line.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Vertex.hxx>
#include <TopoDS_Wire.hxx>
#include <algorithm>
#include <cmath>
#include <gp_Ax2.hxx>
#include <stdexcept>
#include <vector>

#include "keyline/core/angle.h"
#include "keyline/curve/bspline.h"
#include "keyline/document/arc.h"
#include "keyline/exchange/cad/flat_points.h"

namespace keyline::exchange::occt {
namespace {

using core::Point3;
using curve::BSpline3;
using detail::lifted;

constexpr double kTolerance = 1e-7;

gp_Pnt point(Point3 p) { return {p.x, p.y, p.z}; }

/// A curve with the parameters it runs between.
struct CurvePart {
  Handle(Geom_Curve) curve;
  double first = 0;
  double last = 0;
};

/// Distinct knots and how often each stands.
struct Knots {
  std::vector<double> values;
  std::vector<int> times;

  explicit Knots(const std::vector<double>& full) {
    for (const double knot : full) {
      if (values.empty() || knot != values.back()) {
        values.push_back(knot);
        times.push_back(0);
      }
      ++times.back();
    }
  }
  int size() const { return static_cast<int>(values.size()); }
};

TColStd_Array1OfReal array(const std::vector<double>& values) {
  TColStd_Array1OfReal made(1, static_cast<int>(values.size()));
  for (int i = 1; i <= made.Upper(); ++i) made(i) = values[static_cast<std::size_t>(i - 1)];
  return made;
}

TColStd_Array1OfInteger array(const std::vector<int>& values) {
  TColStd_Array1OfInteger made(1, static_cast<int>(values.size()));
  for (int i = 1; i <= made.Upper(); ++i) made(i) = values[static_cast<std::size_t>(i - 1)];
  return made;
}

CurvePart spline_part(const BSpline3& given) {
  const BSpline3 c = curve::clamp_ends(given);
  TColgp_Array1OfPnt poles(1, static_cast<int>(c.control.size()));
  for (int i = 1; i <= poles.Upper(); ++i)
    poles(i) = point(c.control[static_cast<std::size_t>(i - 1)]);
  const Knots knots(c.knots);
  Handle(Geom_BSplineCurve) spline =
      c.weights.empty()
          ? new Geom_BSplineCurve(poles, array(knots.values), array(knots.times), c.degree)
          : new Geom_BSplineCurve(poles, array(c.weights), array(knots.values), array(knots.times),
                                  c.degree);
  return {spline, spline->FirstParameter(), spline->LastParameter()};
}

BSpline3 bezier_spline(const std::vector<Point3>& control, const std::vector<double>& weights) {
  const std::size_t n = control.size();
  std::vector<double> knots(2 * n, 0);
  std::fill(knots.begin() + static_cast<std::ptrdiff_t>(n), knots.end(), 1);
  return {static_cast<int>(n) - 1, knots, control, weights};
}

CurvePart line_part(Point3 a, Point3 b) {
  const double length = distance(a, b);
  const gp_Dir direction((b.x - a.x) / length, (b.y - a.y) / length, (b.z - a.z) / length);
  return {new Geom_Line(point(a), direction), 0, length};
}

/// The polygon as a spline of degree 1, knots by length.
BSpline3 polygon_spline(const std::vector<Point3>& points) {
  BSpline3 c{1, {0}, {}, {}};
  for (const Point3 p : points) {
    if (!c.control.empty() && c.control.back() == p) continue;
    const double step = c.control.empty() ? 0 : distance(c.control.back(), p);
    c.knots.push_back(c.knots.back() + step);
    c.control.push_back(p);
  }
  c.knots.push_back(c.knots.back());
  return c;
}

CurvePart arc_part(const document::Arc& arc) {
  const double side = arc.turn > 0 ? 1 : -1;
  const gp_Dir x(std::cos(arc.start), std::sin(arc.start), 0);
  const gp_Ax2 axes(point(Point3{arc.center.x, arc.center.y, 0}), gp_Dir(0, 0, side), x);
  return {new Geom_Circle(axes, arc.radius), 0, std::min(std::abs(arc.turn), 2 * core::kPi)};
}

CurvePart curve_of(const document::SpaceCurve& c);

CurvePart curve_of(const document::PlanarCurve& c) {
  if (const auto* chain = std::get_if<lac::Chain>(&c.value)) {
    const auto arc = document::as_arc(lac::segment_at(*chain, 0));
    if (!arc || chain->pieces.size() != 1)
      throw core::InvalidInput("only circular arcs are passed to keyline-cad as chains");
    return arc_part(*arc);
  }
  if (const auto* line = std::get_if<curve::Polyline2>(&c.value))
    return spline_part(polygon_spline(lifted(line->points)));
  if (const auto* spline = std::get_if<curve::BSpline2>(&c.value))
    return spline_part({spline->degree, spline->knots, lifted(spline->control), spline->weights});
  const auto& bezier = std::get<curve::Bezier2>(c.value);
  return curve_of(document::SpaceCurve{curve::Bezier3{lifted(bezier.control), bezier.weights}});
}

CurvePart curve_of(const document::SpaceCurve& c) {
  if (const auto* line = std::get_if<curve::Polyline3>(&c.value))
    return spline_part(polygon_spline(line->points));
  if (const auto* spline = std::get_if<BSpline3>(&c.value)) return spline_part(*spline);
  const auto& bezier = std::get<curve::Bezier3>(c.value);
  if (bezier.control.size() == 2 && bezier.control[0] != bezier.control[1])
    return line_part(bezier.control[0], bezier.control[1]);
  return spline_part(bezier_spline(bezier.control, bezier.weights));
}

Handle(Geom_BSplineSurface) spline_surface_of(const surface::Surface& s) {
  const auto* bezier = std::get_if<surface::BezierSurface>(&s);
  const surface::BSplineSurface given =
      bezier ? surface::to_bspline(*bezier) : std::get<surface::BSplineSurface>(s);
  TColgp_Array2OfPnt poles(1, given.net.rows, 1, given.net.columns);
  TColStd_Array2OfReal weights(1, given.net.rows, 1, given.net.columns);
  for (int i = 1; i <= given.net.rows; ++i)
    for (int j = 1; j <= given.net.columns; ++j) {
      poles(i, j) = point(given.net.at(i - 1, j - 1));
      weights(i, j) = given.weights.empty() ? 1 : given.weights[given.net.index(i - 1, j - 1)];
    }
  const Knots u(given.knots[0]);
  const Knots v(given.knots[1]);
  return new Geom_BSplineSurface(poles, weights, array(u.values), array(v.values), array(u.times),
                                 array(v.times), given.degree[0], given.degree[1]);
}

TopoDS_Shape part_edge(const CurvePart& part) {
  BRepBuilderAPI_MakeEdge make(part.curve, part.first, part.last);
  if (!make.IsDone()) throw std::runtime_error("a curve cannot be written; it may have no length");
  return make.Edge();
}

}  // namespace

TopoDS_Shape shape_of(const document::Path& path) {
  if (path.curves.size() == 1) return part_edge(curve_of(path.curves.front()));
  // Neighbours share a vertex: what goes along a wire finds its way by them.
  BRep_Builder builder;
  TopoDS_Wire wire;
  builder.MakeWire(wire);
  const auto vertex = [&](const CurvePart& part, double at) {
    TopoDS_Vertex made;
    builder.MakeVertex(made, part.curve->Value(at), kTolerance);
    return made;
  };
  TopoDS_Vertex first;
  TopoDS_Vertex last;
  for (const document::PlanarCurve& c : path.curves) {
    const CurvePart part = curve_of(c);
    if (first.IsNull()) first = last = vertex(part, part.first);
    const bool closes = path.closed && &c == &path.curves.back();
    const TopoDS_Vertex end = closes ? first : vertex(part, part.last);
    TopoDS_Edge edge;
    builder.MakeEdge(edge, part.curve, kTolerance);
    builder.Add(edge, last.Oriented(TopAbs_FORWARD));
    builder.Add(edge, end.Oriented(TopAbs_REVERSED));
    builder.Range(edge, part.first, part.last);
    builder.Add(wire, edge);
    last = end;
  }
  wire.Closed(path.closed);
  return wire;
}

TopoDS_Shape edge_of(const document::SpaceCurve& curve) { return part_edge(curve_of(curve)); }

TopoDS_Shape face_of(const surface::Surface& surface) {
  BRepBuilderAPI_MakeFace make(spline_surface_of(surface), kTolerance);
  if (!make.IsDone()) throw std::runtime_error("a surface cannot be written; it may be degenerate");
  return make.Face();
}

}  // namespace keyline::exchange::occt
