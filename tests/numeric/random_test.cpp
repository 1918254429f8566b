#include "keyline/numeric/random.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

namespace keyline::numeric {
namespace {

TEST(Random, SameSeedAndStreamSameNumbers) {
  Random a(7, 3);
  Random b(7, 3);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(a.bits(), b.bits());
}

// From a program of ten lines of its own, whose two halves give the published values: splitmix64 of
// 1234567 begins 6457827717110365317, xoshiro256++ of the state 1, 2, 3, 4 begins 41943041.
TEST(Random, BitsAreThoseOfXoshiro) {
  Random random(7, 3);
  for (const std::uint64_t bits : {0x4ae1831a097518U, 0xba9e00f4b6757ce0U, 0x9a7811365ae80390U,
                                   0x55039f971a0cc54cU, 0xf78f4bc205463dbeU, 0xcc7b1ca1a3bdd77aU})
    EXPECT_EQ(random.bits(), bits);
}

TEST(Random, UniformIsOfTheUpperBits) {
  Random random(7, 3);
  EXPECT_EQ(random.uniform(), static_cast<double>(0x4ae1831a097518U >> 11) / 9007199254740992.0);
  EXPECT_NEAR(random.uniform(-2, 6),
              -2 + 8 * (static_cast<double>(0xba9e00f4b6757ce0U) / 18446744073709551616.0), 1e-14);
}

TEST(Random, StreamsAndSeedsDiffer) {
  EXPECT_NE(Random(7, 3).bits(), Random(7, 4).bits());
  EXPECT_NE(Random(7, 3).bits(), Random(8, 3).bits());
  EXPECT_NE(Random(3, 7).bits(), Random(7, 3).bits());
}

TEST(Random, UniformFillsTheUnitInterval) {
  Random random(1);
  double sum = 0;
  for (int i = 0; i < 100000; ++i) {
    const double u = random.uniform();
    ASSERT_GE(u, 0);
    ASSERT_LT(u, 1);
    sum += u;
  }
  EXPECT_NEAR(sum / 1e5, 0.5, 0.005);  // five standard deviations
}

TEST(Random, IndexIsEven) {
  Random random(2);
  std::array<int, 6> counts{};
  for (int i = 0; i < 60000; ++i) ++counts[random.index(6)];
  for (const int c : counts) EXPECT_NEAR(c, 10000, 500);
}

TEST(Random, NormalHasUnitVariance) {
  Random random(3);
  double sum = 0;
  double squares = 0;
  for (int i = 0; i < 100000; ++i) {
    const double z = random.normal();
    sum += z;
    squares += z * z;
  }
  EXPECT_NEAR(sum / 1e5, 0, 0.016);
  EXPECT_NEAR(squares / 1e5, 1, 0.023);
}

}  // namespace
}  // namespace keyline::numeric
