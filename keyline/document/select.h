#pragma once

#include <string>
#include <vector>

#include "keyline/core/error.h"
#include "keyline/document/document.h"

namespace keyline::document {

/// Which of the things of these labels `wanted` means, as select() of documents does: all where it
/// is empty; an empty list where it means nothing.
std::vector<bool> chosen(const std::vector<Label>& all, const std::string& wanted);

/// The failure where `wanted` means none of the things of these names, some of which may be empty:
/// with the names there are, and how many things.
core::Failure nothing_named(const std::string& wanted, const std::vector<std::string>& names);

}  // namespace keyline::document
