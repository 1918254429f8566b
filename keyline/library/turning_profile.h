#pragma once

#include <array>

#include "keyline/core/describe.h"
#include "keyline/curve/view.h"

namespace keyline::library {

/// A curve's normalised curvature (curvature times length over the share of the length) in a form
/// that compares in a hundred multiplications, whatever size, pose and direction.
///
/// The tangent angle is averaged over 64 equal parts of the length; the 63 differences between
/// neighbours are the curvature, averaged under overlapping triangles: corners and cusps stay
/// finite and move smoothly from one to the next. They are kept as parts that are even and odd
/// about the middle of the curve, in radians; going the other way changes the sign of the even
/// half, the mirror image that of both. The last of the odd half is always 0.
inline constexpr int kTurningParts = 64;
using TurningProfile = std::array<float, kTurningParts>;

/// Of a planar curve that has a length. Turning, moving, scaling, reversing (up to the signs) and
/// reparametrising the curve change rounding alone. A closed curve is compared from where it
/// starts.
TurningProfile turning_profile(const curve::PlanarView& curve);

/// How two curves are laid over one another to be compared.
struct TurningMatch {
  double distance = 0;  ///< root of the summed squared differences, radians
  bool reversed = false;
  bool mirrored = false;
  static constexpr auto describe() {
    using M = TurningMatch;
    return core::fields(
        core::field<&M::distance>("root of the summed squared differences of turning").in("radian"),
        core::field<&M::reversed>("laid over the other travelled the other way"),
        core::field<&M::mirrored>("laid over its mirror image"));
  }
};

/// The best of both directions and, where allowed, of both mirror images.
TurningMatch compare(const TurningProfile& a, const TurningProfile& b, bool mirror);

}  // namespace keyline::library
