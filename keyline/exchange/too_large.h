#pragma once

#include "keyline/document/document.h"

namespace keyline::exchange {

/// Leaves out what has a point beyond the largest coordinate that is taken from files
/// (core::kLargestCoordinate): lengths and sections of it would be no numbers. Each is told in
/// `skipped`, by its name or, where it has none, its place in labels().
void leave_out_too_large(document::Document& document);

}  // namespace keyline::exchange
