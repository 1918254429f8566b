#pragma once

namespace keyline::numeric {

/// The last place on the way from `good`, where holds(x), to `bad`, where it does not, within the
/// 2^-halvings part of the way (or up to the spacing of doubles). holds is not asked at either end;
/// of the places where it is asked and holds the answer is the last.
/// Returns: `good` where it holds at none.
template <class Holds>
double last_that_holds(Holds&& holds, double good, double bad, int halvings) {
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (good + bad);
    if (middle == good || middle == bad) break;
    (holds(middle) ? good : bad) = middle;
  }
  return good;
}

}  // namespace keyline::numeric
