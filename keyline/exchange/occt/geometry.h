#pragma once

#include "keyline/core/error.h"
#include "keyline/document/document.h"

namespace opencascade {
template <class T>
class handle;
}
class Geom_Curve;
class Geom_Surface;

/// Curves and surfaces of OCCT as Keyline's, exactly where they have a B-spline form. Only
/// keyline-cad uses this folder.
namespace keyline::exchange::occt {

/// Of a curve's size: ends no farther apart are one point, as what writes files rounds.
inline constexpr double kMeeting = 1e-7;

/// A planar path (z = 0) or a space curve from the part of a curve between two parameters: lines,
/// circular arcs in z = 0, else B-splines. deviation: raised to the largest distance from it where
/// it has no exact form. Throws Standard_Failure for what OCCT cannot convert.
void add_curve(document::Document& document, const opencascade::handle<Geom_Curve>& curve,
               double first, double last, const document::Label& label, double& deviation);

/// The part of a curve between two parameters: a straight Bézier or a B-spline. deviation, throws:
/// as above.
document::SpaceCurve space_curve_of(const opencascade::handle<Geom_Curve>& curve, double first,
                                    double last, double& deviation);

/// The B-spline form of the part of a surface in a box of parameters; B-spline and Bézier surfaces
/// whole. deviation: largest distance from it, 0 where the form is exact. Throws as above.
surface::Surface surface_of(const opencascade::handle<Geom_Surface>& surface, double u1, double u2,
                            double v1, double v2, double& deviation);

}  // namespace keyline::exchange::occt
