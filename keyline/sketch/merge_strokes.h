#pragma once

#include <string>
#include <vector>

#include "keyline/sketch/consolidate.h"
#include "keyline/sketch/refine_stroke.h"

namespace keyline::sketch {

constexpr double kStrokeStep = 0.7;  ///< widths between the points of drawn strokes

/// What became of strokes that were drawn several times.
struct Merged {
  double explained = 0;            ///< length of strokes beside the line they are members of
  std::vector<FineStroke> passes;  ///< of strokes whose line stands for others too, the points
                                   ///< within a pen and a half of it, …
  std::vector<FineStroke> far;     ///< … and those farther off
};

/// Strokes drawn several times become one; notes say what wishes could not be met. Where the hand
/// turned back along the same line (turn_backs.h) a stroke is as many passes, unless it is to be
/// kept. Precondition: every stroke has its number for a member.
Merged merge(std::vector<FineStroke>& strokes, double width, const ConsolidateOptions& passes,
             const GroupWishes& wishes, std::vector<std::string>& notes);

}  // namespace keyline::sketch
