#include "keyline/fairing/leaning_ends.h"

#include <vector>

#include <gtest/gtest.h>

#include "keyline/numeric/random.h"

#include "truth.h"

namespace keyline::fairing::detail {
namespace {

constexpr double kNoise = 0.001;
constexpr Residuals kResiduals{.rms = kNoise, .noise = kNoise};

/// Points on the x axis from 0 to 1, and the straight dense curve through them.
struct Line {
  std::vector<FitPoint> points;
  DenseCurve curve;
  Line() {
    for (int i = 0; i <= 100; ++i) points.push_back({.position = {0.01 * i, 0}});
    curve = dense_curve(points, false, 40);
  }
};

TEST(LeaningEnds, PullWherePointsOfOneSideAreMoreThanChance) {
  Line line;
  // Each within four errors, which one of 100 points may be; three are not. Over the roots of their
  // number the last two are 6 / 1.41 = 4.24 errors, the last four 9 / 2 = 4.5, the last eight 3.2.
  for (int i = 98; i <= 100; ++i) line.points[i].position.y = 3 * kNoise;
  EXPECT_TRUE(pull_leaning_ends(line.points, line.curve, kResiduals));
  for (int i = 0; i <= 100; ++i) EXPECT_EQ(line.points[i].pull, i >= 97 ? 2 : 1) << i;
}

TEST(LeaningEnds, StayWhereTheyAreHeldOrTheToleranceLeavesRoom) {
  Line line;
  for (int i = 98; i <= 100; ++i) line.points[i].position.y = 3 * kNoise;
  EXPECT_FALSE(pull_leaning_ends(line.points, line.curve, {.rms = 0, .noise = kNoise}));
  EXPECT_FALSE(pull_leaning_ends(line.points, line.curve,
                                 {.rms = kNoise, .noise = kNoise, .left = 3 * kNoise}));
  line.curve.hold_end = Hold::position;
  EXPECT_FALSE(pull_leaning_ends(line.points, line.curve, kResiduals));
}

// Sums of white noise over the root of their number are as wide as one error: beyond 3.8 of them
// one of 2 * 6 windows lies in some thousand cases.
TEST(LeaningEnds, AreNotSeenInNoise) {
  numeric::Random random(4);
  int seen = 0;
  for (int trial = 0; trial < 500; ++trial) {
    Line line;
    for (FitPoint& p : line.points) p.position.y = kNoise * random.normal();
    seen += pull_leaning_ends(line.points, line.curve, kResiduals) ? 1 : 0;
  }
  EXPECT_LE(seen, 3);
}

// Ends of curves that least variation alone leaves 4.6 to 5.4 errors off.
TEST(LeaningEnds, OfNoisyChainsComeBack) {
  for (const auto& [seed, noise] : {std::pair{45, 1e-4}, {45, 3e-4}, {47, 1e-4}, {108, 1e-4}}) {
    const lac::Chain truth = testing::random_chain(seed);
    const auto points = testing::measure(truth, 400, noise, 1000 + seed);
    const auto found = fair(testing::line_through(points));
    EXPECT_LE(testing::compare(truth, found.value()).largest, 4 * noise) << seed << ' ' << noise;
  }
}

}  // namespace
}  // namespace keyline::fairing::detail
