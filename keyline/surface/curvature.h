#pragma once

#include <optional>

#include "keyline/surface/jet.h"
#include "keyline/surface/surface.h"

namespace keyline::surface {

/// Tangent frame at a point: unit vectors e1 (along S_u), e2 = normal x e1, normal = S_u x S_v.
struct SurfaceFrame {
  core::Vector3 e1, e2, normal;
};

/// Empty where S_u and S_v are parallel to 1e-9, or one of them is below 1e-9 of the other or below
/// the rounding of the point's coordinates (1e-13).
std::optional<SurfaceFrame> frame_of(const SurfaceJet& jet);

/// Symmetric second fundamental form in an orthonormal frame of the tangent plane:
/// normal curvature in the direction (cos a) e1 + (sin a) e2 is
/// xx cos^2 a + 2 xy cos a sin a + yy sin^2 a, in 1/length, positive where the surface bends
/// towards the normal.
struct CurvatureForm {
  double xx = 0, xy = 0, yy = 0;
};

/// Curvature of the surface at a point, in 1/length; signs as in CurvatureForm.
struct SurfaceCurvature {
  double gaussian = 0;
  double mean = 0;
  double largest = 0;                ///< principal curvatures, largest >= smallest
  double smallest = 0;               ///< gaussian = largest * smallest, mean = half their sum
  core::Vector3 largest_direction;   ///< unit tangent vectors; any orthogonal pair where the two
  core::Vector3 smallest_direction;  ///< principal curvatures are equal
};

/// The form in the frame (x, y), any orthonormal pair of tangent vectors.
CurvatureForm curvature_form(const SurfaceJet& jet, const SurfaceFrame& frame);

/// Empty where frame_of is.
std::optional<SurfaceCurvature> curvature_of(const SurfaceJet& jet);

/// The jet at (u, v), or, where there is no normal (a collapsed edge, a pole), the jet 1e-3 of the
/// way towards the middle of the patch. Whether that one has a normal is for the caller to ask.
SurfaceJet jet_with_normal(const Surface& s, double u, double v);

}  // namespace keyline::surface
