#pragma once

#include <algorithm>
#include <cstddef>

namespace keyline::curve {

/// Which of several equal shares of [0, 1], and the share's own parameter.
struct Share {
  std::size_t index = 0;
  double t = 0;
};

/// The share that t lies in, of `count` > 0: t is clamped, NaN counts as 0. A share begins at its
/// breakpoint index / count as that is rounded, and owns it; what is before belongs to the one
/// before.
inline Share share_of(std::size_t count, double t) {
  const double n = static_cast<double>(count);
  t = t >= 0 ? std::min(t, 1.0) : 0.0;
  std::size_t i = std::min(static_cast<std::size_t>(t * n), count - 1);
  if (i + 1 < count && static_cast<double>(i + 1) / n <= t) ++i;
  if (i > 0 && t < static_cast<double>(i) / n) --i;
  return {i, std::clamp(t * n - static_cast<double>(i), 0.0, 1.0)};
}

}  // namespace keyline::curve
