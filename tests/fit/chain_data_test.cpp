#include "keyline/fit/chain_data.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/core/error.h"

namespace keyline::fit {
namespace {

using core::Point2;
using Indices = std::vector<std::size_t>;

constexpr double kRadius = 3;

/// Points of a circle from its lowest on, `step` rad apart.
std::vector<Point2> round(int n, double step) {
  std::vector<Point2> points;
  for (int i = 0; i < n; ++i)
    points.push_back({kRadius * std::sin(i * step), -kRadius * std::cos(i * step)});
  return points;
}

// Chords over 8 points from either side turn by 8 steps and are 2 r sin(4 steps) long.
TEST(ChainData, OfACircleHasItsDirectionAndCurvature) {
  const int n = 49;  // the neighbours taken in: 49 / 12 = 4 for directions, 8 for curvatures
  const double step = 2 * M_PI / n;
  const double curvature = 8 * step / (2 * kRadius * std::sin(4 * step));
  const ChainData open = prepare_chain_data(round(n, step), false);
  const ChainData closed = prepare_chain_data(round(n, step), true);
  ASSERT_EQ(open.points.size(), 49U);
  ASSERT_EQ(closed.points.size(), 50U);
  EXPECT_EQ(closed.points.back(), closed.points.front());
  for (std::size_t i = 0; i < 50; ++i) {
    const double at = static_cast<double>(i);
    EXPECT_NEAR(closed.length[i], at * 2 * kRadius * std::sin(step / 2), 1e-12);
    EXPECT_NEAR(closed.direction[i], at * step, 1e-12);
    EXPECT_NEAR(closed.curvature[i], curvature, 1e-12);
    if (i == 49) continue;
    if (i >= 4 && i < 45) {
      EXPECT_NEAR(open.direction[i], at * step, 1e-12);
    }
    EXPECT_NEAR(open.curvature[i], i >= 8 && i < 41 ? curvature : 0, 1e-12) << i;
  }
  EXPECT_THROW(prepare_chain_data({{0, 0}, {0, 0}, {1, 0}}, false), core::InvalidInput);
}

TEST(ChainData, JointsHaveEqualSharesOfLengthAndOfTurning) {
  EXPECT_EQ(joint_indices(prepare_chain_data(round(48, 2 * M_PI / 48), true), 4),
            (Indices{0, 12, 24, 36, 48}));
  // Straight for 100, then half round within 1.6: half way is the corner.
  std::vector<Point2> points;
  for (int i = 0; i < 100; ++i) points.push_back({static_cast<double>(i), 0});
  for (int i = 0; i < 100; ++i)
    points.push_back({100 + 0.5 * std::sin(i * M_PI / 99), 0.5 - 0.5 * std::cos(i * M_PI / 99)});
  const Indices halves = joint_indices(prepare_chain_data(points, false), 2);
  ASSERT_EQ(halves.size(), 3U);
  EXPECT_NEAR(static_cast<double>(halves[1]), 100, 8);
}

TEST(ChainData, PiecesNearTheWorstAreHalvedWhileThereIsRoom) {
  std::vector<Point2> points;
  for (int i = 0; i <= 80; ++i) points.push_back({static_cast<double>(i), 0});
  const ChainData data = prepare_chain_data(points, false);
  const Indices even{0, 20, 40, 60, 80};
  const auto split = [&](const std::vector<double>& deviations, double tolerance, int most) {
    Indices joints = even;
    EXPECT_TRUE(split_worst(data, deviations, tolerance, most, joints));
    return joints;
  };
  // Seven tenths of the largest are near it.
  EXPECT_EQ(split({1, 0.75, 0.65, 0.1}, 0.2, 48), (Indices{0, 10, 20, 30, 40, 60, 80}));
  EXPECT_EQ(split({0.1, 0.65, 0.1, 1}, 0.2, 48), (Indices{0, 20, 40, 60, 70, 80}));
  // What keeps the tolerance is not split beside what does not.
  EXPECT_EQ(split({1, 0.75, 0.65, 0.1}, 0.8, 48), (Indices{0, 10, 20, 40, 60, 80}));
  // At most five pieces, six.
  EXPECT_EQ(split({1, 1, 1, 1}, 0.2, 5), (Indices{0, 10, 20, 40, 60, 80}));
  EXPECT_EQ(split({1, 1, 1, 1}, 0.2, 6), (Indices{0, 10, 20, 30, 40, 60, 80}));
  Indices joints = even;
  EXPECT_FALSE(split_worst(data, {1, 1, 1, 1}, 0.2, 4, joints));
  EXPECT_EQ(joints, even);
  joints = {0, 5, 10};  // fewer than six points apart
  EXPECT_FALSE(split_worst(data, {1, 1}, 0.2, 48, joints));
}

}  // namespace
}  // namespace keyline::fit
