#pragma once

#include <optional>
#include <vector>

#include "keyline/core/describe.h"
#include "keyline/core/error.h"
#include "keyline/core/interval.h"
#include "keyline/surface/sample_grid.h"

namespace keyline::surface {

enum class FieldKind { gaussian, mean, principal, zebra, isophote, reflection, highlight };
constexpr auto choices(const FieldKind*) {
  return core::words<FieldKind>({{FieldKind::gaussian, "gaussian"},
                                 {FieldKind::mean, "mean"},
                                 {FieldKind::principal, "principal"},
                                 {FieldKind::zebra, "zebra"},
                                 {FieldKind::isophote, "isophote"},
                                 {FieldKind::reflection, "reflection"},
                                 {FieldKind::highlight, "highlight"}});
}

/// How light and eye stand; vectors need not be unit, but not zero. Empty: chosen from the surface
/// so that the picture turns with it: `view` is the mean normal, `light` the same (for highlight
/// view x stripes), `stripes` the mean direction of S_u across the view, `origin` the middle of the
/// surface moved by its extent towards the eye.
struct Lighting {
  std::optional<core::Vector3> view = {};     ///< from the surface to the eye, which is far away
  std::optional<core::Vector3> light = {};    ///< from the surface to the light (isophotes), or the
                                              ///< direction of the light line (highlight)
  std::optional<core::Vector3> stripes = {};  ///< stripes are stacked along it (zebra, reflection)
  std::optional<core::Point3> origin = {};    ///< a point of the first light line
  double stripe_count = 12;  ///< zebra: pairs of a black and a white stripe on a sphere
  double spacing = 0;  ///< reflection: of the light lines; 0: a twelfth of the surface's extent
};

/// A field over a surface; NaN where it has no value (no normal; a reflected ray that misses).
///
/// gaussian, mean    curvature in 1/length^2, 1/length (see SurfaceCurvature for signs)
/// principal         the larger principal curvature in `values`, the smaller in `second`
/// zebra             stripes on a far sphere seen by reflection: the ray r = 2 (n.view) n - view
/// has
///                   the latitude asin(r.stripes); value = stripe_count (1/2 + latitude / pi).
///                   White where its fraction is below 1/2. Depends on the normal alone, so it is
///                   as continuous as the tangent plane.
/// isophote          cosine of the angle between normal and light, -1 … 1; isophotes are its
///                   level lines
/// reflection        parallel light lines in the plane through origin across the view: where the
///                   reflected ray meets that plane, in spacings along `stripes`
/// highlight         signed distance from the surface's normal line to the light line through
///                   origin along light; a highlight line is where it is zero
struct Field {
  int rows = 0;
  int columns = 0;
  std::vector<double> values;
  std::vector<double> second;  ///< principal only
  core::Interval range;        ///< of all finite values; both ends 0 where there is none
};

/// What stands in `lighting` where its members are empty, for a sampled surface.
Lighting completed(const Lighting& lighting, const JetGrid& grid);

/// Fails with bad_input for vectors of no length or not finite, a stripe count or spacing that is
/// not positive, or (reflection) stripes along the view.
core::Result<Field> interrogate(const JetGrid& grid, FieldKind kind, const Lighting& lighting = {});

}  // namespace keyline::surface
