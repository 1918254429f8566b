#include "keyline/fairing/reading.h"

#include <cmath>

#include <gtest/gtest.h>

namespace keyline::fairing::detail {
namespace {

using analysis::Rhythm;

std::vector<FairPiece> read_all(const lac::Chain& chain, double noise,
                                const std::vector<int>& points,
                                const std::vector<int>& asked = {}) {
  std::vector<FairPiece> pieces = pieces_of(chain, noise, points, asked);
  read_pieces(pieces, chain);
  return pieces;
}

// A clothoid of many exact points is read as what it is made of, slope -1; points that are few, or
// a piece that bends both ways, have no reading beside the piece's own.
TEST(ReadPieces, ReadsWhatBendsOneWay) {
  const lac::Chain chain{
      {{3, 4}, 0.5}, {{-1, 2, 0, 0.5}, {-1, 3, 0.5, 2}, {-1, 1, 2, -1}, {-1, 2, -1, -1}}, false};
  const auto pieces = read_all(chain, 1e-6, {4, 200, 200, 200});
  ASSERT_EQ(pieces.size(), 4U);
  EXPECT_TRUE(pieces[0].interpretations.empty());
  EXPECT_FALSE(pieces[0].told);
  ASSERT_FALSE(pieces[1].interpretations.empty());
  EXPECT_EQ(pieces[1].interpretations.front().rhythm, Rhythm::minus);
  ASSERT_EQ(pieces[1].interpretations.front().slopes.size(), 1U);
  EXPECT_NEAR(pieces[1].interpretations.front().slopes.front(), -1, 0.01);
  EXPECT_TRUE(pieces[1].told);
  EXPECT_TRUE(pieces[2].interpretations.empty());
  EXPECT_EQ(pieces[2].rhythm, Rhythm::minus);
  EXPECT_EQ(pieces[3].rhythm, Rhythm::arc);
  EXPECT_TRUE(pieces[3].slopes.empty());
  EXPECT_EQ(pieces[3].start, 6);
  EXPECT_EQ(pieces[3].length, 2);
  for (const FairPiece& piece : pieces) EXPECT_TRUE(piece.seen);
}

// A clothoid from 0.5 to 0.7 leaves its arc by less than 0.002: errors of 0.01 do not tell which it
// is, and the arc is the simpler.
TEST(ReadPieces, WhatAnArcWouldDoForIsNotTold) {
  const lac::Chain chain{{}, {{-1, 1, 0.5, 0.7}}, false};
  EXPECT_TRUE(read_all(chain, 1e-6, {20}).front().told);
  const FairPiece unsure = read_all(chain, 1e-2, {20}).front();
  EXPECT_EQ(unsure.interpretations.front().rhythm, Rhythm::arc);
  EXPECT_FALSE(unsure.told);
}

// A fiftieth of the whole is seen, what is shorter is not.
TEST(ReadPieces, TellsWhichAreLongEnoughToBeSeen) {
  const lac::Chain chain{{}, {{-1, 1, 0, 0}, {-1, 0.021, 0, 0}, {-1, 0.019, 0, 0}}, false};
  const auto pieces = read_all(chain, 0, {9, 9, 9});
  ASSERT_EQ(pieces.size(), 3U);
  EXPECT_TRUE(pieces[1].seen);
  EXPECT_FALSE(pieces[2].seen);
  EXPECT_EQ(pieces[1].rhythm, Rhythm::straight);
}

TEST(RhythmOf, IsByThePiecesNumbers) {
  EXPECT_EQ(rhythm_of({-1, 1, 0, 0}), Rhythm::straight);
  EXPECT_EQ(rhythm_of({-1, 1, 2, 2}), Rhythm::arc);
  EXPECT_EQ(rhythm_of({-1, 1, 0, 2}), Rhythm::minus);
  EXPECT_EQ(rhythm_of({-1, 1, 2, 0}), Rhythm::minus);
  EXPECT_EQ(rhythm_of({0, 1, 1, 2}), Rhythm::zero);
  EXPECT_EQ(rhythm_of({2, 1, 1, 2}), Rhythm::plus);
  const double band = analysis::RhythmOptions{}.zero_band;
  EXPECT_EQ(rhythm_of({band, 1, 1, 2}), Rhythm::zero);
  EXPECT_EQ(rhythm_of({-band, 1, 1, 2}), Rhythm::zero);
  EXPECT_EQ(rhythm_of({1.01 * band, 1, 1, 2}), Rhythm::plus);
  EXPECT_EQ(rhythm_of({-1.01 * band, 1, 1, 2}), Rhythm::minus);
}

InterpretationOverride asked_for(Rhythm rhythm) {
  InterpretationOverride asked;
  asked.rhythm = rhythm;
  return asked;
}

TEST(WishFor, RhythmsAreKindsOrRangesOfSlopes) {
  const double band = analysis::RhythmOptions{}.zero_band;
  const auto wish = [](Rhythm rhythm) { return wish_for(asked_for(rhythm), 3).value(); };
  EXPECT_EQ(wish(Rhythm::straight).kind, PieceKind::line);
  EXPECT_EQ(wish(Rhythm::arc).kind, PieceKind::arc);
  EXPECT_EQ(wish(Rhythm::arc).piece, 3);
  EXPECT_FALSE(wish(Rhythm::minus).kind);
  EXPECT_EQ(wish(Rhythm::minus).alpha_low, -kSteepestSlope);
  EXPECT_EQ(wish(Rhythm::minus).alpha_high, -band);
  EXPECT_EQ(wish(Rhythm::plus).alpha_low, band);
  EXPECT_EQ(wish(Rhythm::plus).alpha_high, kSteepestSlope);
  EXPECT_EQ(wish(Rhythm::zero).alpha_low, 0);
  EXPECT_EQ(wish(Rhythm::zero).alpha_high, 0);
  EXPECT_FALSE(wish(Rhythm::zero).compound);
  EXPECT_TRUE(wish(Rhythm::plus_minus).compound);
  EXPECT_TRUE(wish(Rhythm::plus_minus).plus_first);
  EXPECT_TRUE(wish(Rhythm::minus_plus).compound);
  EXPECT_FALSE(wish(Rhythm::minus_plus).plus_first);
  EXPECT_EQ(wish_for(asked_for(Rhythm::arcs), 0).error().code, core::ErrorCode::unsupported);
}

TEST(WishFor, SlopesGoFromMinusTwelveToTwelve) {
  InterpretationOverride asked;
  for (const double slope : {-12.0, 0.7, 12.0}) {
    asked.slope = slope;
    const PieceWish wish = wish_for(asked, 2).value();
    EXPECT_EQ(wish.piece, 2);
    EXPECT_EQ(wish.alpha_low, slope);
    EXPECT_EQ(wish.alpha_high, slope);
  }
  for (const double slope : {-12.1, 12.1, HUGE_VAL, std::nan("")}) {
    asked.slope = slope;
    EXPECT_EQ(wish_for(asked, 2).error().code, core::ErrorCode::bad_input) << slope;
  }
}

// Of five points on a clothoid its slope is told, of four it is not; an arc is told by any.
TEST(ReadPieces, FivePointsTellASlope) {
  const lac::Chain clothoid{{}, {{-1, 1, 0.5, 3}}, false};
  EXPECT_TRUE(read_all(clothoid, 1e-9, {5}).front().told);
  EXPECT_FALSE(read_all(clothoid, 1e-9, {4}).front().told);
  EXPECT_TRUE(read_all({{}, {{-1, 1, 2, 2}}, false}, 1e-9, {0}).front().told);
}

// What was asked for stays as the piece is, however the points would read.
TEST(ReadPieces, WhatWasAskedForIsNotReadOtherwise) {
  const lac::Chain chain{{}, {{-1, 1, 0.5, 0.7}, {-1, 1, 0.7, 0.9}}, false};
  const auto pieces = read_all(chain, 1e-2, {20, 20}, {1});
  EXPECT_FALSE(pieces[0].overridden);
  EXPECT_EQ(pieces[0].rhythm, Rhythm::minus);
  EXPECT_FALSE(pieces[0].told);
  EXPECT_TRUE(pieces[1].overridden);
  EXPECT_TRUE(pieces[1].told);
  EXPECT_EQ(pieces[1].slopes, std::vector<double>{-1});
}

}  // namespace
}  // namespace keyline::fairing::detail
