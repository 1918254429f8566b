#include "keyline/fairing/joint_rates.h"

#include <vector>

#include <gtest/gtest.h>

namespace keyline::fairing::detail {
namespace {

/// Clothoids end to end: their curvature rises at the given rates over a length of 2 each.
std::vector<lac::Segment> of_rates(const std::vector<double>& rates) {
  std::vector<lac::Segment> all;
  double curvature = 0.5;
  for (const double rate : rates) {
    const double next = curvature + 2 * rate;
    all.push_back({{}, -1, 2, curvature, next});
    curvature = next;
  }
  return all;
}

JointRates counted(const std::vector<double>& rates, bool closed) {
  JointRates count;
  count_rates(count, of_rates(rates), closed);
  return count;
}

TEST(CountRates, TellsEqualRatesTurnsAndJumps) {
  // Joints: 0.1 to 0.1, 0.1 to 0.3, 0.3 to -0.2, -0.2 to -0.2; closed: -0.2 to 0.1 too.
  const JointRates open = counted({0.1, 0.1, 0.3, -0.2, -0.2}, false);
  EXPECT_EQ(open.g3, 2);
  EXPECT_EQ(open.jumps, 1);
  EXPECT_EQ(open.turns, 1);
  const JointRates closed = counted({0.1, 0.1, 0.3, -0.2, -0.2}, true);
  EXPECT_EQ(closed.g3, 2);
  EXPECT_EQ(closed.jumps, 1);
  EXPECT_EQ(closed.turns, 2);
  const JointRates one = counted({0.1}, false);
  EXPECT_EQ(one.g3 + one.jumps + one.turns, 0);
}

// A jump of less than a hundredth of the larger rate is none, whichever of the two that is.
TEST(CountRates, AHundredthIsOneRate) {
  for (const double sign : {1.0, -1.0}) {
    EXPECT_EQ(counted({sign * 1.0, sign * 1.0099}, false).g3, 1);
    EXPECT_EQ(counted({sign * 1.0, sign * 1.0102}, false).jumps, 1);
    EXPECT_EQ(counted({sign * 1.0099, sign * 1.0}, false).g3, 1);
    EXPECT_EQ(counted({sign * 1.0102, sign * 1.0}, false).jumps, 1);
  }
}

/// A run whose chain is not the calmest one: its joints stay.
RunResult solved_of(const std::vector<lac::Piece>& pieces) {
  RunResult result;
  result.chain = {{}, pieces, false};
  return result;
}

// Rates of 1, 1, 3 and -2 in the first run, 2 and 2 in the second.
TEST(MakeRatesOne, TellsHowManyAreOfOneRate) {
  std::vector<RunResult> solved{
      solved_of({{-1, 1, 1, 2}, {-1, 1, 2, 3}, {-1, 1, 3, 6}, {-1, 1, 6, 4}}),
      solved_of({{-1, 1, 1, 3}, {-1, 1, 3, 5}})};
  const std::vector<detail::Run> runs(2);
  FairResult result;
  make_rates_one(result, solved, runs, [](std::size_t) { return RunOptions{}; });
  EXPECT_TRUE(result.notes.empty());
  make_rates_one(result, solved, runs, [](std::size_t) {
    RunOptions options;
    options.joints = JointOrder::g3;
    return options;
  });
  ASSERT_EQ(result.notes.size(), 3U);
  EXPECT_TRUE(result.notes[0].starts_with("run 0: no chain with more G3 joints"));
  EXPECT_TRUE(result.notes[1].starts_with("run 1: no chain with more G3 joints"));
  EXPECT_TRUE(result.notes[2].starts_with(
      "of 4 joints 2 are G3; at 1 curvature turns, where none can be; 1 more could be"))
      << result.notes[2];
}

TEST(HeldFromWithin, IsTheNoiseOrWhatWasAskedFor) {
  std::vector<RunResult> solved(2);
  EXPECT_NE(held_from_within(solved).find("noise"), std::string::npos);
  solved[1].joined = true;
  EXPECT_NE(held_from_within(solved).find("one rate"), std::string::npos);
}

}  // namespace
}  // namespace keyline::fairing::detail
