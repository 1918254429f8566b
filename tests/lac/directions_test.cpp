#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "keyline/core/angle.h"
#include "keyline/lac/hermite/hermite.h"

namespace keyline::lac {
namespace {

using core::ErrorCode;
using core::Pose2;

double residual(const Segment& s, const Pose2& end) {
  const Pose2 got = end_pose(s);
  return std::max(distance(got.position, end.position),
                  std::abs(core::wrap_angle(got.direction - end.direction)));
}

TEST(SolveG1Directions, DrawsCAndSForEveryNegativeSlope) {
  std::mt19937 random(31);
  std::uniform_real_distribution<double> unit(0, 1);
  double worst = 0;
  for (int n = 0; n < 600; ++n) {
    const double alpha = -std::exp(std::log(0.05) + unit(random) * std::log(200));
    const double from = 3.1 * (2 * unit(random) - 1);
    const double to = 3.1 * (2 * unit(random) - 1);
    const auto solution = solve_g1_directions({{0, 0}, from}, {{1, 0}, to}, alpha);
    if (!solution) {
      ADD_FAILURE() << alpha << ' ' << from << ' ' << to << solution.error().message;
      continue;
    }
    const double r = residual(solution->segment, {{1, 0}, to});
    EXPECT_LE(r, 1e-12) << alpha << ' ' << from << ' ' << to << ' ' << solution->segment.length;
    worst = std::max(worst, r);
    EXPECT_LE(solution->segment.length, 100) << alpha << ' ' << from << ' ' << to;
  }
  EXPECT_LE(worst, 5e-14);
}

TEST(SolveG1Directions, SmallAnglesOfTheClothoid) {
  // Linear theory: k0 = -(4 a + 2 b), k1 = 2 a + 4 b for directions a, b against the chord.
  const auto s = solve_g1_directions({{0, 0}, 1e-5}, {{1, 0}, 2e-5}, -1);
  ASSERT_TRUE(s);
  EXPECT_NEAR(s->segment.curvature_start, -8e-5, 1e-12);
  EXPECT_NEAR(s->segment.curvature_end, 10e-5, 1e-12);
}

TEST(SolveG1Directions, ParallelEndsAreSymmetric) {
  for (const double alpha : {-0.5, -1.0, -3.0}) {
    const auto s = solve_g1_directions({{1, 2}, 0.8}, {{4, 2}, 0.8}, alpha);
    ASSERT_TRUE(s);
    EXPECT_NEAR(s->segment.curvature_start, -s->segment.curvature_end, 1e-12);
    EXPECT_NEAR(distance(evaluate(s->segment, 0.5), {2.5, 2}), 0, 1e-12);
  }
}

TEST(SolveG1Directions, NonNegativeSlopesRefuseToInflect) {
  for (const double alpha : {0.0, 0.5, 1.0, 2.0}) {
    const auto s = solve_g1_directions({{0, 0}, 0.5}, {{1, 0}, 0.7}, alpha);
    ASSERT_FALSE(s);
    EXPECT_EQ(s.error().code, ErrorCode::undrawable);
    EXPECT_NE(s.error().hint.find("-0.01"), std::string::npos) << s.error().hint;
    EXPECT_TRUE(solve_g1_directions({{0, 0}, -0.5}, {{1, 0}, 0.7}, alpha));
  }
  EXPECT_TRUE(solve_g1_directions({{0, 0}, 0.5}, {{1, 0}, 0.7}, -0.01));
}

TEST(SolveG1Directions, AgreesWithThreeHandles) {
  const auto handles = solve_g1({0, 0}, {0.5, -0.4}, {1, 0}, -1);
  const double out = core::direction_of({0.5, 0.4});
  const auto poses = solve_g1_directions({{0, 0}, -out}, {{1, 0}, out}, -1);
  ASSERT_TRUE(handles && poses);
  EXPECT_NEAR(handles->segment.length, poses->segment.length, 1e-14);
}

TEST(SolveG1Directions, TurnsByMoreThanHalf) {
  for (const double alpha : {-1.0, 0.3, 1.0, 2.0}) {
    const auto s = solve_g1_directions({{0, 0}, -2.4}, {{1, 0}, 2.2}, alpha);
    ASSERT_TRUE(s) << alpha << s.error().message;
    EXPECT_LE(residual(s->segment, {{1, 0}, 2.2}), 1e-12);
    EXPECT_NEAR(total_turning(s->segment), 4.6, 1e-12);
  }
}

TEST(SolveG1Directions, BadInputIsNormalInput) {
  const auto code = [](const Pose2& a, const Pose2& b, double alpha) {
    const auto s = solve_g1_directions(a, b, alpha);
    return s ? ErrorCode::internal : s.error().code;
  };
  EXPECT_EQ(code({{0, 0}, 0}, {{0, 0}, 1}, -1), ErrorCode::bad_input);
  EXPECT_EQ(code({{0, 0}, NAN}, {{1, 0}, 1}, -1), ErrorCode::bad_input);
  EXPECT_EQ(code({{0, 0}, 0}, {{1, INFINITY}, 1}, -1), ErrorCode::bad_input);
  EXPECT_EQ(code({{0, 0}, 0}, {{1, 0}, 1}, NAN), ErrorCode::bad_input);
  const auto line = solve_g1_directions({{0, 0}, 0}, {{2, 0}, 0}, 0.5);
  ASSERT_TRUE(line);
  EXPECT_EQ(line->segment.length, 2);
  for (const double scale : {1e-150, 1e150}) {
    const auto s = solve_g1_directions({{0, 0}, 0.3}, {{scale, 0}, 0.4}, -1);
    ASSERT_TRUE(s);
    EXPECT_LE(residual(s->segment, {{scale, 0}, 0.4}) / std::max(1.0, scale), 1e-14);
  }
}

}  // namespace
}  // namespace keyline::lac
