#pragma once

#include "keyline/sketch/image.h"
#include "keyline/sketch/tone.h"

/// Light lines among dark ones on a transparent ground: laid over white they are lost.
namespace keyline::sketch {

/// Shares of what is drawn in a picture, as far as it is opaque: 0 where the reader saw nothing
/// light in it.
struct LightShare {
  double lines = 0;  ///< light lines
  double rest = 0;   ///< light areas, and light rims of dark lines: paper, as it seems
};

/// What of a picture laid over both white and black is light: pieces lighter than mid grey. They
/// are lines if three quarters of their border is on nothing (a rim of dark ink has half of its on
/// ink, what dark lines enclose has all of it there) and they are not broad areas.
///
/// The picture is as opaque as it is dark afterwards, so that light lines are as good as dark ones,
/// or as laid over white where what is light is paper. Where one of both is wanted it is laid over
/// the ground that shows it. over_black is empty afterwards.
LightShare darken_light_lines(Image& image, Polarity wanted);

}  // namespace keyline::sketch
