#pragma once

#include <vector>

#include "keyline/acquire/key_line.h"
#include "keyline/core/error.h"
#include "keyline/curve/bspline.h"
#include "keyline/fit/fit_spline.h"

namespace keyline::fairing {

/// What fairing looks at before it fairs: the spline of every smooth run of the key-line, in their
/// order, as step 2 of [Fairing] has it. Runs end at corners; a closed line without corners has
/// one, periodic. Errors: those of fit::fit_spline.
core::Result<std::vector<curve::BSpline2>> splines_of(const acquire::KeyLine& line,
                                                      const fit::SplineFitOptions& options);

}  // namespace keyline::fairing
