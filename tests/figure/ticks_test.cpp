#include "keyline/figure/ticks.h"

#include <cmath>

#include <gtest/gtest.h>

#include "keyline/core/error.h"

namespace keyline::figure {
namespace {

std::string labels(const Ticks& ticks) {
  std::string text;
  for (const Tick& t : ticks.ticks)
    if (!t.label.empty()) text += (text.empty() ? "" : " ") + t.label;
  return text;
}

TEST(LinearTicks, StandAtRoundNumbers) {
  EXPECT_EQ(labels(linear_ticks({0, 1}, 6)), "0.0 0.2 0.4 0.6 0.8 1.0");
  EXPECT_EQ(labels(linear_ticks({-3.2, 17}, 5)), "0 5 10 15");
  EXPECT_EQ(labels(linear_ticks({-0.012, 0.011}, 5)), "−0.010 −0.005 0.000 0.005 0.010");
  const Ticks large = linear_ticks({0, 2.5e6}, 6);
  EXPECT_EQ(large.exponent, 6);
  EXPECT_EQ(labels(large), "0.0 0.5 1.0 1.5 2.0 2.5");
  const Ticks small = linear_ticks({-4e-5, 4e-5}, 5);
  EXPECT_EQ(small.exponent, -6);
  EXPECT_EQ(labels(small), "−40 −20 0 20 40");
}

TEST(LinearTicks, NeverExceedTheNumberAsked) {
  for (int most = 2; most < 12; ++most)
    for (double low = -7.3; low < 3; low += 0.37)
      for (double extent = 1e-7; extent < 1e9; extent *= 3.3) {
        const Ticks ticks = linear_ticks({low, low + extent}, most);
        EXPECT_LE(ticks.ticks.size(), static_cast<std::size_t>(most));
        for (const Tick& t : ticks.ticks) {
          EXPECT_GE(t.value, low - 1e-6 * extent);
          EXPECT_LE(t.value, low + extent * (1 + 1e-6));
        }
      }
  EXPECT_THROW(linear_ticks({1, 1}, 5), core::InvalidInput);
  EXPECT_THROW(linear_ticks({0, INFINITY}, 5), core::InvalidInput);
}

TEST(LogTicks, LabelPowersOfTen) {
  EXPECT_EQ(labels(log_ticks({0.01, 100}, 8)), "10⁻² 10⁻¹ 10⁰ 10¹ 10²");
  EXPECT_EQ(labels(log_ticks({1.5, 25}, 8)), "2 5 10 20");
  EXPECT_LE(log_ticks({1e-200, 1e200}, 8).ticks.size(), 402U);
  EXPECT_THROW(log_ticks({0, 1}, 5), core::InvalidInput);
}

TEST(SignedRootTicks, SpreadOverBothSigns) {
  EXPECT_EQ(labels(signed_root_ticks({-4, 100}, 8)), "0 5 20 50 100");
  EXPECT_EQ(labels(signed_root_ticks({-100, 100}, 9)), "−100 −50 −20 −5 0 5 20 50 100");
  for (double high = 1e-9; high < 1e9; high *= 7)
    for (double low : {-10 * high, -0.01 * high, 0.0, 0.5 * high}) {
      const Ticks ticks = signed_root_ticks({low, high}, 7);
      EXPECT_LE(ticks.ticks.size(), 8U);
      for (const Tick& t : ticks.ticks) {
        EXPECT_GE(t.value, low);
        EXPECT_LE(t.value, high * (1 + 1e-12));
      }
    }
  EXPECT_THROW(signed_root_ticks({1, 0}, 5), core::InvalidInput);
}

TEST(AxisRange, CoversTheUsableValues) {
  const auto range = axis_range({1, NAN, 3, INFINITY}, Scale::linear);
  EXPECT_NEAR(range.low, 0.92, 1e-12);
  EXPECT_NEAR(range.high, 3.08, 1e-12);
  EXPECT_EQ(axis_range({}, Scale::linear), (core::Interval{0, 1}));
  const auto one = axis_range({5, 5 + 1e-15}, Scale::linear);
  EXPECT_NEAR(one.low, 4.5, 1e-9);
  const auto log = axis_range({-1, 0, 10, 1000}, Scale::log10);
  EXPECT_GT(log.low, 0);
  EXPECT_LT(log.low, 10);
}

TEST(ShortNumber, ReadsWell) {
  EXPECT_EQ(short_number(0.01234567), "0.01235");
  EXPECT_EQ(short_number(-2.5), "−2.5");
  EXPECT_EQ(short_number(1234500, 4), "1.234×10⁶");
  EXPECT_EQ(short_number(9.99999e5, 3), "1×10⁶");
  EXPECT_EQ(short_number(0.0000123, 3), "1.23×10⁻⁵");
  EXPECT_EQ(short_number(120, 2), "120");
  EXPECT_EQ(short_number(0), "0");
  EXPECT_EQ(short_number(NAN), "–");
}

TEST(RoundNumber, IsTheNextBelow) {
  EXPECT_DOUBLE_EQ(round_number_below(73), 50);
  EXPECT_DOUBLE_EQ(round_number_below(0.02), 0.02);
  EXPECT_DOUBLE_EQ(round_number_below(1000), 1000);
}

}  // namespace
}  // namespace keyline::figure
