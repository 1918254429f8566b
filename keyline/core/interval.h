#pragma once

#include <algorithm>

namespace keyline::core {

/// Closed interval [low, high] of real numbers; low <= high.
struct Interval {
  double low = 0;
  double high = 1;
  friend bool operator==(const Interval&, const Interval&) = default;
};

constexpr double length(const Interval& i) { return i.high - i.low; }
constexpr bool contains(const Interval& i, double x) { return i.low <= x && x <= i.high; }
constexpr double clamp(const Interval& i, double x) { return std::clamp(x, i.low, i.high); }
/// low + u (high - low), exact at u = 0 and u = 1.
constexpr double at(const Interval& i, double u) { return (1 - u) * i.low + u * i.high; }

}  // namespace keyline::core
