#pragma once

#include <string>

#include "keyline/core/describe.h"

namespace keyline::app {

/// A list of records as a table: a line for each, a column for every number, word and text in them.
/// Empty where the type is another or the list is empty.
std::string table_of(const core::Type& type, const void* list);

}  // namespace keyline::app
