#include "keyline/exchange/occt/geometry.h"

#include <GeomConvert.hxx>
#include <GeomConvert_ApproxCurve.hxx>
#include <GeomConvert_ApproxSurface.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_BezierSurface.hxx>
#include <Geom_Circle.hxx>
#include <Geom_ElementarySurface.hxx>
#include <Geom_Line.hxx>
#include <Geom_OffsetCurve.hxx>
#include <Geom_OffsetSurface.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Geom_SweptSurface.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <Precision.hxx>
#include <Standard_ConstructionError.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <algorithm>
#include <cmath>
#include <gp_Ax3.hxx>
#include <gp_Circ.hxx>
#include <utility>
#include <vector>

#include "keyline/core/angle.h"
#include "keyline/core/extent.h"
#include "keyline/document/arc.h"
#include "keyline/exchange/cad/flat_points.h"
#include "keyline/exchange/cad/spline_corners.h"

namespace keyline::exchange::occt {
namespace {

using core::Point3;
using curve::BSpline3;
using detail::are_flat;
using detail::flat;
using detail::kFlat;
using document::Label;

// Of what has no exact form.
constexpr double kTolerance = 1e-7;
constexpr int kDegree = 8;
constexpr int kMostSpans = 100;

Point3 point(const gp_Pnt& p) { return {p.X(), p.Y(), p.Z()}; }

void add_path(document::Document& document, document::PlanarCurve c, bool closed,
              const Label& label) {
  document.paths.push_back({label, {{std::move(c)}, closed}});
}

std::vector<double> full_knots(const TColStd_Array1OfReal& knots,
                               const TColStd_Array1OfInteger& times) {
  std::vector<double> full;
  for (int i = knots.Lower(); i <= knots.Upper(); ++i)
    full.insert(full.end(), static_cast<std::size_t>(times(i)), knots(i));
  return full;
}

bool add_line(document::Document& document, const Handle(Geom_Curve) & c, double first, double last,
              const Label& label) {
  if (Handle(Geom_Line)::DownCast(c).IsNull()) return false;
  const std::vector<Point3> ends{point(c->Value(first)), point(c->Value(last))};
  if (are_flat(ends))
    add_path(document, {curve::Bezier2{flat(ends), {}}}, false, label);
  else
    document.space_curves.push_back({label, {curve::Bezier3{ends, {}}}});
  return true;
}

bool add_arc(document::Document& document, const Handle(Geom_Curve) & c, double first, double last,
             const Label& label) {
  const auto circle = Handle(Geom_Circle)::DownCast(c);
  if (circle.IsNull()) return false;
  const gp_Circ circ = circle->Circ();
  const gp_Dir axis = circ.Axis().Direction();
  const Point3 center = point(circ.Location());
  const bool level = std::hypot(axis.X(), axis.Y()) <= kFlat;
  if (!level || std::abs(center.z) > kFlat * circ.Radius()) return false;
  const gp_Dir x = circ.XAxis().Direction();
  const double side = axis.Z() > 0 ? 1 : -1;
  const document::Arc arc{{center.x, center.y},
                          circ.Radius(),
                          core::wrap_angle(std::atan2(x.Y(), x.X()) + side * first),
                          side * (last - first)};
  lac::Chain chain = document::chain_of(arc);
  const bool closed = chain.closed;
  add_path(document, {std::move(chain)}, closed, label);
  return true;
}

Handle(Geom_Curve) basis_of(Handle(Geom_Curve) c) {
  while (const auto trimmed = Handle(Geom_TrimmedCurve)::DownCast(c)) c = trimmed->BasisCurve();
  return c;
}

bool is_offset(const Handle(Geom_Curve) & c) {
  return !Handle(Geom_OffsetCurve)::DownCast(basis_of(c)).IsNull();
}

/// A stretch of a period, from within [0, period) and of no more than one. What is left of a whole
/// one by rounding counts as whole: OCCT makes a sliver of what is too much and fails close to
/// minus one period.
void normalize(double& first, double& last, double period) {
  const double reach = Precision::PConfusion();
  const double length = last - first > period - reach ? period : last - first;
  first -= std::floor(first / period) * period;
  if (first < reach || first > period - reach) first = 0;
  last = first + length;
}

/// Exactly, or within `deviation` where there is no exact form: OCCT's own one of an offset curve
/// is within 1e-4 of whatever unit and does not say so.
Handle(Geom_BSplineCurve)
    converted(const Handle(Geom_Curve) & c, double first, double last, double& deviation) {
  const Handle(Geom_TrimmedCurve) part = new Geom_TrimmedCurve(c, first, last);
  if (!is_offset(c)) return GeomConvert::CurveToBSplineCurve(part);
  GeomConvert_ApproxCurve near(part, kTolerance, GeomAbs_C1, kMostSpans, kDegree);
  if (!near.HasResult()) throw Standard_ConstructionError("an offset curve has no form");
  deviation = std::max(deviation, near.MaxError());
  return near.Curve();
}

BSpline3 spline_of(const Handle(Geom_Curve) & c, double first, double last, double& deviation) {
  if (c->IsPeriodic()) normalize(first, last, c->Period());
  const Handle(Geom_BSplineCurve) spline = converted(c, first, last, deviation);
  if (spline->IsPeriodic()) spline->SetNotPeriodic();
  BSpline3 made;
  made.degree = spline->Degree();
  made.knots = full_knots(spline->Knots(), spline->Multiplicities());
  for (int i = 1; i <= spline->NbPoles(); ++i) made.control.push_back(point(spline->Pole(i)));
  if (spline->IsRational())
    for (int i = 1; i <= spline->NbPoles(); ++i) made.weights.push_back(spline->Weight(i));
  return made;
}

}  // namespace

document::SpaceCurve space_curve_of(const opencascade::handle<Geom_Curve>& whole, double first,
                                    double last, double& deviation) {
  const Handle(Geom_Curve) c = basis_of(whole);
  if (!Handle(Geom_Line)::DownCast(c).IsNull())
    return {curve::Bezier3{{point(c->Value(first)), point(c->Value(last))}, {}}};
  return {spline_of(c, first, last, deviation)};
}

void add_curve(document::Document& document, const opencascade::handle<Geom_Curve>& whole,
               double first, double last, const Label& label, double& deviation) {
  if (Precision::IsInfinite(first) || Precision::IsInfinite(last))
    throw Standard_ConstructionError("an unbounded curve");
  const Handle(Geom_Curve) c = basis_of(whole);
  if (add_line(document, c, first, last, label) || add_arc(document, c, first, last, label)) return;
  BSpline3 made = spline_of(c, first, last, deviation);
  if (!are_flat(made.control)) {
    document.space_curves.push_back({label, {std::move(made)}});
    return;
  }
  const bool closed =
      distance(made.control.front(), made.control.back()) <= kMeeting * core::reach(made.control);
  const curve::BSpline2 planar{made.degree, std::move(made.knots), flat(made.control),
                               std::move(made.weights)};
  document.paths.push_back({label, {detail::parted_at_corners(planar), closed}});
}

namespace {

/// Surfaces of revolution are turned so that they start at 0, their own frame being free.
Handle(Geom_Surface) trimmed(Handle(Geom_Surface) s, double u1, double u2, double v1, double v2) {
  if (s->IsUPeriodic()) {
    normalize(u1, u2, s->UPeriod());
    if (const auto elementary = Handle(Geom_ElementarySurface)::DownCast(s->Copy());
        !elementary.IsNull()) {
      gp_Ax3 frame = elementary->Position();
      frame.Rotate(frame.Axis(), frame.Direct() ? u1 : -u1);
      elementary->SetPosition(frame);
      s = elementary;
      u2 -= u1;
      u1 = 0;
    }
  }
  if (s->IsVPeriodic()) {
    normalize(v1, v2, s->VPeriod());
    if (v2 - v1 == s->VPeriod()) v2 -= std::exchange(v1, 0);
  }
  return new Geom_RectangularTrimmedSurface(s, u1, u2, v1, v2);
}

/// Whether its B-spline form is exact: offsets have one where they are of the same kind again.
bool has_exact_form(const Handle(Geom_Surface) & s) {
  if (const auto offset = Handle(Geom_OffsetSurface)::DownCast(s); !offset.IsNull())
    return !offset->Surface().IsNull();
  const auto swept = Handle(Geom_SweptSurface)::DownCast(s);
  return swept.IsNull() || !is_offset(swept->BasisCurve());
}

/// Exactly, or within `deviation` where there is no exact form.
Handle(Geom_BSplineSurface)
    converted(const Handle(Geom_Surface) & s, bool exact, double& deviation) {
  if (exact) try {
      return GeomConvert::SurfaceToBSplineSurface(s);
    } catch (const Standard_Failure&) {  // of a form that OCCT does not know
    }
  GeomConvert_ApproxSurface near(s, kTolerance, GeomAbs_C1, GeomAbs_C1, kDegree, kDegree,
                                 kMostSpans, 1);
  if (!near.HasResult()) throw Standard_ConstructionError("a surface has no form");
  deviation = near.MaxError();
  return near.Surface();
}

}  // namespace

surface::Surface surface_of(const opencascade::handle<Geom_Surface>& whole, double u1, double u2,
                            double v1, double v2, double& deviation) {
  deviation = 0;
  Handle(Geom_Surface) s = whole;
  while (const auto trimmed = Handle(Geom_RectangularTrimmedSurface)::DownCast(s))
    s = trimmed->BasisSurface();
  const bool free_form = !Handle(Geom_BSplineSurface)::DownCast(s).IsNull() ||
                         !Handle(Geom_BezierSurface)::DownCast(s).IsNull();
  const bool exact = has_exact_form(s);
  if (!free_form) s = trimmed(s, u1, u2, v1, v2);
  Handle(Geom_BSplineSurface) spline = converted(s, exact, deviation);
  spline = Handle(Geom_BSplineSurface)::DownCast(spline->Copy());
  if (spline->IsUPeriodic()) spline->SetUNotPeriodic();
  if (spline->IsVPeriodic()) spline->SetVNotPeriodic();
  surface::BSplineSurface made;
  made.degree = {spline->UDegree(), spline->VDegree()};
  made.knots = {full_knots(spline->UKnots(), spline->UMultiplicities()),
                full_knots(spline->VKnots(), spline->VMultiplicities())};
  made.net.rows = spline->NbUPoles();
  made.net.columns = spline->NbVPoles();
  const bool rational = spline->IsURational() || spline->IsVRational();
  for (int i = 1; i <= made.net.rows; ++i)
    for (int j = 1; j <= made.net.columns; ++j) {
      made.net.points.push_back(point(spline->Pole(i, j)));
      if (rational) made.weights.push_back(spline->Weight(i, j));
    }
  return made;
}

}  // namespace keyline::exchange::occt
