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

}  // namespace
}  // namespace keyline::fairing::detail
