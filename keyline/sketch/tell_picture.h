#pragma once

#include "keyline/sketch/find_ink.h"
#include "keyline/sketch/light_lines.h"
#include "keyline/sketch/tone.h"
#include "keyline/sketch/trace.h"

/// What was made of a picture, in words: notes of the result.
namespace keyline::sketch {

inline constexpr double kEnoughExplained = 0.97;  ///< of ink or strokes

/// What was made of the paper: margins, light lines, shades.
void tell_ground(const Tone& tone, bool on_black, TraceResult& result);

/// Dirt that was left out, from a hundredth of the ink on.
void tell_dirt(const Ink& found, TraceResult& result);

/// What was made of light parts among dark ones, from a hundredth of all on.
void tell_light(const LightShare& light, TraceResult& result);

/// A picture of which much is dark, or ink in broad areas, may be no drawing. One in shade is where
/// lines explain its ink.
void warn_of_photograph(const Tone& tone, const Ink& found, Edge edge, TraceResult& result);

}  // namespace keyline::sketch
