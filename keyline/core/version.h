#pragma once

/// Which Keyline this is.
namespace keyline::core {

/// "MAJOR.MINOR.PATCH": the number CMakeLists.txt gives the project, stated nowhere else.
const char* version();

}  // namespace keyline::core
