#pragma once

#include <vector>

#include "keyline/core/error.h"
#include "keyline/curve/bspline.h"
#include "keyline/surface/bspline_surface.h"

namespace keyline::surface {

struct GordonOptions {
  double tolerance = 1e-3;  ///< largest distance of the curves from the surface
  double gap = 1e-3;        ///< by which curves may miss each other
};

struct GordonSurface {
  BSplineSurface surface;
  double deviation =
      0;           ///< largest distance of the curves from the surface, at eight places a span
  double gap = 0;  ///< largest by which curves miss each other
};

/// The surface through curves that cross like warp and weft: two along u and two along v are the
/// borders of a patch (Coons), more in between are sections (Gordon). Curves may be given in any
/// order and direction; what reaches beyond the outermost is cut off.
///
/// S = U + V - T: U passes through the curves along u, V through those along v, T through their
/// crossings, across with polynomials of the least change (linear between two curves, cubic splines
/// from four on), by shares of the curves' parameters or of their lengths, whichever takes fewer
/// patches. It is held as a bicubic B-spline whose
/// spans are halved until the curves lie on it within the tolerance: its Bezier patches join with
/// equal curvature (C2).
///
/// Fails: bad_input for fewer than two curves either way, for curves that miss each other, meet one
///        of their own direction or cross in different orders; not_converged where 128 spans are
///        not enough (a curve has a corner).
/// Source: [Gordon 1969], the Boolean sum of the interpolations in u and v; with two curves each
///         way [Coons 1967].
core::Result<GordonSurface> gordon_surface(const std::vector<curve::BSpline3>& along_u,
                                           const std::vector<curve::BSpline3>& along_v,
                                           const GordonOptions& options = {});

}  // namespace keyline::surface
