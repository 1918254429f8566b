#pragma once

#include <string>

#include "keyline/library/library.h"

namespace keyline::operations {

inline constexpr const char* kLibrary =
    "the library's file; else KEYLINE_LIBRARY of the environment, else the user's own";

/// The library a request names, or the default one, whose folder is made where it is to be written.
/// Fails: as library::Library::open; bad_input where there is neither.
core::Result<library::Library> open_library(const std::string& named, library::Mode mode);

}  // namespace keyline::operations
