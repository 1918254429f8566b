#include "keyline/lac/g2/raise_joints.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/lac/chain/departure.h"
#include "keyline/lac/g2/rate_run.h"

/// What becomes of joints, and of which cuts the answer is made.
namespace keyline::lac {
namespace {

std::vector<JointFate> fates(const Chain& chain, const RaiseOptions& options = {}) {
  std::vector<JointFate> all;
  const auto raised = raise_joints(chain, options);
  if (raised)
    for (const RaisedJoint& joint : raised->joints) all.push_back(joint.fate);
  return all;
}

using enum JointFate;
using Fates = std::vector<JointFate>;

// Each joint of a chain by what its two sides are.
TEST(RaiseJoints, TellsWhatJointsAre) {
  const auto fate = [](const Piece& a, const Piece& b) {
    const Fates all = fates({{}, {a, b}, false});
    return all.size() == 1 ? all[0] : not_found;
  };
  EXPECT_EQ(fate({-1, 1, 1, 2}, {-1, 1, 2, 1}), turn);
  EXPECT_EQ(fate({-1, 1, 1, 2}, {-1, 1, 2.1, 3}), jump);
  EXPECT_EQ(fate({-1, 1, 1, 2}, {-1, 1, 2, 2}), constant);
  EXPECT_EQ(fate({-1, 1, 2, 2}, {-1, 1, 2, 3}), constant);
  EXPECT_EQ(fate({-1, 1, 2, 2}, {-1, 3, 2, 2}), already);
  EXPECT_EQ(fate({-1, 1, 1, 2}, {-1, 2, 2, 4}), already);  // both rise by 1 per length
  EXPECT_EQ(fate({-1, 1, 1, 2}, {-1, 1, 2, 3.5}), raised);
  EXPECT_EQ(fate({2, 1, 1, HUGE_VAL}, {2, 1, HUGE_VAL, 1}), cusp);
}

// A jump counts from a billionth of the curvature, or of one over the shorter length, on.
TEST(RaiseJoints, JumpsOfABillionthAreNone) {
  const auto fate = [](double after) {
    return fates({{}, {{-1, 1, 1, 2}, {-1, 1, after, 3.5}}, false})[0];
  };
  EXPECT_EQ(fate(2 + 1.9e-9), raised);
  EXPECT_EQ(fate(2 + 2.1e-9), jump);
  const auto near_zero = [](double after) {
    return fates({{}, {{-1, 0.5, -1, 0}, {-1, 2, after, 3}}, false})[0];
  };
  EXPECT_NE(near_zero(1.9e-9), jump);
  EXPECT_EQ(near_zero(2.1e-9), jump);
}

TEST(RaiseJoints, ClosedChainsHaveTheirClosingJointLast) {
  Chain chain{{}, {{-1, 1, 1, 2}, {-1, 1, 2, 3.5}, {-1, 1, 3.5, 1}}, true};
  EXPECT_EQ(fates(chain), (Fates{raised, turn, turn}));
  chain.closed = false;
  EXPECT_EQ(fates(chain), (Fates{raised, turn}));
}

TEST(RaiseJoints, RatesAgreeAndWhatIsHeldStays) {
  const Chain chain{{{1, 1}, 0.3}, {{-1, 1, 1, 2}, {0.5, 1, 2, 3.5}, {-0.5, 0.5, 3.5, 7}}, false};
  for (const HeldJoints hold : {HeldJoints::ends, HeldJoints::joints}) {
    const auto raised = raise_joints(chain, {hold, {}});
    ASSERT_TRUE(raised);
    EXPECT_EQ(raised->chain.pieces.size() == 3, hold == HeldJoints::ends);
    for (const RaisedJoint& joint : raised->joints) {
      EXPECT_EQ(joint.fate, JointFate::raised);
      EXPECT_NEAR(joint.rate_after[0] / joint.rate_after[1], 1, 1e-9);
      EXPECT_NEAR(joint.rate_before[0], curvature_rate(chain.pieces[joint.piece - 1], 1), 1e-12);
      EXPECT_NEAR(joint.rate_before[1], curvature_rate(chain.pieces[joint.piece], 0), 1e-12);
    }
    EXPECT_LT(largest_joint_gap(raised->chain).curvature_rate, 1e-7);
    const core::Pose2 end = end_pose(chain), now = end_pose(raised->chain);
    EXPECT_LT(core::distance(end.position, now.position), 1e-11);
    EXPECT_NEAR(end.direction, now.direction, 1e-11);
    EXPECT_EQ(raised->chain.pieces.front().curvature_start, 1);
    EXPECT_EQ(raised->chain.pieces.back().curvature_end, 7);
    if (hold == HeldJoints::ends) continue;
    const auto places = joints(chain);
    for (std::size_t k = 0; k < raised->joints.size(); ++k)
      EXPECT_LT(core::distance(raised->joints[k].place, places[k + 1].position), 1e-11);
  }
}

// Of the cuts into three parts the one that departs least, whatever the limit: none of the three by
// itself is better.
TEST(RaiseJoints, TakesTheCalmestOfThreeCuts) {
  int apart = 0;
  for (const Chain& chain : {Chain{{}, {{-1, 1, 0.2, 1}, {-1, 1, 1, 5}}, false},
                             Chain{{}, {{-1, 1, 5, 1}, {0.5, 2, 1, 0.2}}, false},
                             Chain{{}, {{-2, 0.5, 1, 2}, {-0.5, 1, 2, 3}, {1, 1, 3, 9}}, false},
                             Chain{{}, {{0.5, 1, 1, 4}, {-1, 0.3, 4, 5}}, false}}) {
    double least = HUGE_VAL;
    double first = HUGE_VAL;
    for (const double skew : {1.0, 0.7, 1.5}) {
      const auto run = detail::solve_rate_run(chain.pieces, {3, skew});
      if (!run) continue;
      double most = 0;
      for (std::size_t i = 0; i < chain.pieces.size(); ++i)
        most =
            std::max(most, departure_bound({{}, {chain.pieces[i]}, false}, {{}, (*run)[i], false}));
      least = std::min(least, most);
      if (skew == 1) first = most;
    }
    ASSERT_TRUE(std::isfinite(least));
    apart += first > 1.01 * least;
    for (const std::optional<double> limit : {std::optional<double>{}, {10 * least}}) {
      const auto raised = raise_joints(chain, {HeldJoints::joints, limit});
      ASSERT_TRUE(raised);
      EXPECT_LE(raised->departure, least * (1 + 1e-9));
      for (const RaisedJoint& joint : raised->joints) EXPECT_EQ(joint.fate, JointFate::raised);
    }
  }
  EXPECT_GT(apart, 0);  // of one at least the first is not the calmest
}

TEST(RaiseJoints, JointsThatWouldDepartTooFarStay) {
  const Chain chain{{}, {{-1, 1, 0.2, 1}, {-1, 1, 1, 5}}, false};
  const auto free = raise_joints(chain);
  ASSERT_TRUE(free);
  EXPECT_GT(free->departure, 0);
  const auto held = raise_joints(chain, {HeldJoints::ends, 0.99 * free->departure});
  EXPECT_EQ(held->joints[0].fate, beyond_limit);
  EXPECT_EQ(held->departure, 0);
  EXPECT_EQ(held->chain.pieces, chain.pieces);
  EXPECT_EQ(raise_joints(chain, {HeldJoints::ends, 1.01 * free->departure})->joints[0].fate,
            raised);
}

}  // namespace
}  // namespace keyline::lac
