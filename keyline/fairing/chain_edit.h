#pragma once

#include <vector>

#include "keyline/fairing/chain_fit.h"

/// Surgery on a chain under construction.
namespace keyline::fairing::detail {

/// The chain without the joint before piece `at` (1 <= at < pieces): the two pieces become one,
/// its slope guessed so that it turns as much as they did together, from -8 to 8; where curvature
/// passes zero from -5 to -0.3.
FitChain without_joint(const FitChain& chain, int at);

/// The same curve with a joint more, at a fraction of piece `at` (0 <= at < pieces, 0 < fraction <
/// 1); both parts are of the piece's kind. Feet stay where they are on the curve.
FitChain with_joint(const FitChain& chain, int at, double fraction);

/// The same curve as `pieces` pieces or more: the longest is parted in its middle, again and again.
FitChain parted(const FitChain& chain, std::size_t pieces);

/// The closed chain started `by` joints later.
void rotate_start(FitChain& chain, int by);

/// Pieces [first, first + count) of a chain on their own, both end joints held.
struct Window {
  FitChain chain;
  std::vector<FitPoint> points;
  std::vector<std::size_t> index;  ///< of each point in the whole
  int first = 0;
};
Window cut_window(const FitChain& chain, const std::vector<FitPoint>& points, int first, int count);

/// Puts a window cut with `count` pieces, and changed since, back into the whole.
FitChain paste_window(const FitChain& whole, const Window& window, int count);

}  // namespace keyline::fairing::detail
