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

/// The largest share of `whole` that holds, within 2^-halvings of the share itself however small:
/// halved until one holds, from there on towards the one before.
/// Returns: `whole` where it holds; 0 where nothing above a 2^-40 of it does.
template <class Holds>
double largest_share_that_holds(Holds&& holds, double whole, int halvings) {
  constexpr int kSmallest = 40;
  double share = whole;
  for (int i = 0; i <= kSmallest; ++i, share /= 2)
    if (holds(share)) return i == 0 ? whole : last_that_holds(holds, share, 2 * share, halvings);
  return 0;
}

}  // namespace keyline::numeric
