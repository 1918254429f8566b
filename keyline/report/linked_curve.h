#pragma once

#include <string>

#include "keyline/report/report.h"

namespace keyline::report::detail {

/// What the page's script draws the curve from: its numbers as JSON in a block that does not run,
/// and the texts about its pieces as a hidden list. Nothing is visible where no script runs.
/// Numbers have seven digits, points from the first one on; what is not finite is null. `figures`:
/// the numbers of those it stands for.
/// Throws: InvalidInput for lists of unequal length.
std::string linked_curve(const LinkedCurve& linked, const std::string& figures);

}  // namespace keyline::report::detail
