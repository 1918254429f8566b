#pragma once

#include <nlohmann/json.hpp>

#include "keyline/core/error.h"

namespace keyline::operations {

/// Adds to a result that holds "curve" what the request asks for beside it: "polyline"
/// ("samples": n points) and the "bezier" or "nurbs" form of {"degree", "tolerance"} with its
/// "deviation". No effect where the request asks for none.
core::Result<void> add_derived_forms(const nlohmann::json& request, nlohmann::json& result);

}  // namespace keyline::operations
