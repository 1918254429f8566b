#include "keyline/operations/surface_value.h"

#include <cmath>

namespace keyline::operations {
namespace {

NearestShown nearest_shown(const classa::NearestValue& n) {
  NearestShown near;
  near.distance = n.nearest.distance;
  near.alpha = std::abs(n.nearest.flat.matrix.alpha);
  near.s = n.nearest.flat.matrix.s;
  near.curve = document::SpaceCurve{n.nearest.curve};
  if (!n.value) return near;
  near.cav = n.value->cav;
  near.type = n.value->type;
  if (n.value->matrix) {  // in the direction it is read in, like every place in the plane
    near.alpha = n.value->matrix->alpha;
    near.s = n.value->matrix->s;
  }
  return near;
}

/// With the nearest curves in place of types 4 and 5; infinite where one has none.
double nearest_value(const surface::NetworkValue& c) {
  if (c.value.type <= 3) return c.value.cav;
  return c.nearest && c.nearest->value ? c.nearest->value->cav : HUGE_VAL;
}

}  // namespace

SurfaceValueShown shown(const surface::SurfaceValue& value) {
  SurfaceValueShown all;
  all.sav = value.sav;
  all.worst = value.curves[value.worst].name;
  double nearest = 0;
  for (const surface::NetworkValue& c : value.curves) {
    NetworkCurveShown one{shown(c.value), c.name, {}, {}};
    if (c.nearest) one.nearest = nearest_shown(*c.nearest);
    nearest += nearest_value(c);
    all.curves.push_back(std::move(one));
  }
  if (std::isfinite(nearest)) all.nearest_sav = nearest;
  return all;
}

SurfaceValueShown shown(const std::vector<surface::PatchValue>& patches) {
  SurfaceValueShown all;
  if (patches.size() == 1) {
    all = shown(patches.front().value);
    all.values = patches;
    return all;
  }
  all.patches.emplace();
  double worst = -1;
  for (const surface::PatchValue& p : patches) {
    SurfaceValueShown one = shown(p.value);
    const PatchPlace place{p.row, p.column};
    for (NetworkCurveShown& curve : one.curves) {
      curve.patch = place;
      all.curves.push_back(std::move(curve));
    }
    all.patches->push_back({place, p.value.sav, one.worst, one.nearest_sav});
    all.sav += p.value.sav;
    if (p.value.sav <= worst) continue;
    worst = p.value.sav;
    all.worst = one.worst;
    all.worst_patch = place;
  }
  all.values = patches;
  return all;
}

}  // namespace keyline::operations
