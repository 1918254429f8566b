#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "keyline/core/describe.h"
#include "keyline/core/error.h"
#include "keyline/curve/arriving.h"
#include "keyline/curve/concept.h"
#include "keyline/lac/chain/chain.h"

/// Blends: a log-aesthetic chain from a point of one curve to a point of another
/// (docs/design/g2-chains.md).
namespace keyline::lac {

/// What a blend takes over from a curve at the point it leaves or joins it, in the curve's own
/// direction of travel.
struct BlendEnd {
  core::Pose2 pose;
  double curvature = 0;
  double curvature_rate = 0;  ///< dkappa/ds
};

/// At parameter t of any planar curve, where it may have a corner or its curvature jump: of the
/// part before t, which a blend leaves, or of the part behind it, which a blend joins; at an end,
/// of the only part there is. A blend runs from the first curve, in its direction, into the second,
/// in its direction: reverse a curve (or use opposite) to leave or join it the other way.
template <curve::PlanarCurve C>
BlendEnd blend_leaving(const C& c, double t) {
  const curve::Jet2 j = jet(c, t < 1 ? std::nextafter(t, 0.0) : 1);
  const double direction = t < 1 ? curve::tangent_angle(j) : curve::arriving_angle(j);
  return {{evaluate(c, t), direction}, curve::curvature(j), curve::curvature_rate(j)};
}
template <curve::PlanarCurve C>
BlendEnd blend_joining(const C& c, double t) {
  if (t == 1) return blend_leaving(c, t);
  const curve::Jet2 j = jet(c, t);
  return {{j.point, curve::tangent_angle(j)}, curve::curvature(j), curve::curvature_rate(j)};
}
/// The same point passed the other way.
inline BlendEnd opposite(const BlendEnd& end) {
  return {{end.pose.position, core::wrap_angle(end.pose.direction + core::kPi)},
          -end.curvature,
          end.curvature_rate};
}

enum class BlendOrder { g1 = 1, g2 = 2, g3 = 3 };
constexpr auto choices(const BlendOrder*) {
  return core::words<BlendOrder>(
      {{BlendOrder::g1, "G1"}, {BlendOrder::g2, "G2"}, {BlendOrder::g3, "G3"}});
}

struct BlendSolution {
  Chain chain;                          ///< G2 inside whatever the order
  std::vector<std::size_t> overridden;  ///< pieces of slope -1 instead of the one asked for
  double absolute_turning = 0;          ///< left and right turning together
  double bending_energy = 0;            ///< integral of the squared curvature, in 1/length
};

/// g1: one piece; g2: one to three (solve_g2); g3: an outer piece at each end that continues with
/// the curvature and its rate found there, and the G2 chain between them; of several lengths of the
/// outer pieces the one whose blend has the least absolute turning, then bending energy. Joints
/// inside are G2. Where curvature is (nearly) zero at an end no slope but -1 has a finite rate
/// other than zero: the outer piece there gets -1. Accuracy: as solve_g2; the rates within 1e-9
/// relative of the larger of rate and curvature/chord. Fails: bad_input, undrawable as
/// solve_g1_directions and solve_g2, and where the blend would be so long that rounding of its
/// points passes 1e-12 of the chord and of the radii given (4,500 times these: a circle nearly
/// full), with the directions that serve in the hint; not_converged where none of the lengths tried
/// meets the rates, which proves nothing.
core::Result<BlendSolution> solve_blend(const BlendEnd& from, const BlendEnd& to, BlendOrder order,
                                        double alpha);

}  // namespace keyline::lac
