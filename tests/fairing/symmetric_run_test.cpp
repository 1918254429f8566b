#include "keyline/fairing/symmetric_run.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/lac/chain/chain.h"

/// Feet of points on a circle of three arcs, all known.
namespace keyline::fairing::detail {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

lac::Chain circle(double from, bool closed) {
  lac::Chain chain{{{std::cos(from), std::sin(from)}, from + kTurn / 4}, {}, closed};
  for (const double share : {0.5, 0.2, 0.3}) chain.pieces.push_back({-1, share * kTurn, 1, 1});
  return chain;
}

Run points_on_circle(double from, double turn, int count, bool closed) {
  Run run;
  run.closed = closed;
  for (int i = 0; i < count; ++i) {
    const double a = from + turn * i / (closed ? count : count - 1);
    run.points.push_back({std::cos(a), std::sin(a)});
  }
  return run;
}

/// The farthest that a foot is from its point.
double farthest(const lac::Chain& chain, const Run& run, std::size_t first) {
  const auto segments = lac::segments(chain);
  const std::vector<Foot> feet = feet_on(chain, run, first);
  EXPECT_EQ(feet.size(), run.points.size());
  double most = 0;
  for (std::size_t j = 0; j < feet.size(); ++j) {
    const auto& segment = segments[static_cast<std::size_t>(feet[j].piece)];
    most =
        std::max(most, distance(lac::pose_at(segment, feet[j].fraction).position, run.points[j]));
  }
  return most;
}

// Half of a twenty-fourth of the longest arc away, wherever the seam stands among the points.
TEST(FeetOn, AreTheNearestPlacesRoundTheSeam) {
  const double most = 0.5 * kTurn / 24 / 2 + 1e-9;
  constexpr int kCount = 40;
  const auto run = points_on_circle(1, kTurn, kCount, true);
  for (std::size_t first = 0; first < kCount; ++first) {
    const double start = 1 + kTurn * double(first) / kCount;
    for (const double beside : {-0.05, 0.0, 0.05})
      EXPECT_LT(farthest(circle(start + beside, true), run, first), most) << first << ' ' << beside;
  }
}

TEST(FeetOn, OfAnOpenRunGoFromEndToEnd) {
  lac::Chain chain = circle(0.3, false);
  const double most = 0.5 * kTurn / 24 / 2 + 1e-9;
  EXPECT_LT(farthest(chain, points_on_circle(0.3, kTurn, 50, false), 0), most);
  chain.pieces.pop_back();
  EXPECT_LT(farthest(chain, points_on_circle(0.3, 0.7 * kTurn, 20, false), 0), most);
}

// Twice round: every place is met in both laps, and the foot is that of the point's own.
TEST(FeetOn, AreOfThePointsOwnLap) {
  lac::Chain twice = circle(0, true);
  const auto once = twice.pieces;
  twice.pieces.insert(twice.pieces.end(), once.begin(), once.end());
  constexpr int kCount = 60;
  const auto run = points_on_circle(0, 2 * kTurn, kCount, true);
  const double starts[] = {0, 0.25, 0.35, 0.5, 0.75, 0.85, 1};  // shares of the length
  for (const std::size_t first : {std::size_t{0}, std::size_t{30}}) {
    const auto feet = feet_on(twice, run, first);
    for (std::size_t j = 0; j < kCount; ++j) {
      const auto p = static_cast<std::size_t>(feet[j].piece);
      const double share = starts[p] + feet[j].fraction * (starts[p + 1] - starts[p]);
      const double off = std::abs(std::remainder(share - (double(j) - double(first)) / kCount, 1));
      EXPECT_LT(off, 0.02) << first << ' ' << j;
    }
  }
}

// One of many points may be off its image by twice the tolerance, however small their mean square.
TEST(MirrorWithinNoise, NoPointIsFartherOffThanTwiceTheTolerance) {
  acquire::KeyLine line;
  line.length = 2;
  line.noise = 1;
  for (int i = 0; i <= 200; ++i) {
    const double x = (i - 100) / 100.0;
    line.points.push_back({x, x * x});
  }
  line.points[40].y += 0.025;
  const double off = mirror_within_noise(line, 1)->largest;
  EXPECT_GT(off, 0.01);
  EXPECT_LT(off, 0.026);
  EXPECT_TRUE(mirror_within_noise(line, off / 1.9));
  EXPECT_FALSE(mirror_within_noise(line, off / 2.1));
}

}  // namespace
}  // namespace keyline::fairing::detail
