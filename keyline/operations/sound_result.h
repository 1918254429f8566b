#pragma once

#include "keyline/core/describe.h"
#include "keyline/core/error.h"

namespace keyline::operations {

/// Whether every curve and surface of a result, wherever it stands, is valid by its own room's
/// rules: the one place where that is seen to for all operations. An empty path counts as none.
/// Fails: internal, with the field as path.
core::Result<void> check_values(const core::Type& type, const void* value);

}  // namespace keyline::operations
