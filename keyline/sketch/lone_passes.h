#pragma once

#include <functional>
#include <vector>

#include "keyline/sketch/consolidate.h"

namespace keyline::sketch {

/// Strokes left alone that run all along a line of several, nine tenths of their way within a pen
/// and a half of it (what lies farther from a line is on paper beside it), become members of that
/// line, which stays as it is. Beside a stroke alone they stay lines: two lines drawn once each.
/// `may`: whether a stroke may be a member of a line.
void take_lone_passes(std::vector<MeantLine>& lines, double width, double angle,
                      const std::function<bool(std::size_t stroke, const MeantLine& line)>& may);

}  // namespace keyline::sketch
