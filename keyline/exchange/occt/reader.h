#pragma once

#include <string>

#include "keyline/document/document.h"

namespace keyline::exchange::occt {

/// As exchange::read_cad(), in this process. Throws std::runtime_error("message; remedy") or
/// Standard_Failure.
document::Document read_step(const std::string& file);
document::Document read_iges(const std::string& file);

}  // namespace keyline::exchange::occt
