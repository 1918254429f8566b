#include "keyline/core/version.h"

namespace keyline::core {

const char* version() { return KEYLINE_VERSION; }

}  // namespace keyline::core
