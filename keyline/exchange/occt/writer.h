#pragma once

#include <string>

#include "keyline/document/document.h"

namespace keyline::exchange::occt {

/// The file of a document of curves that curve_of() knows, every thing a root of its own with its
/// name, numbers with 17 digits. Throws std::runtime_error or Standard_Failure.
std::string write_step(const document::Document& document);
std::string write_iges(const document::Document& document);

}  // namespace keyline::exchange::occt
