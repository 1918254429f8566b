#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/fairing/run.h"

/// Pieces that are told what to be: which they are, and what the others keep.
namespace keyline::fairing::detail {
namespace {

/// A chain solved from points of its own, three pieces whose radius falls.
struct Given {
  Run run;
  RunResult result;
  RunOptions options;
  std::vector<std::string> notes;
  explicit Given(const std::vector<lac::Piece>& pieces = {
                     {-0.7, 0.4, 0.5, 1}, {0.4, 0.3, 1, 3}, {-1.5, 0.3, 3, 5}}) {
    const lac::Chain truth{{{0, 0}, 0.2}, pieces, false};
    const auto segments = lac::segments(truth);
    for (std::size_t i = 0; i < segments.size(); ++i) {
      const lac::Segment& s = segments[i];
      result.fit.joints.push_back({s.start.position, s.start.direction, s.curvature_start});
      result.fit.pieces.push_back({.length = s.length, .alpha = s.alpha});
      for (int k = i == 0 ? 0 : 1; k <= 8; ++k) {
        run.points.push_back(lac::evaluate(s, k / 8.0));
        result.points.push_back({.position = run.points.back()});
        result.fit.feet.push_back({static_cast<int>(i), k / 8.0});
      }
    }
    const core::Pose2 end = lac::end_pose(truth);
    result.fit.joints.push_back({end.position, end.direction, segments.back().curvature_end});
    result.fit.first_at_start = result.fit.last_at_end = true;
    result.chain = truth;
    run.length = 1;
    options.tolerance = 0.02;
  }
  std::vector<int> ask(const std::vector<PieceWish>& wishes) {
    return apply_wishes(result, run, wishes, options, notes);
  }
};

PieceWish kind(int piece, PieceKind wanted) { return {.piece = piece, .kind = wanted}; }

TEST(Wishes, AnArcHasOneCurvatureAndTheOthersEndsStay) {
  Given g;
  g.result.fit.hold_start = g.result.fit.hold_end = Hold::curvature;
  EXPECT_EQ(g.ask({kind(0, PieceKind::arc)}), std::vector<int>{0});
  const auto& pieces = g.result.chain.pieces;
  ASSERT_EQ(pieces.size(), 3U);
  EXPECT_EQ(pieces[0].curvature_start, pieces[0].curvature_end);
  EXPECT_NEAR(pieces[0].curvature_start, 0.75, 1e-9);  // held at the mean of its ends
  EXPECT_NEAR(pieces[2].curvature_end, 5, 1e-9);
  EXPECT_EQ(g.result.fit.pieces[0].kind, PieceKind::arc);
  EXPECT_EQ(g.result.fit.pieces[1].kind, PieceKind::curve);
}

TEST(Wishes, AtTheOtherEndToo) {
  Given g;
  g.result.fit.hold_start = g.result.fit.hold_end = Hold::curvature;
  EXPECT_EQ(g.ask({kind(2, PieceKind::arc)}), std::vector<int>{2});
  const auto& pieces = g.result.chain.pieces;
  EXPECT_NEAR(pieces[0].curvature_start, 0.5, 1e-9);
  EXPECT_NEAR(pieces[2].curvature_end, 4, 1e-9);
  EXPECT_EQ(pieces[2].curvature_start, pieces[2].curvature_end);
}

TEST(Wishes, ALineIsStraight) {
  Given g({{-1, 0.3, 0.02, 0}, {-1, 0.4, 0, 3}, {-1, 0.3, 3, 5}});
  EXPECT_EQ(g.ask({kind(0, PieceKind::line)}), std::vector<int>{0});
  EXPECT_EQ(g.result.chain.pieces[0].curvature_start, 0);
  EXPECT_EQ(g.result.chain.pieces[0].curvature_end, 0);
  EXPECT_NE(g.result.chain.pieces[1].curvature_end, 0);
  EXPECT_TRUE(g.result.within_tolerance);
}

// A closed chain's first and last curvature are one, whichever side of the seam is asked.
TEST(Wishes, OfClosedChainsTheSeamIsOne) {
  for (const int piece : {0, 3}) {
    Given g;
    const double turn = 2 * core::kPi;
    g.run.points.clear();
    g.result = {};
    g.run.closed = g.result.fit.closed = true;
    g.result.fit.turning = turn;
    for (int i = 0; i <= 4; ++i) {
      const double t = turn * i / 4;
      const double bend = turn * (i % 4 == 0 ? 1.002 : 1);
      g.result.fit.joints.push_back({{std::cos(t) / turn, std::sin(t) / turn}, t + turn / 4, bend});
      if (i < 4) g.result.fit.pieces.push_back({.length = 0.25});
    }
    for (int k = 0; k < 40; ++k) {
      const double t = turn * k / 40;
      g.run.points.push_back({std::cos(t) / turn, std::sin(t) / turn});
      g.result.points.push_back({.position = g.run.points.back()});
      g.result.fit.feet.push_back({k / 10, (k % 10) / 10.0});
    }
    EXPECT_EQ(g.ask({kind(piece, PieceKind::arc)}), std::vector<int>{piece});
    EXPECT_TRUE(g.result.within_tolerance);
    const auto& fit = g.result.fit;
    EXPECT_NEAR(fit.joints.back().curvature, fit.joints.front().curvature, 1e-9);
    const auto& arc = g.result.chain.pieces[static_cast<std::size_t>(piece)];
    EXPECT_EQ(arc.curvature_start, arc.curvature_end);
    EXPECT_NEAR(arc.curvature_start, turn, 0.02);
  }
}

TEST(Wishes, SlopesAreHeldOrKeptToTheirRange) {
  Given g;
  EXPECT_EQ(g.ask({{.piece = 1, .kind = {}, .alpha_low = -0.2, .alpha_high = -0.2}}),
            std::vector<int>{1});
  EXPECT_EQ(g.result.chain.pieces[1].alpha, -0.2);
  Given range;
  EXPECT_EQ(range.ask({{.piece = 2, .kind = {}, .alpha_low = 0.3}}), std::vector<int>{2});
  EXPECT_GE(range.result.chain.pieces[2].alpha, 0.3);
  EXPECT_EQ(range.result.fit.pieces[2].alpha_high, kSteepestSlope);
  // An arc that is asked for a slope is a curve again.
  Given arc({{-1, 0.4, 2, 2}, {-1, 0.6, 2, 3}});
  arc.result.fit.pieces[0].kind = PieceKind::arc;
  EXPECT_EQ(arc.ask({{.piece = 0, .kind = {}, .alpha_low = 0.5, .alpha_high = 0.5}}),
            std::vector<int>{0});
  EXPECT_EQ(arc.result.fit.pieces[0].kind, PieceKind::curve);
}

// Two slopes in one piece: along growing radius plus comes first, or minus does. Radius falls along
// this chain, so that "plus first" stands in its second half.
TEST(Wishes, ACompoundIsTwoPiecesOfTwoSlopes) {
  for (const bool plus_first : {false, true}) {
    Given g;
    EXPECT_EQ(g.ask({{.piece = 1, .kind = {}, .compound = true, .plus_first = plus_first}}),
              (std::vector<int>{1, 2}));
    const auto& pieces = g.result.chain.pieces;
    ASSERT_EQ(pieces.size(), 4U);
    EXPECT_GT(pieces[plus_first ? 2 : 1].alpha, 0);
    EXPECT_LT(pieces[plus_first ? 1 : 2].alpha, 0);
    EXPECT_NEAR(pieces[1].length + pieces[2].length, 0.3, 0.15);
    // The other way round.
    Given back({{-1.5, 0.3, 5, 3}, {0.4, 0.3, 3, 1}, {-0.7, 0.4, 1, 0.5}});
    back.ask({{.piece = 1, .kind = {}, .compound = true, .plus_first = plus_first}});
    EXPECT_GT(back.result.chain.pieces[plus_first ? 1 : 2].alpha, 0);
    EXPECT_LT(back.result.chain.pieces[plus_first ? 2 : 1].alpha, 0);
  }
}

// Every compound before a piece moves it on by one.
TEST(Wishes, SeveralAtOnceAreCountedInTheNewChain) {
  Given g;
  const std::vector<int> asked =
      g.ask({{.piece = 2, .kind = {}, .compound = true, .plus_first = true},
             {.piece = 1, .kind = {}, .alpha_low = 0.5, .alpha_high = 0.5},
             {.piece = 0, .kind = {}, .compound = true}});
  EXPECT_EQ(asked, (std::vector<int>{0, 1, 2, 3, 4}));
  ASSERT_EQ(g.result.chain.pieces.size(), 5U);
  EXPECT_EQ(g.result.chain.pieces[2].alpha, 0.5);
}

// A run laid out backwards counts its pieces from the other end.
TEST(Wishes, OfReversedRunsPiecesAreThoseAsLaidOut) {
  for (const int piece : {0, 2}) {
    Given g;
    g.result.reversed = true;
    EXPECT_EQ(g.ask({{.piece = piece, .kind = {}, .alpha_low = -0.4, .alpha_high = -0.4}}),
              std::vector<int>{piece});
    EXPECT_EQ(g.result.chain.pieces[static_cast<std::size_t>(piece)].alpha, -0.4);
    EXPECT_EQ(g.result.fit.pieces[static_cast<std::size_t>(2 - piece)].alpha, -0.4);
  }
  Given two;
  two.result.reversed = true;
  const std::vector<int> asked =
      two.ask({{.piece = 0, .kind = {}, .compound = true},
               {.piece = 2, .kind = {}, .alpha_low = -0.4, .alpha_high = -0.4}});
  EXPECT_EQ(asked, (std::vector<int>{0, 1, 3}));
  EXPECT_EQ(two.result.chain.pieces[3].alpha, -0.4);
}

// At an inflection or a line no slope above -0.25 is to be had, and no compound.
TEST(Wishes, WhatAnInflectionForbidsIsToldAndLeft) {
  const std::vector<lac::Piece> inflected{{-1, 0.4, -2, 1}, {-0.5, 0.3, 1, 3}, {-1, 0.3, 3, 5}};
  const auto refused = [&](const std::vector<lac::Piece>& pieces, const PieceWish& wish) {
    Given g(pieces);
    const bool none = g.ask({wish}).empty();
    EXPECT_EQ(g.notes.size(), none ? 1U : 0U);
    if (none) {
      EXPECT_TRUE(g.notes[0].starts_with("piece " + std::to_string(wish.piece) + ":"));
    }
    return none;
  };
  const PieceWish flat{.piece = 0, .kind = {}, .alpha_low = -0.2, .alpha_high = -0.2};
  const PieceWish steep{.piece = 0, .kind = {}, .alpha_low = -0.3, .alpha_high = -0.3};
  const PieceWish two{.piece = 0, .kind = {}, .compound = true};
  EXPECT_TRUE(refused(inflected, flat));
  EXPECT_FALSE(refused(inflected, steep));
  EXPECT_TRUE(refused(inflected, two));
  EXPECT_FALSE(refused({{-1, 0.5, 1, 2}, {-1, 0.5, 2, 3}}, flat));
  // A thousandth of the other end's curvature is as good as none, from either side.
  EXPECT_TRUE(refused({{-1, 0.5, 9e-4, 1}, {-1, 0.5, 1, 2}}, flat));
  EXPECT_FALSE(refused({{-1, 0.5, 2e-3, 1}, {-1, 0.5, 1, 2}}, flat));
  EXPECT_TRUE(refused({{-1, 0.5, 1, 9e-4}, {-1, 0.5, 9e-4, 1}}, flat));
}

}  // namespace
}  // namespace keyline::fairing::detail
