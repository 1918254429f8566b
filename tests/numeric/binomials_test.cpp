#include "keyline/numeric/binomials.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

namespace keyline::numeric {
namespace {

static_assert(kBinomials<5>[5] == std::array<double, 6>{1, 5, 10, 10, 5, 1});
static_assert(kBinomials<5>[2] == std::array<double, 6>{1, 2, 1});

/// The largest known by heart: 56 over 28; and every row sums to a power of two, exactly.
TEST(Binomials, AreExactDownToTheLastRow) {
  EXPECT_EQ((kBinomials<56>[56][28]), 7648690600760440.0);
  for (std::size_t n = 0; n <= 52; ++n) {
    double sum = 0;
    for (const double c : kBinomials<56>[n]) sum += c;
    EXPECT_EQ(sum, std::ldexp(1.0, static_cast<int>(n)));
  }
}

}  // namespace
}  // namespace keyline::numeric
