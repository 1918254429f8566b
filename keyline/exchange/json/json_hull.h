#pragma once

#include <nlohmann/json_fwd.hpp>

#include "keyline/core/error.h"
#include "keyline/exchange/points/hull_table.h"

namespace keyline::exchange {

/// {"attributes":{"LOA":…,"BOA":…,"Depth":…},"halfBreadths":{"waterlines":[…],"stations":[…],
/// "table":[[…], …]}} at the top, in "hull" or in "structure": "hull", shares of length, half the
/// breadth and depth, null outside the hull; turned into the unit of the attributes.
/// Fails: bad_input with the place of the mistake within the value.
core::Result<HullTable> hull_from_json(const nlohmann::json& j);
bool is_hull_json(const nlohmann::json& j);

}  // namespace keyline::exchange
