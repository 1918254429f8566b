#pragma once

#include <string>

#include "keyline/document/document.h"

namespace keyline::exchange::occt {

/// The file of a document whose paths are what cad_parts() gives, every thing a root with its own
/// name, numbers with 17 digits. Throws std::runtime_error or Standard_Failure.
std::string write_step(const document::Document& document);
std::string write_iges(const document::Document& document);

}  // namespace keyline::exchange::occt
