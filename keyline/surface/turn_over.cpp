#include "keyline/surface/turn_over.h"

#include "keyline/core/axis.h"
#include "keyline/surface/curvature.h"

namespace keyline::surface {

bool turns_over(const BezierSurface& before, const BezierSurface& after) {
  constexpr int kSteps = 16;
  for (int i = 0; i <= kSteps; ++i)
    for (int j = 0; j <= kSteps; ++j) {
      const double u = i / static_cast<double>(kSteps);
      const double v = j / static_cast<double>(kSteps);
      const auto was = frame_of(jet(before, u, v));
      const auto is = frame_of(jet(after, u, v));
      if (was && is && core::dot(was->normal, is->normal) < 0) return true;
    }
  return false;
}

}  // namespace keyline::surface
