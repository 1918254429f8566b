#include <cmath>

#include <gtest/gtest.h>

#include "keyline/core/similarity.h"
#include "keyline/curve/concept.h"
#include "keyline/fairing/fair.h"

#include "truth.h"

/// What the curve may not pass it does not pass, between the points either.
namespace keyline::fairing {
namespace {

using testing::line_through;

/// A waterline of few points, as tables have them: a fine entrance, a long flat side, a hollow run
/// that touches the centre plane.
const std::vector<core::Point2> kWaterline{{0, 0},     {0.6, 0.12}, {3, 1.9}, {8, 2.4},
                                           {14, 2.45}, {18, 1.5},   {20, 0},  {22, 0.4}};

/// The least y of a member, by samples of our own.
double lowest(const FairResult& result) {
  double least = HUGE_VAL;
  for (const FairCurve& member : result.curves)
    for (int i = 0; i <= 20000; ++i)
      least = std::min(
          least, std::visit([&](const auto& c) { return evaluate(c, i / 20000.0).y; }, member));
  return least;
}

acquire::KeyLine waterline() {
  acquire::KeyLine line = line_through(kWaterline);
  line.noise = 0.01;
  return line;
}

FairOptions within_1cm() {
  FairOptions options;
  options.tolerance = 0.03;
  return options;
}

TEST(KeepInside, HoldsBetweenPointsThatAreFarApart) {
  FairOptions options = within_1cm();
  EXPECT_LT(lowest(fair(waterline(), options).value()), -0.01);
  options.keep_inside = {{Axis::y, 0.0, {}}};
  const FairResult result = fair(waterline(), options).value();
  EXPECT_GE(lowest(result), -1e-9 * result.length);
  EXPECT_EQ(result.outside, 0);
  EXPECT_TRUE(result.within_tolerance);
}

TEST(KeepInside, EndsThatStandOnTheBorderStayThere) {
  FairOptions options = within_1cm();
  options.keep_inside = {{Axis::y, 0.0, {}}};
  const FairResult result = fair(waterline(), options).value();
  EXPECT_NEAR(std::visit([](const auto& c) { return evaluate(c, 0).y; }, result.curves.front()), 0,
              1e-9);
}

TEST(KeepInside, HoldsFromEverySide) {
  acquire::KeyLine turned = waterline();
  for (core::Point2& p : turned.points) p = {5 - p.y, p.x};
  FairOptions options = within_1cm();
  options.keep_inside = {{Axis::x, {}, 5.0}};
  const FairResult result = fair(turned, options).value();
  double most = -HUGE_VAL;
  for (const FairCurve& member : result.curves)
    for (int i = 0; i <= 20000; ++i)
      most = std::max(
          most, std::visit([&](const auto& c) { return evaluate(c, i / 20000.0).x; }, member));
  EXPECT_LE(most, 5 + 1e-9 * result.length);
  EXPECT_TRUE(result.within_tolerance);
}

TEST(KeepInside, PointsThatLieOutsideAreNamed) {
  FairOptions options = within_1cm();
  options.keep_inside = {{Axis::y, 0.1, {}}};
  const auto refused = fair(waterline(), options);
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().path, "keep_inside");
  EXPECT_NE(refused.error().message.find("(0, 0)"), std::string::npos) << refused.error().message;
}

TEST(KeepInside, IsReadFromText) {
  EXPECT_EQ(Bound::from_text("x>=0").value(), (Bound{Axis::x, 0.0, {}}));
  EXPECT_EQ(Bound::from_text("y<=-2.5").value(), (Bound{Axis::y, {}, -2.5}));
  for (const char* wrong : {"", "x", "z>=0", "x>0", "x>=", "x>=a", "x>=nan"})
    EXPECT_FALSE(Bound::from_text(wrong).has_value()) << wrong;
  EXPECT_FALSE(Bound::check({Axis::x, {}, {}}).has_value());
  EXPECT_FALSE(Bound::check({Axis::x, 2.0, 1.0}).has_value());
}

}  // namespace
}  // namespace keyline::fairing
