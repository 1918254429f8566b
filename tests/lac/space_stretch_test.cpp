#include "keyline/lac/space/space_stretch.h"

#include <cmath>

#include <gtest/gtest.h>

/// Variables in which laws are smooth.
namespace keyline::lac::detail {
namespace {

TEST(Stretch, PlacesGoByPowersOfTheDistanceFromAZero) {
  const Stretch from{0.2, 0.7, 3, true};
  EXPECT_NEAR(from.place(0.5), 0.2 + 0.5 * 0.125, 1e-15);
  EXPECT_NEAR(from.rate(0.5), 0.5 * 3 * 0.25, 1e-15);
  const Stretch to{0.2, 0.7, 3, false};
  EXPECT_NEAR(to.place(0.25), 0.7 - 0.5 * std::pow(0.75, 3), 1e-15);
  EXPECT_NEAR(to.rate(0.25), 0.5 * 3 * std::pow(0.75, 2), 1e-15);
  const Stretch even{0.2, 0.7, 1, false};
  EXPECT_NEAR(even.place(0.4), 0.4, 1e-15);
  EXPECT_EQ(even.rate(0.4), 0.7 - 0.2);
  for (const Stretch& s : {from, to, even}) {
    EXPECT_EQ(s.place(0), 0.2);
    EXPECT_EQ(s.place(-1), 0.2);
    EXPECT_EQ(s.place(1), 0.7);
    EXPECT_EQ(s.place(2), 0.7);
    EXPECT_EQ(s.variable(0.1), 0);
    EXPECT_EQ(s.variable(0.9), 1);
    for (const double x : {0.1, 0.5, 0.9}) {
      EXPECT_NEAR(s.variable(s.place(x)), x, 1e-14);
      EXPECT_NEAR(s.rate(x), (s.place(x + 1e-6) - s.place(x - 1e-6)) / 2e-6, 1e-8);
    }
  }
}

// Distance to the power -1 / slope is to be a whole power, the place smooth to order 5.
TEST(SmoothingPower, MakesWholePowers) {
  EXPECT_EQ(smoothing_power(-1), 1);
  EXPECT_EQ(smoothing_power(-0.5), 1);  // squares are smooth
  EXPECT_EQ(smoothing_power(-1.0 / 3), 1);
  for (const double slope : {-2.0, -1.5, -0.7, -0.3, -5.0}) {
    const double power = smoothing_power(slope);
    EXPECT_GE(power, 5 - 1e-12) << slope;
    EXPECT_LT(power, 5 - slope + 1e-12) << slope;
    const double order = power / -slope;
    EXPECT_NEAR(order, std::round(order), 1e-12) << slope;
  }
}

using Ends = std::vector<std::array<double, 4>>;
Ends of(LawZero a, LawZero b) {
  Ends all;
  for (const Stretch& s : stretches_between(a, b))
    all.push_back({s.from, s.to, s.power, s.zero_at_start ? 1.0 : 0.0});
  return all;
}

// A law of slope -2 asks for the power 6 on both sides of its zero, one of slope -1 for none.
TEST(Stretches, AreCutAtTheZeros) {
  EXPECT_EQ(of({}, {}), (Ends{{0, 1, 1, 0}}));
  EXPECT_EQ(of({0.3, -2}, {}), (Ends{{0, 0.3, 6, 0}, {0.3, 1, 6, 1}}));
  EXPECT_EQ(of({}, {0.3, -2}), (Ends{{0, 0.3, 6, 0}, {0.3, 1, 6, 1}}));
  EXPECT_EQ(of({0.3, -1}, {}), (Ends{{0, 0.3, 1, 0}, {0.3, 1, 1, 0}}));
  EXPECT_EQ(of({0, -2}, {}), (Ends{{0, 1, 6, 1}}));
  EXPECT_EQ(of({1, -2}, {}), (Ends{{0, 1, 6, 0}}));
  EXPECT_EQ(of({1.2, -2}, {-0.1, -2}), (Ends{{0, 1, 1, 0}}));
}

// Between two zeros that both ask for a power there are two stretches.
TEST(Stretches, BetweenTwoZerosAreHalved) {
  const Ends meant{{0, 0.2, 6, 0}, {0.2, 0.5, 6, 1}, {0.5, 0.8, 6, 0}, {0.8, 1, 6, 1}};
  const Ends found = of({0.8, -2}, {0.2, -2});
  ASSERT_EQ(found.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(found[i][k], meant[i][k], 1e-15);
  EXPECT_EQ(of({0.2, -1}, {0.8, -2}), (Ends{{0, 0.2, 1, 0}, {0.2, 0.8, 6, 0}, {0.8, 1, 6, 1}}));
}

// At one place the larger of two powers.
TEST(Stretches, OfOnePlaceTheLargerPowerCounts) {
  EXPECT_EQ(of({0.5, -2}, {0.5, -1}).back(), (std::array<double, 4>{0.5, 1, 6, 1}));
  EXPECT_EQ(of({0, -1}, {0, -2}), (Ends{{0, 1, 6, 1}}));
}

/// Of a law that goes as a power of the distance from its place, by how much that grows at most.
void expect_graded(const LawRun& law) {
  double before = 0;
  for (const Stretch& s : graded_stretches(law, {})) {
    EXPECT_EQ(s.from, before);
    before = s.to;
    const double a = std::abs(s.from - law.place), b = std::abs(s.to - law.place);
    const double apart = std::max(a, b) / std::min(a, b);
    EXPECT_LE(apart, 4 + 1e-9) << law.place;
    EXPECT_LE(std::pow(apart, 1 / std::abs(law.slope)), 8 + 1e-9) << law.place;
    EXPECT_EQ(s.power, 1);
  }
  EXPECT_EQ(before, 1);
}

TEST(GradedStretches, ArePartsAlongWhichALawGrowsLittle) {
  for (const double slope : {0.3, 1.0, 3.0, -2.5})
    for (const double place : {-1e-3, -0.4, -7.0, 1.02, 3.0}) expect_graded({place, slope, 0});
  expect_graded({-0.4, -0.1, 0});
  EXPECT_EQ(graded_stretches({-1e-3, -1, 0}, {}).size(), 1U);  // straight: smooth as it is
  EXPECT_EQ(graded_stretches({-9, 2, 0}, {30, 1, 0}).size(), 1U);
  EXPECT_EQ(graded_stretches({HUGE_VAL, 0, 4.1}, {}).size(), 2U);  // ln 8 is 2.08
  // One ends at a zero: its power stays beside it.
  const auto all = graded_stretches({0.3, -2, 0}, {1.01, 2, 0});
  EXPECT_EQ(all.front().from, 0);
  EXPECT_EQ(all.back().to, 1);
  for (const Stretch& s : all)
    EXPECT_EQ(s.power, s.from == 0.3 || s.to == 0.3 ? 6 : 1) << s.from << ' ' << s.to;
}

}  // namespace
}  // namespace keyline::lac::detail
