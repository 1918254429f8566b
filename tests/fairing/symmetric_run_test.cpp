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

TEST(AgainstSymmetry, NamesWhatBreaksIt) {
  const auto against = [](auto set) {
    FairOptions options;
    set(options);
    return against_symmetry(options);
  };
  EXPECT_EQ(against([](auto&) {}), "");
  EXPECT_EQ(against([](auto& o) { o.region = core::Interval{0, 0.5}; }), "a region");
  EXPECT_EQ(against([](auto& o) { o.clamp.start = Clamp::g0; }), "clamps");
  EXPECT_EQ(against([](auto& o) { o.clamp.end = Clamp::g0; }), "clamps");
  EXPECT_EQ(against([](auto& o) { o.interpretations.resize(1); }), "readings asked for");
  EXPECT_EQ(against([](auto& o) { o.must_pass = {0}; }), "points to be passed");
  EXPECT_EQ(against([](auto& o) { o.pieces = 1; }), "the shortest chain");
  EXPECT_EQ(against([](auto& o) { o.criterion = Criterion::fewest_pieces; }), "the shortest chain");
}

/// A chain along x and a run of one point beside it.
struct Beside {
  RunResult result;
  Run run;
  explicit Beside(double off) {
    result.chain = {{{0, 0}, 0}, {{-1, 2, 0.1, 0.4}, {-1, 2, 0.4, 0.1}}, false};
    const core::Pose2 at = lac::end_pose(lac::segments(result.chain)[0]);
    run.points = {at.position + off * core::perpendicular_left(core::unit_vector(at.direction))};
    result.fit.feet = {{1, 0}};
    result.point_of = {0};
  }
};

TEST(SolvedRuns, OffsetsAreTheLargestAndWavesTheSum) {
  const Beside one(0.02), two(-0.05), three(0.03);
  EXPECT_NEAR(largest_of({one.result, two.result, three.result}, {one.run, two.run, three.run}),
              0.05, 1e-9);
  EXPECT_EQ(waves_of({one.result, two.result, three.result}), 3);
  EXPECT_EQ(waves_of({}), 0);
}

// Points and their images err independently, so that their distances are root two of the noise; of
// 200 points by three standard errors more, 3 / sqrt(200).
TEST(MirrorWithinNoise, IsWhatTwoErrorsExplain) {
  acquire::KeyLine line;
  line.length = 2;
  for (int i = 0; i < 200; ++i) {
    const double x = (i - 99.5) / 100;
    line.points.push_back({x, x * x + (i < 100 ? 1 : -1) * 0.001 * std::sin(7.0 * i)});
  }
  line.noise = 1;
  const double rms = mirror_within_noise(line, 1)->rms;
  ASSERT_GT(rms, 3e-4);
  const double most = rms / (std::numbers::sqrt2 * (1 + 3 / std::sqrt(200.0)));
  line.noise = 1.01 * most;
  EXPECT_TRUE(mirror_within_noise(line, 1));
  line.noise = 0.99 * most;
  EXPECT_FALSE(mirror_within_noise(line, 1));
  // However exact: 1e-5 of the length is what interpolating points is off by.
  line.noise = 0;
  line.length = 1.01 * rms / 1e-5;
  EXPECT_TRUE(mirror_within_noise(line, 1));
  line.length = 0.99 * rms / 1e-5;
  EXPECT_FALSE(mirror_within_noise(line, 1));
}

// Of 4,000 points a thousand means are looked at, which err half as much.
TEST(MirrorWithinNoise, MeansErrLess) {
  acquire::KeyLine line;
  line.length = 2;
  for (int i = 0; i < 4000; ++i) {
    const double x = (i - 1999.5) / 2000;
    line.points.push_back({x, x * x + 1e-3 * std::sin(40 * x)});
  }
  line.noise = 1;
  const double rms = mirror_within_noise(line, 1)->rms;
  const double most = rms / (std::numbers::sqrt2 * (1 + 3 / std::sqrt(1000.0)) * 0.5);
  line.noise = 1.01 * most;
  EXPECT_TRUE(mirror_within_noise(line, 1));
  line.noise = 0.99 * most;
  EXPECT_FALSE(mirror_within_noise(line, 1));
}

}  // namespace
}  // namespace keyline::fairing::detail
