#include "keyline/numeric/normal.h"

#include <gtest/gtest.h>

namespace keyline::numeric {
namespace {

TEST(Normal, TwoSidedQuantilesOfTheTables) {
  EXPECT_NEAR(normal_two_sided(0.0026997960632601866), 3, 1e-12);
  EXPECT_NEAR(normal_two_sided(0.05), 1.959963984540054, 1e-12);
  EXPECT_EQ(normal_two_sided(1), 0);
}

}  // namespace
}  // namespace keyline::numeric
