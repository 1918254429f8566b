#include <cmath>

#include <gtest/gtest.h>

#include "keyline/core/angle.h"
#include "keyline/core/similarity.h"
#include "keyline/curve/concept.h"
#include "keyline/fairing/fair.h"
#include "keyline/numeric/random.h"

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

// Measured ends lie on either side of the border that the curve ends at, square to it or slanting.
TEST(KeepInside, EndsThatErrOverTheBorderCostNoCalm) {
  const auto half = [](std::uint64_t seed, bool lens) {
    numeric::Random random(seed);
    std::vector<core::Point2> points;
    for (int i = 0; i < 30; ++i) {
      const double t = core::kPi * i / 29, x = 3 * std::cos(t);
      points.push_back({x + 0.002 * random.normal(),
                        (lens ? 1 - x * x / 9 : std::sin(t)) + 0.002 * random.normal()});
    }
    points.front().y = -0.004;
    return points;
  };
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
    for (const bool lens : {false, true}) {
      FairOptions options;
      const auto points = half(seed, lens);
      const FairResult free = fair(line_through(points), options).value();
      options.keep_inside = {{Axis::y, 0.0, {}}};
      const FairResult result = fair(line_through(points), options).value();
      EXPECT_FALSE(result.calm_missed) << seed << lens;
      EXPECT_TRUE(result.within_tolerance) << seed << lens;
      EXPECT_GE(lowest(result), -1e-9 * result.length) << seed << lens;
      EXPECT_LE(result.fairness.answer.energy, 3 * free.fairness.answer.energy + 10)
          << seed << lens;
    }
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
