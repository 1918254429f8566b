#include "keyline/fairing/chain_edit.h"

#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/lac/chain/chain.h"

/// Surgery on chains of several pieces, by what each joint and foot was before.
namespace keyline::fairing::detail {
namespace {

/// Pieces of lengths 1, 2, 3, 4 with curvatures 1 to 5; a foot at 0.25 and 0.75 of each.
FitChain four() {
  FitChain chain;
  for (int i = 0; i <= 4; ++i) chain.joints.push_back({{1.0 * i, 0}, 0.1 * i, 1.0 + i});
  for (int i = 0; i < 4; ++i) {
    chain.pieces.push_back({.length = 1.0 + i, .alpha = -0.1 * i});
    chain.feet.push_back({i, 0.25});
    chain.feet.push_back({i, 0.75});
  }
  chain.first_at_start = chain.last_at_end = true;
  return chain;
}

TEST(ChainEdit, AJointLessMovesTheFeetBehindIt) {
  const FitChain merged = without_joint(four(), 2);
  ASSERT_EQ(merged.pieces.size(), 3U);
  ASSERT_EQ(merged.joints.size(), 4U);
  EXPECT_EQ(merged.pieces[0].length, 1);
  EXPECT_EQ(merged.pieces[1].length, 5);
  EXPECT_EQ(merged.pieces[2].length, 4);
  EXPECT_EQ(merged.joints[1].position.x, 1);
  EXPECT_EQ(merged.joints[2].position.x, 3);
  const std::vector<int> piece{0, 0, 1, 1, 1, 1, 2, 2};
  const std::vector<double> along{0.25,         0.75,         0.25 * 2, 0.75 * 2,
                                  2 + 0.25 * 3, 2 + 0.75 * 3, 0.25,     0.75};
  for (std::size_t j = 0; j < 8; ++j) {
    EXPECT_EQ(merged.feet[j].piece, piece[j]) << j;
    const double length = piece[j] == 1 ? 5 : 1;
    EXPECT_NEAR(merged.feet[j].fraction * length, along[j], 1e-14) << j;
  }
}

// Where a foot stands and how the curve runs there is told by the piece as it was.
TEST(ChainEdit, AJointMoreLeavesTheCurveAndItsFeet) {
  const std::vector<lac::Piece> laid{{-0.5, 2, 0.5, 1.5}, {-2, 3, 1.5, 0.4}, {0.5, 1, 0.4, 0.9}};
  const lac::Chain before{{{1, 2}, 0.3}, laid, false};
  FitChain chain;
  for (const core::Pose2& pose : joints(before))
    chain.joints.push_back({pose.position, pose.direction});
  for (std::size_t i = 0; i < laid.size(); ++i) {
    chain.joints[i].curvature = laid[i].curvature_start;
    chain.joints[i + 1].curvature = laid[i].curvature_end;
    chain.pieces.push_back({.length = laid[i].length, .alpha = laid[i].alpha});
    for (const double t : {0.1, 0.3, 0.7}) chain.feet.push_back({static_cast<int>(i), t});
  }
  const auto place = [](const FitChain& c, const Foot& foot) {
    const FitJoint& from = c.joints[foot.piece];
    const FitPiece& p = c.pieces[foot.piece];
    const lac::Segment s{{from.position, from.direction},
                         p.alpha,
                         p.length,
                         from.curvature,
                         c.joints[foot.piece + 1].curvature};
    return lac::jet(s, foot.fraction);
  };
  const FitChain more = with_joint(chain, 1, 0.4);
  ASSERT_EQ(more.pieces.size(), 4U);
  ASSERT_EQ(more.joints.size(), 5U);
  EXPECT_EQ(more.pieces[1].length + more.pieces[2].length, 3);
  for (std::size_t j = 0; j < chain.feet.size(); ++j) {
    const auto was = place(chain, chain.feet[j]), is = place(more, more.feet[j]);
    EXPECT_NEAR(distance(was.point, is.point), 0, 1e-14) << j;
    EXPECT_NEAR(curve::curvature(was), curve::curvature(is), 1e-13) << j;
  }
}

// The slope of what was one piece before comes back, as far as four places tell the mean of its
// curvature.
TEST(ChainEdit, HalvesOfOnePieceBecomeItAgain) {
  for (const double alpha : {-2.5, -1.5, -0.5, 0.5, 1.5})
    for (const double at : {0.3, 0.6}) {
      const lac::Segment whole{{{0, 0}, 0}, alpha, 2, 0.5, 1.5};
      FitChain chain;
      const core::Pose2 middle = lac::pose_at(whole, at);
      const core::Pose2 end = lac::end_pose(whole);
      chain.joints = {{{0, 0}, 0, 0.5},
                      {middle.position, middle.direction, lac::curvature(whole, at)},
                      {end.position, end.direction, 1.5}};
      chain.pieces = {{.length = 2 * at, .alpha = 0}, {.length = 2 - 2 * at, .alpha = 0}};
      const FitChain merged = without_joint(chain, 1);
      EXPECT_NEAR(merged.pieces[0].alpha, alpha, 4e-3) << alpha << ' ' << at;
      EXPECT_EQ(merged.joints[0].curvature, 0.5);
      EXPECT_EQ(merged.joints[1].curvature, 1.5);
    }
}

// Through an inflection, where slopes end at -0.3 and -5 and four places tell less.
TEST(ChainEdit, HalvesOfAnInflectedPieceBecomeItAgain) {
  for (const double alpha : {-4.0, -2.0, -1.0, -0.5}) {
    const lac::Segment whole{{{0, 0}, 0}, alpha, 1, -0.5, 1.5};
    FitChain chain;
    const core::Pose2 end = lac::end_pose(whole);
    chain.joints = {
        {{0, 0}, 0, -0.5}, {{}, 0, lac::curvature(whole, 0.5)}, {{}, end.direction, 1.5}};
    chain.pieces.assign(2, {.length = 0.5});
    EXPECT_NEAR(without_joint(chain, 1).pieces[0].alpha, alpha, 0.2) << alpha;
  }
}

TEST(ChainEdit, EqualEndsBecomeAClothoidOfThem) {
  FitChain chain = four();
  chain.joints[0].curvature = 1;
  chain.joints[2].curvature = 1;
  chain.joints[2].direction = 3;  // as far as an arc of 1 along 1 + 2 turns
  const FitChain merged = without_joint(chain, 1);
  EXPECT_EQ(merged.pieces[0].alpha, -1);
  EXPECT_NEAR(merged.joints[0].curvature, 1, 1e-12);
  EXPECT_NEAR(merged.joints[1].curvature, 1, 1e-12);
}

// Held at the end alone: what is missing is put on the other end.
TEST(ChainEdit, AHeldEndStaysToo) {
  FitChain chain = four();
  chain.hold_end = Hold::curvature;
  chain.joints[4].direction = chain.joints[2].direction + 100;
  FitChain merged = without_joint(chain, 3);
  EXPECT_EQ(merged.joints.back().curvature, 5);
  EXPECT_NE(merged.joints[2].curvature, 3);
  // Not the last joint: it may move.
  merged = without_joint(chain, 1);
  EXPECT_EQ(merged.joints.back().curvature, 5);
}

TEST(ChainEdit, StartOfAClosedChainMovesOn) {
  FitChain chain = four();
  chain.closed = true;
  chain.turning = 2 * std::numbers::pi;
  chain.joints.back() = chain.joints.front();
  chain.joints.back().direction += chain.turning;
  rotate_start(chain, 3);
  ASSERT_EQ(chain.joints.size(), 5U);
  EXPECT_EQ(chain.joints[0].position.x, 3);
  EXPECT_EQ(chain.joints[1].position.x, 0);
  EXPECT_NEAR(chain.joints[1].direction, chain.turning, 1e-14);
  EXPECT_NEAR(chain.joints[4].direction - chain.joints[0].direction, chain.turning, 1e-14);
  EXPECT_EQ(chain.pieces[0].length, 4);
  EXPECT_EQ(chain.pieces[1].length, 1);
  EXPECT_EQ(chain.feet[0].piece, 1);  // of the first piece, which is the second now
  EXPECT_EQ(chain.feet[7].piece, 0);
  EXPECT_EQ(chain.feet[7].fraction, 0.75);
}

TEST(ChainEdit, WindowsKnowWhatTheyAreCutFrom) {
  const FitChain chain = four();
  std::vector<FitPoint> points(8);
  for (int j = 0; j < 8; ++j) points[j].weight = j;
  const Window w = cut_window(chain, points, 1, 2);
  ASSERT_EQ(w.chain.joints.size(), 3U);
  ASSERT_EQ(w.chain.pieces.size(), 2U);
  EXPECT_EQ(w.first, 1);
  EXPECT_EQ(w.chain.joints[0].position.x, 1);
  EXPECT_EQ(w.chain.pieces[1].length, 3);
  ASSERT_EQ(w.points.size(), 4U);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(w.index[k], k + 2);
    EXPECT_EQ(w.points[k].weight, k + 2);
    EXPECT_EQ(w.chain.feet[k].piece, static_cast<int>(k / 2));
  }
  EXPECT_EQ(w.chain.hold_start, Hold::curvature);
  EXPECT_EQ(w.chain.hold_end, Hold::curvature);
  EXPECT_FALSE(w.chain.first_at_start);
  EXPECT_FALSE(w.chain.last_at_end);
  const Window front = cut_window(chain, points, 0, 2);
  EXPECT_EQ(front.chain.hold_start, Hold::free);
  EXPECT_TRUE(front.chain.first_at_start);
  EXPECT_FALSE(front.chain.last_at_end);
  const Window back = cut_window(chain, points, 2, 2);
  EXPECT_EQ(back.chain.hold_end, Hold::free);
  EXPECT_EQ(back.chain.hold_start, Hold::curvature);
  EXPECT_TRUE(back.chain.last_at_end);
}

// A window of two pieces that became one: all behind it moves up by one.
TEST(ChainEdit, AShorterWindowMovesWhatIsBehindIt) {
  const FitChain chain = four();
  const std::vector<FitPoint> points(8);
  Window w = cut_window(chain, points, 1, 2);
  w.chain = without_joint(w.chain, 1);
  const FitChain back = paste_window(chain, w, 2);
  ASSERT_EQ(back.pieces.size(), 3U);
  ASSERT_EQ(back.joints.size(), 4U);
  EXPECT_EQ(back.pieces[0].length, 1);
  EXPECT_EQ(back.pieces[1].length, 5);
  EXPECT_EQ(back.pieces[2].length, 4);
  EXPECT_EQ(back.joints[2].position.x, 3);
  EXPECT_EQ(back.joints[3].position.x, 4);
  const std::vector<int> piece{0, 0, 1, 1, 1, 1, 2, 2};
  for (std::size_t j = 0; j < 8; ++j) EXPECT_EQ(back.feet[j].piece, piece[j]) << j;
  EXPECT_NEAR(back.feet[4].fraction, (2 + 0.75) / 5, 1e-14);
  EXPECT_TRUE(back.first_at_start);
  EXPECT_TRUE(back.last_at_end);
}

// The longest is halved, again and again, of equal ones the first: 4 is 2 and 2, then 3, then the
// first 2.
TEST(ChainEdit, PartedIsTheLongestHalved) {
  const auto lengths = [](std::size_t pieces) {
    std::vector<double> all;
    for (const FitPiece& piece : parted(four(), pieces).pieces) all.push_back(piece.length);
    return all;
  };
  EXPECT_EQ(lengths(3), (std::vector<double>{1, 2, 3, 4}));
  EXPECT_EQ(lengths(4), (std::vector<double>{1, 2, 3, 4}));
  EXPECT_EQ(lengths(5), (std::vector<double>{1, 2, 3, 2, 2}));
  EXPECT_EQ(lengths(7), (std::vector<double>{1, 1, 1, 1.5, 1.5, 2, 2}));
}

// A foot at the cut belongs to the first part, and is its end.
TEST(ChainEdit, FeetAtACutStayBeforeIt) {
  FitChain chain = four();
  chain.feet = {{1, 0.4}, {1, 0.4000001}, {2, 0}, {0, 1}};
  const FitChain more = with_joint(chain, 1, 0.4);
  EXPECT_EQ(more.feet[0].piece, 1);
  EXPECT_NEAR(more.feet[0].fraction, 1, 1e-15);
  EXPECT_EQ(more.feet[1].piece, 2);
  EXPECT_NEAR(more.feet[1].fraction, 0, 1e-6);
  EXPECT_EQ(more.feet[2].piece, 3);
  EXPECT_EQ(more.feet[3].piece, 0);
  EXPECT_EQ(more.pieces[1].alpha, -0.1);
  EXPECT_EQ(more.pieces[2].alpha, -0.1);
}

// Of a slope of 0 or more nothing passes an inflection: cut as a clothoid, whose curvature half way
// is the mean.
TEST(ChainEdit, InflectionsAreCutAsClothoids) {
  FitChain chain = four();
  chain.joints[1].curvature = -1;
  chain.joints[2].curvature = 3;
  chain.pieces[1].alpha = 0.5;
  EXPECT_NEAR(with_joint(chain, 1, 0.5).joints[2].curvature, 1, 1e-14);
  chain.joints[1].curvature = 0;
  EXPECT_NEAR(with_joint(chain, 1, 0.5).joints[2].curvature, 1.5, 1e-14);
  chain.pieces[1].alpha = 0;
  EXPECT_NEAR(with_joint(chain, 1, 0.5).joints[2].curvature, 1.5, 1e-14);
}

// What turns more than curvatures between its ends can is a clothoid whose ends both move, as far
// as the mean asks; less than a fiftieth of their range inside is no slope's.
TEST(ChainEdit, TurningsBeyondTheEndsMoveThem) {
  const auto merged = [](double turning) {
    FitChain chain = four();  // pieces 1 and 2: 5 long, from 2 to 4
    chain.joints[3].direction = chain.joints[1].direction + turning;
    return without_joint(chain, 2);
  };
  for (const double mean : {4.5, 1.0}) {
    const FitChain beyond = merged(5 * mean);
    EXPECT_EQ(beyond.pieces[1].alpha, -1);
    EXPECT_NEAR(beyond.joints[1].curvature, 2 + mean - 3, 1e-12);
    EXPECT_NEAR(beyond.joints[2].curvature, 4 + mean - 3, 1e-12);
  }
  for (const double mean : {3.97, 2.03}) EXPECT_NE(merged(5 * mean).joints[1].curvature, 2) << mean;
  for (const double mean : {3.95, 2.05}) EXPECT_EQ(merged(5 * mean).joints[1].curvature, 2) << mean;
  // A clothoid's mean is half way: less is a flatter slope, for its curvature stays low longer.
  EXPECT_NEAR(merged(5 * 3.0).pieces[1].alpha, -1, 0.02);
  EXPECT_GT(merged(5 * 2.8).pieces[1].alpha, -0.9);
  EXPECT_LT(merged(5 * 3.2).pieces[1].alpha, -1.1);
}

// Pasted back a chain is closed and held as it was.
TEST(ChainEdit, WindowsKeepTheWhole) {
  FitChain chain = four();
  chain.closed = true;
  chain.turning = 6;
  chain.hold_start = Hold::direction;
  chain.hold_end = Hold::position;
  chain.first_at_start = false;
  const std::vector<FitPoint> points(8);
  const Window w = cut_window(chain, points, 1, 2);
  EXPECT_EQ(w.chain.hold_start, Hold::curvature);
  const Window front = cut_window(chain, points, 0, 2), back = cut_window(chain, points, 2, 2);
  EXPECT_EQ(front.chain.hold_start, Hold::curvature);  // closed: its neighbour is the last piece
  EXPECT_EQ(back.chain.hold_end, Hold::curvature);
  EXPECT_FALSE(front.chain.first_at_start);
  const FitChain same = paste_window(chain, w, 2);
  EXPECT_TRUE(same.closed);
  EXPECT_EQ(same.turning, 6);
  EXPECT_EQ(same.hold_start, Hold::direction);
  EXPECT_EQ(same.hold_end, Hold::position);
  EXPECT_FALSE(same.first_at_start);
  EXPECT_TRUE(same.last_at_end);
  for (std::size_t j = 0; j < 8; ++j) {
    EXPECT_EQ(same.feet[j].piece, chain.feet[j].piece);
    EXPECT_EQ(same.feet[j].fraction, chain.feet[j].fraction);
  }
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_EQ(same.joints[i].curvature, chain.joints[i].curvature);
}

TEST(ChainEdit, StartsMoveOnRoundAndRound) {
  for (const int by : {0, 1, 4, 6}) {
    FitChain chain = four();
    chain.closed = true;
    chain.turning = 2 * std::numbers::pi;
    chain.joints.back() = chain.joints.front();
    chain.joints.back().direction += chain.turning;
    rotate_start(chain, by);
    EXPECT_EQ(chain.joints[0].position.x, by % 4);
    EXPECT_EQ(chain.pieces[0].length, 1.0 + by % 4);
    EXPECT_EQ(chain.feet[0].piece, (4 - by % 4) % 4) << by;
  }
}

// What turns more, or less, than any slope of the range can gets the range's end: 8 either way, and
// through an inflection -5 and -0.3.
TEST(ChainEdit, GuessedSlopesEndAtTheirRange) {
  const auto slope = [](double start, double end, double mean) {
    FitChain chain;
    chain.joints = {{{}, 0, start}, {{}, 0, 0}, {{}, mean, end}};
    chain.pieces.assign(2, {.length = 0.5});
    return without_joint(chain, 1).pieces[0].alpha;
  };
  EXPECT_EQ(slope(1, 3, 2.9), -8);
  EXPECT_EQ(slope(1, 3, 1.06), 8);
  EXPECT_EQ(slope(3, 1, 2.9), -8);
  EXPECT_EQ(slope(-0.5, 1.5, 1.4), -5);
  EXPECT_EQ(slope(-0.5, 1.5, -0.2), -0.3);
  EXPECT_EQ(slope(1.5, -0.5, 1.4), -5);
}

}  // namespace
}  // namespace keyline::fairing::detail
