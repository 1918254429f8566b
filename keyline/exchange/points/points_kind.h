#pragma once

#include <string>

#include "keyline/core/error.h"

namespace keyline::exchange::detail {

/// Fails: bad_input for lists of points whose rows are not where the points are: PTX, whose head
/// of ten lines has the scanner's place and the matrix to it.
core::Result<void> check_kind(const std::string& file);

}  // namespace keyline::exchange::detail
