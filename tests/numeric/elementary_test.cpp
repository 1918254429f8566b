#include "keyline/numeric/elementary.h"

#include <cmath>

#include <gtest/gtest.h>

namespace keyline::numeric {
namespace {

template <class Arch>
class Elementary : public testing::Test {};
using Architectures = testing::Types<simd::ScalarArch, simd::BaselineArch>;
TYPED_TEST_SUITE(Elementary, Architectures);

TYPED_TEST(Elementary, ExponentialsOverTheirRange) {
  using Batch = simd::Lanes<TypeParam>;
  for (double x = -690; x <= 690; x += 0.7377) {
    EXPECT_NEAR(simd::exp(Batch(x)).get(0) / std::exp(x), 1, 4e-16) << x;
    EXPECT_NEAR(simd::expm1(Batch(x)).get(0) / std::expm1(x), 1, 6e-16) << x;
  }
  for (double x = 1e-18; x < 2; x *= 1.3) {
    for (const double y : {x, -x}) {
      EXPECT_NEAR(simd::expm1(Batch(y)).get(0) / std::expm1(y), 1, 6e-16) << y;
    }
  }
  EXPECT_EQ(simd::exp(Batch(0.0)).get(0), 1);
  EXPECT_EQ(simd::expm1(Batch(0.0)).get(0), 0);
}

TYPED_TEST(Elementary, SineAndCosineOfShortAngles) {
  using Batch = simd::Lanes<TypeParam>;
  for (double x = -1.7; x <= 1.7; x += 0.0137) {
    Batch sine, cosine;
    simd::sincos_short(Batch(x), sine, cosine);
    EXPECT_NEAR(sine.get(0), std::sin(x), 6e-16) << x;
    EXPECT_NEAR(cosine.get(0), std::cos(x), 6e-16) << x;
  }
}

}  // namespace
}  // namespace keyline::numeric
