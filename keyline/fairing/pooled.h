#pragma once

#include <cstddef>
#include <vector>

namespace keyline::fairing::detail {

/// Neighbours with one mean.
struct Pool {
  double mean = 0;
  double weight = 0;
  std::size_t count = 1;
};

/// The nearest values (weighted mean squares) that rise: means of neighbours, pooled until they do.
/// weight(i) > 0.
///
/// Source: [Barlow 1972], section 1.2 (pooling adjacent violators).
template <class Value, class Weight>
std::vector<Pool> pooled(std::size_t n, Value&& value, Weight&& weight) {
  std::vector<Pool> pools;
  for (std::size_t i = 0; i < n; ++i) {
    pools.push_back({value(i), weight(i), 1});
    while (pools.size() > 1 && pools.end()[-2].mean >= pools.back().mean) {
      const Pool last = pools.back();
      pools.pop_back();
      Pool& one = pools.back();
      const double sum = one.mean * one.weight + last.mean * last.weight;
      one.count += last.count;
      one.weight += last.weight;
      one.mean = sum / one.weight;
    }
  }
  return pools;
}

}  // namespace keyline::fairing::detail
