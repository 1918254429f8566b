#pragma once

#include "keyline/lac/segment/segment.h"

namespace keyline::lac {

/// Lambda of the standard form: |drho/ds| at the end of smaller radius for alpha <= 1, of larger
/// radius for alpha > 1, where the radius is taken for 1; 0 for circle and straight line.
double lambda_of(const Piece& piece);

}  // namespace keyline::lac
