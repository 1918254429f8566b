#pragma once

#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "keyline/surface/network.h"

namespace keyline::operations {

/// {"sav", "curves": [curve.cav results with "name"], "worst": name}.
nlohmann::json surface_value_json(const surface::SurfaceValue& value);

/// The result of surface.sav: that of the one patch; of several the sum, all curves with "patch"
/// [i, j] beside their name, and "patches": [{"patch", "sav", "worst"}].
nlohmann::json patch_values_json(const std::vector<surface::PatchValue>& patches);

}  // namespace keyline::operations
