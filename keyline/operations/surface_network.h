#pragma once

#include "keyline/operations/operation.h"

namespace keyline::operations {

Operation surface_network_operation();

}  // namespace keyline::operations
