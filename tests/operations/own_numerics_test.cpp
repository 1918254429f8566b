// The judges of the random tests, held against numbers of 60 digits.
#include <gtest/gtest.h>

#include "own_curves.h"

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

double off(own::json bezier, double x, double y) {
  bezier["type"] = "bezier";
  return own::distance_from(own::beziers_of(bezier), {x, y, 0});
}

/// A foot of the perpendicular just before the end is not the end.
TEST(OwnNumerics, FindsTheNearestPlaceNextToAnEnd) {
  const own::json line{{"points", {{0, 0}, {1, 0}, {2, 0}}}};
  EXPECT_NEAR(off(line, 1.9984, 0.001), 0.001, 1e-12);
  EXPECT_NEAR(off(line, 0.0016, 0.001), 0.001, 1e-12);
  // half of the way within the first ten-thousandth of the parameter
  const own::json hasty{{"points", {{0, 0}, {2, 0}, {0.8, 0.1}}}, {"weights", {1, 1e4, 1}}};
  EXPECT_NEAR(off(hasty, 0.7, 0.001), 0.001, 1e-6);
}

/// Seed 9406: the nearest of many places lies on the other branch of the hairpin that ends this
/// curve, from where closing in leads to 8.3e-6 and 1.1e-5. Expected by mpmath: the least root of
/// the derivative of the squared distance, 40 digits.
TEST(OwnNumerics, FindsTheNearerBranchOfAHairpin) {
  const own::json bezier{{"points",
                          {{116.79844572146476, 55.327097349016924},
                           {109.33701043616834, 79.94878767386575},
                           {105.6062782448397, 92.25942128629708},
                           {104.36268146685912, 96.36268400968477},
                           {104.36265242160692, 96.36226166740259},
                           {104.36262342846341, 96.36184008282436}}}};
  EXPECT_NEAR(off(bezier, 104.3626287892906, 96.36183370476991), 2.8758776452984e-6, 1e-12);
  EXPECT_NEAR(off(bezier, 104.36263011250162, 96.36183105537219), 2.6878081383707e-6, 1e-12);
}

/// A parabola's distances have two minima; expected by the cubic equation of its feet.
TEST(OwnNumerics, FindsTheDistanceFromAParabolaWhereverThePointIs) {
  const own::json parabola{{"points", {{-1, 1}, {0.5, -2}, {2, 4}}}};
  EXPECT_NEAR(off(parabola, 0.1, 1.5), 1.0283771514649562, 1e-14);
  EXPECT_NEAR(off(parabola, -0.2, 2), 1.2806248474865697, 1e-14);
  EXPECT_NEAR(off(parabola, 1, -1), 1.2951852743393067, 1e-14);
  EXPECT_NEAR(off(parabola, 2.5, 5), 1.118033988749895, 1e-14);
}

}  // namespace
}  // namespace keyline::operations
