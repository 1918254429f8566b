#pragma once

#include <string>
#include <vector>

namespace keyline::exchange {

/// A document as the bytes of a file, and what that took.
struct Written {
  std::string content;
  double deviation = 0;            ///< bound of the distance from the document's curves
  std::vector<std::string> notes;  ///< what the format could not hold, in words
};

/// What to do where a format cannot hold what it is asked to.
inline constexpr const char* kHoldSurfaces = "choose .step, .iges or .json";
inline constexpr const char* kHoldSpaceCurves = "choose .step, .iges, .dxf or .json";

}  // namespace keyline::exchange
