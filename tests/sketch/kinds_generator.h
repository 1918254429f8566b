#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "drawing_generator.h"

/// Small drawings of one difficulty each, whose lines are known.
namespace keyline::sketch::testing {

/// The kinds, in a fixed order.
std::vector<std::string> drawing_kinds();

/// Further ones, of which some are beyond us.
std::vector<std::string> harder_kinds();

/// A drawing of that kind, 240 by 180 pixels; the same seed gives the same one everywhere.
TrueDrawing make_kind(const std::string& kind, std::uint64_t seed);

}  // namespace keyline::sketch::testing
