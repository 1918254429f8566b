#pragma once

#include <array>
#include <cstddef>

namespace keyline::numeric {

/// Pascal's triangle down to row N: kBinomials<N>[n][k] is n over k for 0 <= k <= n <= N, 0 for
/// k > n. Exact, as long as doubles hold all whole numbers of its size: N <= 56.
template <std::size_t N>
inline constexpr auto kBinomials = [] {
  static_assert(N <= 56);
  std::array<std::array<double, N + 1>, N + 1> rows{};
  for (std::size_t n = 0; n <= N; ++n) {
    rows[n][0] = 1;
    for (std::size_t k = 1; k <= n; ++k) rows[n][k] = rows[n - 1][k - 1] + rows[n - 1][k];
  }
  return rows;
}();

}  // namespace keyline::numeric
