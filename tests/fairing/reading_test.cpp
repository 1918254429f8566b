#include "keyline/fairing/reading.h"

#include <cmath>

#include <gtest/gtest.h>

namespace keyline::fairing::detail {
namespace {

using analysis::Rhythm;

// A clothoid of many exact points is read as what it is made of, slope -1; points that are few, or
// a piece that bends both ways, have no reading beside the piece's own.
TEST(ReadPieces, ReadsWhatBendsOneWay) {
  const lac::Chain chain{
      {{3, 4}, 0.5}, {{-1, 2, 0, 0.5}, {-1, 3, 0.5, 2}, {-1, 1, 2, -1}, {-1, 2, -1, -1}}, false};
  const auto pieces = read_pieces(chain, 1e-6, {4, 200, 200, 200}, {});
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
  EXPECT_TRUE(read_pieces(chain, 1e-6, {20}, {}).front().told);
  const FairPiece unsure = read_pieces(chain, 1e-2, {20}, {}).front();
  EXPECT_EQ(unsure.interpretations.front().rhythm, Rhythm::arc);
  EXPECT_FALSE(unsure.told);
}

// A fiftieth of the whole is seen, what is shorter is not.
TEST(ReadPieces, TellsWhichAreLongEnoughToBeSeen) {
  const lac::Chain chain{{}, {{-1, 1, 0, 0}, {-1, 0.021, 0, 0}, {-1, 0.019, 0, 0}}, false};
  const auto pieces = read_pieces(chain, 0, {9, 9, 9}, {});
  ASSERT_EQ(pieces.size(), 3U);
  EXPECT_TRUE(pieces[1].seen);
  EXPECT_FALSE(pieces[2].seen);
  EXPECT_EQ(pieces[1].rhythm, Rhythm::straight);
}

}  // namespace
}  // namespace keyline::fairing::detail
