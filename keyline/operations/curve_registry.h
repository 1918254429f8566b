#pragma once

#include <vector>

#include "keyline/operations/operation.h"

namespace keyline::operations {

/// The operations on curves that need no other program or library of others: what bindings/wasm
/// has.
std::vector<Operation> curve_operations();

}  // namespace keyline::operations
