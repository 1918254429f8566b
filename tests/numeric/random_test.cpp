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
