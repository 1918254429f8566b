#pragma once

#include "keyline/fairing/fair.h"

namespace keyline::fairing::detail {

/// bad_input where what is asked for cannot be, by itself or of this key-line.
core::Result<void> check(const acquire::KeyLine& line, const FairOptions& options);

}  // namespace keyline::fairing::detail
