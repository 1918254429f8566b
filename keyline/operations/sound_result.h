#pragma once

#include <nlohmann/json_fwd.hpp>

#include "keyline/core/describe.h"
#include "keyline/core/error.h"

namespace keyline::operations {

/// Whether every curve and surface of a result, wherever it stands, is valid by its own room's
/// rules: the one place where that is seen to for all operations. An empty path counts as none.
/// Fails: internal, with the field as path.
core::Result<void> check_values(const core::Type& type, const void* value);

/// Why a result is not sound, seen from its request: a number of that beyond 1e100, or nearer to 0
/// than 1e-100, named, as products of three such leave the range of doubles (bad_input); else the
/// failure as it is.
core::Failure explained(core::Failure unsound, const nlohmann::json& request);

}  // namespace keyline::operations
