#pragma once

#include "keyline/core/describe.h"
#include "keyline/core/error.h"
#include "keyline/sketch/image.h"
#include "keyline/sketch/sheet.h"

namespace keyline::sketch {

/// Pixels that a photo to rectify is wide and high at most.
inline constexpr int kLargestPhoto = 32000;

/// Whether photos of a sheet are mapped back to the sheet.
enum class Rectify {
  automatic,  ///< where a sheet is found
  off
};
constexpr auto choices(const Rectify*) {
  return core::words<Rectify>({{Rectify::automatic, "auto"}, {Rectify::off, "off"}});
}

/// Width over height of the sheet with those corners in a photo of that size.
///
/// Sides of a sheet are at right angles and the optical axis goes through the photo's middle: that
/// tells the focal length, and it the ratio. Where the photo hardly tells (the sheet is turned
/// about one of its sides only, or seen from far), the focal length is that of a usual lens, 0.75
/// of the photo's diagonal, and in between what is likeliest with corners known to half a pixel and
/// focal lengths within a factor of 1.5 of that.
/// Source: [Zhang 2000] for one plane: the homography's columns h1, h2 have
/// h1ᵀ ω h2 = 0 and lengths in that ratio, ω = diag(1, 1, f²) / f².
double aspect_of(const SheetCorners& corners, int width, int height);

/// The sheet as seen from straight above: so large that no side has fewer pixels than in the photo,
/// but no more pixels than the photo has. The outermost pixels repeat those `rim` pixels within, so
/// that nothing of the ground is left.
///
/// Fails: bad_input where the corners are no quadrilateral, in order, of some pixels a side, or the
/// photo is larger than kLargestPhoto.
core::Result<Image> rectified(const Image& photo, const SheetCorners& corners, double rim);

}  // namespace keyline::sketch
