// The judges of the random tests, held against numbers of 60 digits.
#include "own_numerics.h"

#include <gtest/gtest.h>

namespace keyline::operations {
namespace {

/// A radius that grows by e^663 with a slope next to 1: expected by mpmath, the integral of
/// exp(i theta) in the variable -ln(1 - s / length).
TEST(OwnNumerics, WalksAPieceWhoseRadiusGrowsByE663) {
  const own::json curve{{"start", {0, 0}},
                        {"direction", 0},
                        {"pieces",
                         {{{"alpha", 1.000000163768151},
                           {"length", 55.664630431837686},
                           {"curvature", {4.725667067529685e+283, 7.076447846049144e-05}}}}}};
  constexpr double kRounding = 1e-12;  // 2e-14 of the length: some 10,000 roundings
  const own::Track track = own::walked(curve);
  EXPECT_NEAR(track.end().x, -47.88374826298086177781652, kRounding);
  EXPECT_NEAR(track.end().y, 28.38396829209593490491845, kRounding);
  EXPECT_NEAR(track.end().direction, 2.610446602371313011661568, 1e-13);
  EXPECT_NEAR(track.length, 55.664630431837686, kRounding);
}

/// A foot of the perpendicular just before the end is not the end.
TEST(OwnNumerics, FindsTheNearestPlaceNextToAnEnd) {
  const own::json line{{"points", {{0, 0}, {1, 0}, {2, 0}}}};
  EXPECT_NEAR(own::distance_from_bezier(line, {1.9984, 0.001}), 0.001, 1e-12);
  EXPECT_NEAR(own::distance_from_bezier(line, {0.0016, 0.001}), 0.001, 1e-12);
  // half of the way within the first ten-thousandth of the parameter
  const own::json hasty{{"points", {{0, 0}, {2, 0}, {0.8, 0.1}}}, {"weights", {1, 1e4, 1}}};
  EXPECT_NEAR(own::distance_from_bezier(hasty, {0.7, 0.001}), 0.001, 1e-6);
}

}  // namespace
}  // namespace keyline::operations
