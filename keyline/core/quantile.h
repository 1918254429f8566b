#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace keyline::core {

/// The value that the share part / of of the values stays below (the middle one unless told: of an
/// even number the upper of the two); a value-initialised one for none.
template <class Value>
Value quantile(std::vector<Value> values, std::size_t part = 1, std::size_t of = 2) {
  if (values.empty()) return {};
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() * part / of);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// The value at the place `share` (0 the least, 1 the greatest) of the sorted values, rounded down;
/// reorders them. Precondition: there is one.
template <class Values>
auto value_at(Values&& values, double share) {
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace keyline::core
