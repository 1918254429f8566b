#pragma once

#include <cmath>
#include <vector>

#include "keyline/fairing/dense_curve.h"

/// Where a curve bends to the other side for a while.
namespace keyline::fairing::detail {

/// A stretch whose curvature has the other sign than that before and behind it; at an end of an
/// open curve that nothing holds, than that beside it. Where a curve ends on its line of symmetry,
/// square to it, behind it is the mirror image of what is before.
struct CounterBend {
  double sideways = HUGE_VAL;  ///< how far it departs from a straight line, from the middle of that
  int first = 0;               ///< nodes of the greatest curvature before and behind it, the second
  int last = 0;                ///< of a closed curve perhaps on the next lap
  signed char side = 0;        ///< the sign there
};

/// Least sideways first.
std::vector<CounterBend> counter_bends(const DenseCurve& curve);

/// Of these, in their order, those that ask for one side of every node.
std::vector<CounterBend> apart(const DenseCurve& curve, const std::vector<CounterBend>& bends);

/// From the first to the last of its nodes curvature is to keep to the side it has there
/// (DenseCurve::side), besides what is kept elsewhere.
///
/// Precondition: the curve is free.
void set_side(DenseCurve& curve, const CounterBend& bend);

/// At that end nothing is kept any more, up to where curvature is greatest or a side ends: an end
/// that is drawn elsewhere may have to bend.
void loosen_side(DenseCurve& curve, bool at_start);

}  // namespace keyline::fairing::detail
