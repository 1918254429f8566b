#include "keyline/fairing/meet.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

/// Ends brought to their targets: what is met and what stays.
namespace keyline::fairing::detail {
namespace {

constexpr double kPi = std::numbers::pi;

lac::Chain three() {
  return {{{0, 0}, 0.2}, {{-1, 1, 0.5, 1}, {0.5, 1, 1, 3}, {-2, 1, 3, 0.5}}, false};
}

core::Pose2 nearby(const lac::Chain& chain) {
  core::Pose2 wanted = lac::end_pose(chain);
  wanted.position.x += 2e-4;
  wanted.position.y -= 1e-4;
  wanted.direction -= 1e-4;
  return wanted;
}

// Freed one by one: what is not free stays to the bit, and the rest serves.
TEST(MeetTarget, ChangesWhatIsFree) {
  for (const bool direction : {false, true})
    for (const bool start_direction : {false, true})
      for (const bool start_curvature : {false, true})
        for (const bool end_curvature : {false, true}) {
          lac::Chain chain = three();
          const core::Pose2 wanted = nearby(chain);
          EXPECT_LE(meet_target(chain, {wanted, direction, start_direction, start_curvature,
                                        end_curvature}),
                    1e-13);
          const core::Pose2 end = lac::end_pose(chain);
          EXPECT_LE(core::distance(end.position, wanted.position), 1e-14);
          EXPECT_EQ(std::abs(end.direction - wanted.direction) < 1e-13, direction);
          EXPECT_EQ(chain.start.direction != 0.2, start_direction);
          EXPECT_EQ(chain.pieces.front().curvature_start != 0.5, start_curvature);
          EXPECT_EQ(chain.pieces.back().curvature_end != 0.5, end_curvature);
          for (int i = 0; i < 2; ++i)
            EXPECT_EQ(chain.pieces[i].curvature_end, chain.pieces[i + 1].curvature_start);
          EXPECT_EQ(chain.pieces[1].alpha, 0.5);
          EXPECT_EQ(chain.start.position, (core::Point2{0, 0}));
        }
}

// The least change: no other of the same effect is smaller, so that a tenth of the target is met by
// a tenth of the change.
TEST(MeetTarget, ChangesAsLittleAsWillDo) {
  lac::Chain one = three(), tenth = three();
  core::Pose2 wanted = lac::end_pose(one);
  const core::Pose2 from = wanted;
  wanted.position.x += 1e-5;
  meet_target(one, {wanted, true});
  wanted.position.x = from.position.x + 1e-6;
  meet_target(tenth, {wanted, true});
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(one.pieces[i].length - 1, 10 * (tenth.pieces[i].length - 1), 1e-9);
    EXPECT_LT(std::abs(one.pieces[i].length - 1), 1e-4);
  }
}

// Arcs stay arcs, with their neighbours' curvatures theirs.
TEST(MeetTarget, ArcsStayArcs) {
  lac::Chain chain{{{0, 0}, 0}, {{-1, 1, 0.5, 1}, {-1, 1, 1, 1}, {-1, 1, 1, 2}}, false};
  EXPECT_LE(meet_target(chain, {.pose = nearby(chain), .direction = true}), 1e-13);
  EXPECT_EQ(chain.pieces[1].curvature_start, chain.pieces[1].curvature_end);
  EXPECT_NE(chain.pieces[1].curvature_start, 1);
  EXPECT_EQ(chain.pieces[0].curvature_end, chain.pieces[1].curvature_start);
  EXPECT_EQ(chain.pieces[2].curvature_end, 2);
  // An arc at the end has the curvature that is held there, and hands it on.
  lac::Chain last{{{0, 0}, 0}, {{-1, 1, 0.5, 1}, {-1, 1, 1, 1}}, false};
  meet_target(last, {.pose = nearby(last)});
  EXPECT_EQ(last.pieces[0].curvature_end, 1);
  EXPECT_EQ(last.pieces[1].curvature_start, 1);
}

TEST(MeetTarget, LinesStayLines) {
  lac::Chain chain{{{0, 0}, 0}, {{-1, 1, 0, 0}, {-1, 1, 0, 1}, {-1, 1, 1, 0.5}}, false};
  EXPECT_LE(meet_target(chain, {.pose = nearby(chain), .direction = true}), 1e-13);
  EXPECT_EQ(chain.pieces[0].curvature_end, 0);
  EXPECT_EQ(chain.pieces[1].curvature_start, 0);
}

// Closed: the ends meet, and the seam keeps one curvature.
TEST(MeetTarget, ClosedChainsComeRound) {
  lac::Chain chain{{{1, 0}, kPi / 2}, {}, true};
  for (int i = 0; i < 4; ++i)
    chain.pieces.push_back({-1, kPi / 2 * (1 + 1e-4 * i), 1 + 1e-4 * i, 1 + 1e-4 * ((i + 1) % 4)});
  EXPECT_LE(meet_target(chain, {chain.start, true}), 1e-13);
  const core::Pose2 end = lac::end_pose(chain);
  EXPECT_LE(core::distance(end.position, {1, 0}), 1e-14);
  EXPECT_NEAR(end.direction, kPi / 2 + 2 * kPi, 1e-13);
  EXPECT_EQ(chain.pieces.back().curvature_end, chain.pieces.front().curvature_start);
}

// Told how far off: a single line cannot turn aside.
TEST(MeetTarget, TellsWhatIsMissed) {
  lac::Chain line{{{0, 0}, 0}, {{-1, 2, 0, 0}}, false};
  EXPECT_NEAR(meet_target(line, {.pose = {{2, 0.1}, 0}}), 0.1, 1e-14);
  EXPECT_NEAR(meet_target(line, {.pose = {{2, 0}, 0.1}, .direction = true}), 0.2, 1e-14);
  EXPECT_NEAR(meet_target(line, {.pose = {{2.1, 0}, 0}}), 0, 1e-14);
  EXPECT_NEAR(line.pieces[0].length, 2.1, 1e-14);
}

}  // namespace
}  // namespace keyline::fairing::detail
