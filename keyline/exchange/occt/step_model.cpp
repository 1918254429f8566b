#include "keyline/exchange/occt/step_model.h"

#include <Interface_InterfaceModel.hxx>
#include <StepGeom_Axis2Placement3d.hxx>
#include <StepGeom_CartesianPoint.hxx>
#include <StepGeom_Direction.hxx>
#include <StepGeom_HArray1OfTrimmingSelect.hxx>
#include <StepGeom_Parabola.hxx>
#include <StepGeom_TrimmedCurve.hxx>
#include <TColStd_HArray1OfReal.hxx>
#include <TCollection_HAsciiString.hxx>
#include <cmath>
#include <gp_XYZ.hxx>
#include <optional>

namespace keyline::exchange::occt {
namespace {

using Placement = Handle(StepGeom_Axis2Placement3d);

/// Of length 1; empty for what is no direction in space.
std::optional<gp_XYZ> vector_of(const Handle(StepGeom_Direction) & d) {
  if (d.IsNull() || d->NbDirectionRatios() != 3) return {};
  const gp_XYZ v(d->DirectionRatiosValue(1), d->DirectionRatiosValue(2),
                 d->DirectionRatiosValue(3));
  const double length = v.Modulus();
  if (!(length > 0 && std::isfinite(length))) return {};
  return v / length;
}

Handle(StepGeom_Direction) direction_of(const gp_XYZ& v) {
  const Handle(TColStd_HArray1OfReal) ratios = new TColStd_HArray1OfReal(1, 3);
  for (int i = 1; i <= 3; ++i) ratios->SetValue(i, v.Coord(i));
  const Handle(StepGeom_Direction) made = new StepGeom_Direction;
  made->Init(new TCollection_HAsciiString(""), ratios);
  return made;
}

/// ISO 10303-42, first_proj_axis without a second argument: what (1, 0, 0), or (0, 1, 0) where z is
/// along x, has across z.
gp_XYZ first_axis(const gp_XYZ& z) {
  // x - (x z) z, its first component free of cancellation
  const double across = z.Y() * z.Y() + z.Z() * z.Z();
  return across > 0 ? gp_XYZ(across, -z.X() * z.Y(), -z.X() * z.Z()).Normalized() : gp_XYZ(0, 1, 0);
}

void complete(const Placement& placement) {
  if (!placement->HasAxis() || placement->Axis().IsNull())
    placement->SetAxis(direction_of({0, 0, 1}));
  if (placement->HasRefDirection() && !placement->RefDirection().IsNull()) return;
  if (const auto z = vector_of(placement->Axis()))
    placement->SetRefDirection(direction_of(first_axis(*z)));
}

/// The point of a parabola at a parameter; null where it has no frame.
Handle(StepGeom_CartesianPoint) point_at(const StepGeom_Parabola& parabola, double u) {
  const Placement placement = parabola.Position().Axis2Placement3d();
  if (placement.IsNull() || placement->Location().IsNull()) return {};
  const auto z = vector_of(placement->Axis());
  const auto reference = vector_of(placement->RefDirection());
  const auto center = placement->Location();
  if (!z || !reference || center->NbCoordinates() != 3) return {};
  const gp_XYZ across = *reference - *z * reference->Dot(*z);
  if (across.Modulus() == 0) return {};
  const gp_XYZ x = across.Normalized();
  const double f = parabola.FocalDist();
  const gp_XYZ from_center = x * (f * u * u) + z->Crossed(x) * (2 * f * u);
  const Handle(StepGeom_CartesianPoint) made = new StepGeom_CartesianPoint;
  made->Init3D(new TCollection_HAsciiString(""), center->CoordinatesValue(1) + from_center.X(),
               center->CoordinatesValue(2) + from_center.Y(),
               center->CoordinatesValue(3) + from_center.Z());
  return made;
}

using Trim = Handle(StepGeom_HArray1OfTrimmingSelect);

/// The end as a point alone: the file's own, or that of its parameter.
Trim as_point(const StepGeom_Parabola& parabola, const Trim& trim) {
  if (trim.IsNull()) return {};
  Handle(StepGeom_CartesianPoint) point;
  for (int i = trim->Lower(); i <= trim->Upper() && point.IsNull(); ++i)
    point = trim->Value(i).CartesianPoint();
  for (int i = trim->Lower(); i <= trim->Upper() && point.IsNull(); ++i)
    point = point_at(parabola, trim->Value(i).ParameterValue());
  if (point.IsNull()) return {};
  StepGeom_TrimmingSelect select;
  select.SetValue(point);
  const Trim made = new StepGeom_HArray1OfTrimmingSelect(1, 1);
  made->SetValue(1, select);
  return made;
}

void trim_by_points(const Handle(StepGeom_TrimmedCurve) & curve) {
  const auto parabola = Handle(StepGeom_Parabola)::DownCast(curve->BasisCurve());
  if (parabola.IsNull()) return;
  const Trim first = as_point(*parabola, curve->Trim1());
  const Trim last = as_point(*parabola, curve->Trim2());
  if (first.IsNull() || last.IsNull()) return;
  curve->SetTrim1(first);
  curve->SetTrim2(last);
  curve->SetMasterRepresentation(StepGeom_tpCartesian);
}

}  // namespace

void mend_step_model(const opencascade::handle<Interface_InterfaceModel>& model) {
  for (int i = 1; i <= model->NbEntities(); ++i)
    if (const auto placement = Placement::DownCast(model->Value(i)); !placement.IsNull())
      complete(placement);
  for (int i = 1; i <= model->NbEntities(); ++i)
    if (const auto curve = Handle(StepGeom_TrimmedCurve)::DownCast(model->Value(i));
        !curve.IsNull())
      trim_by_points(curve);
}

}  // namespace keyline::exchange::occt
