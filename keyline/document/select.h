#pragma once

#include <string>
#include <vector>

#include "keyline/core/error.h"

namespace keyline::document {

/// The failure where `wanted` means none of the things of these names, some of which may be empty:
/// with the names there are, and how many things.
core::Failure nothing_named(const std::string& wanted, const std::vector<std::string>& names);

}  // namespace keyline::document
