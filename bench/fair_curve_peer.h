#pragma once

#include <FairCurve_AnalysisCode.hxx>
#include <FairCurve_Batten.hxx>
#include <FairCurve_MinimalVariation.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <gp_Pnt2d.hxx>
#include <optional>
#include <vector>

#include "keyline/core/point.h"
#include "keyline/curve/bspline.h"

/// Peer of the benchmarks: OCCT's fair curves between (0, 0) and (1, 0).
namespace keyline {

/// Signed directions at both ends against the chord, as everywhere in Keyline. `physical_ratio` 0
/// is the least variation of curvature (FairCurve_MinimalVariation, its default). Empty where OCCT
/// finds none.
inline std::optional<curve::BSpline2> fair_curve(double from, double to,
                                                 double physical_ratio = 0) {
  FairCurve_MinimalVariation batten(gp_Pnt2d(0, 0), gp_Pnt2d(1, 0), 0.1, 0, physical_ratio);
  batten.SetFreeSliding(true);
  batten.SetAngle1(from);
  batten.SetAngle2(-to);  // counted clockwise at the second point
  FairCurve_AnalysisCode code = FairCurve_OK;
  if (!batten.Compute(code, 50, 1e-3)) return std::nullopt;
  const Handle(Geom2d_BSplineCurve) made = batten.Curve();
  curve::BSpline2 spline;
  spline.degree = made->Degree();
  for (int i = 1; i <= made->NbPoles(); ++i) {
    const gp_Pnt2d p = made->Pole(i);
    spline.control.push_back({p.X(), p.Y()});
  }
  for (int i = 1; i <= made->NbKnots(); ++i)
    for (int k = 0; k < made->Multiplicity(i); ++k) spline.knots.push_back(made->Knot(i));
  return spline;
}

}  // namespace keyline
