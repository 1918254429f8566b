#pragma once

#include <string>
#include <vector>

#include "keyline/acquire/raw_curve.h"

namespace keyline::exchange::detail {

/// Airfoils in Lednicer's order (the counts of both sides first, then the upper side from the nose,
/// then the lower side from the nose) to one curve from trailing edge over the nose to trailing
/// edge, with a note. Counts may be one off, or any where the first is larger than x can be (more
/// than the airfoil's length behind its tail), and are told in `left_out` then. False, and nothing
/// is changed, for other points. Precondition: the curve has points, and as many source lines.
bool unfold_lednicer(acquire::RawCurve& curve, std::vector<std::string>& left_out);

/// Airfoils of several elements, which a point (999, 999) parts (XFOIL and MSES): a curve for each,
/// with a note. Such a point parts only where no curve could pass it: outside the box of the others
/// enlarged by its own size. Precondition: one curve.
void part_elements(std::vector<acquire::RawCurve>& curves);

}  // namespace keyline::exchange::detail
