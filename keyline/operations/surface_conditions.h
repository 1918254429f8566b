#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "keyline/core/error.h"
#include "keyline/surface/conditions.h"

namespace keyline::operations {

/// "conditions" of surface.edit: [{"curve":"A1","alpha":[lo,hi],"s":[lo,hi],"end_tolerance":e,
/// "branch":"growing"|"falling","tangent":true|false}, …]; without "curve" for every curve. Members
/// of other names or types are bad_input with paths such as "conditions[0].s".
core::Result<std::vector<surface::CurveCondition>> surface_conditions(
    const nlohmann::json& request);

/// One condition as the command line writes it, in that form: "A1:s=1.1..1.4,alpha=0..0.3,
/// end=0.1,branch=falling,tangent=kept|free", or without "A1:" for every curve.
core::Result<nlohmann::json> condition_from_text(const std::string& text);

}  // namespace keyline::operations
