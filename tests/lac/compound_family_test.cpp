#include "keyline/lac/space/compound_family.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "keyline/lac/hermite/compound_family.h"

/// Curves of two slopes, by their pieces: in the plane of space curves' data, and over handles.
namespace keyline::lac::detail {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(SpaceCompoundFamily, MembersAreG3AndOfTheirRate) {
  for (const space::PlaneRhythm& rhythm :
       {space::PlaneRhythm{-1, 0.5, 0.4}, {2, -0.5, 0.6}, {-2, -1, 0.5}}) {
    const space::Family family(rhythm, 0.3, -0.2);
    for (const double rate : {0.3, -0.3, 1e-3}) {
      const auto chain = family.chain({rate, 1.7});
      ASSERT_TRUE(chain);
      EXPECT_NEAR(arc_length(*chain), 1, 1e-15);
      EXPECT_EQ(chain->pieces[0].length, rhythm.length_share);
      EXPECT_EQ(chain->pieces[0].curvature_end, 1.7);
      EXPECT_EQ(chain->pieces[1].curvature_start, 1.7);
      const double before = curvature_rate(chain->pieces[0], 1);
      const double after = curvature_rate(chain->pieces[1], 0);
      EXPECT_NEAR(before / after, 1, 1e-9);
      EXPECT_EQ(after > 0, rate > 0);
      // Where the slope into which it grows is below 0 the rate is that itself.
      const double grows = rate > 0 ? rhythm.alpha1 : rhythm.alpha0;
      if (grows < 0) {
        EXPECT_NEAR(after / 1.7, rate, 1e-9);
      }
      // Above 0 it is the logarithm of what curvature grows to over the piece's share.
      const double share = rate > 0 ? 1 - rhythm.length_share : rhythm.length_share;
      const double end =
          rate > 0 ? chain->pieces[1].curvature_end : chain->pieces[0].curvature_start;
      if (grows > 0) {
        EXPECT_NEAR(std::log(end / 1.7), std::abs(rate) * share, 1e-12);
      }
    }
  }
}

TEST(SpaceCompoundFamily, BendsAndMissesAreTheChains) {
  const space::Family family({-1, -2, 0.4}, 0.4, -0.9);
  EXPECT_EQ(family.from(), 0.4);
  EXPECT_NEAR(family.turning(), -1.3, 1e-15);
  const auto bends = family.bends(5);
  const auto chain = family.chain({5, 1});
  ASSERT_TRUE(bends && chain);
  EXPECT_NEAR(bends->net, total_turning(*chain), 1e-14);
  EXPECT_TRUE(bends->inflects);
  EXPECT_GT(bends->both, std::abs(bends->net));
  EXPECT_FALSE(family.bends(0.5)->inflects);
  const auto off = family.off({0.5, -1.2});
  const auto drawn = family.chain({0.5, -1.2});
  ASSERT_TRUE(off);
  const core::Pose2 end = end_pose(*drawn);
  const double chord = std::atan2(end.position.y, end.position.x);
  EXPECT_NEAR(off->start, -chord - 0.4, 1e-14);
  EXPECT_NEAR(off->end, end.direction - chord - 0.4 + 1.3, 1e-14);
  EXPECT_EQ((space::Off{-2, 1}.largest()), 2);
}

// Somewhere the tangent is along the chord: it turns there and back.
TEST(SpaceCompoundFamily, LeastTurningIsThereAndBack) {
  EXPECT_NEAR(space::Family({}, 0.3, -0.5).least_turning(), 0.8, 1e-15);
  EXPECT_NEAR(space::Family({}, 0.3, 0.5).least_turning(), 0.8, 1e-15);
  EXPECT_NEAR(space::Family({}, 3, -3).least_turning(), 6, 1e-15);
  EXPECT_NEAR(space::Family({}, 3, 3).least_turning(), 2 * (kPi - 3), 1e-14);
}

TEST(SpaceCompoundFamily, RatesGoFromTheLeastToTheGreatest) {
  const auto rates = space::Family({-1, 1, 0.5}, 0, 0).rates();
  EXPECT_TRUE(std::ranges::is_sorted(rates));
  EXPECT_EQ(std::ranges::count(rates, 0.0), 1);
  EXPECT_NEAR(rates.front(), -1e8, 1e8 * 0.14);  // slope below 0
  EXPECT_LE(rates.back(), 700 / 0.5);
  EXPECT_GT(rates.back(), 700 / 0.5 / 1.16);
}

// ---- Over handles ----------------------------------------------------------------------------

// The two pieces meet with one radius and one rate of it, and turn by their shares.
TEST(CompoundFamily, PiecesMeetInCurvatureAndRate) {
  for (const CompoundRhythm& rhythm :
       {CompoundRhythm{-1, 0.5, 0.4}, {2, -0.5, 0.6}, {0.5, 0.2, 0.5}, {0, 3, 0.3}}) {
    const CompoundFamily family(rhythm, 1.4);
    for (const double q : {0.2, 1.0}) {
      const CompoundPieces pieces = family.pieces(q);
      ASSERT_EQ(pieces.sharp.size(), 1U);
      ASSERT_EQ(pieces.flat.size(), 1U);
      EXPECT_FALSE(pieces.clamped);
      const Piece& a = pieces.sharp[0];
      const Piece& b = pieces.flat[0];
      EXPECT_EQ(a.alpha, rhythm.alpha0);
      EXPECT_EQ(b.alpha, rhythm.alpha1);
      EXPECT_NEAR(total_turning(a), 1.4 * rhythm.turning_share, 1e-12);
      EXPECT_NEAR(total_turning(b), 1.4 * (1 - rhythm.turning_share), 1e-12);
      EXPECT_EQ(a.curvature_end, b.curvature_start);
      EXPECT_LT(a.curvature_end, a.curvature_start);
      EXPECT_NEAR(curvature_rate(a, 1) / curvature_rate(b, 0), 1, 1e-9);
      const Chain chain{{}, {a, b}, false};
      const core::Vector2 chord = end_pose(chain).position - core::Point2{};
      EXPECT_NEAR(core::norm(chord), 1, 1e-12);
      const ChordSample sample = family.sample(q, chord);
      EXPECT_NEAR(sample.miss, 0, 1e-12);
      EXPECT_NEAR(sample.length, 1 / arc_length(chain), 1e-12);
      const double h = 1e-5;
      const double slope =
          (family.sample(q + h, chord).miss - family.sample(q - h, chord).miss) / (2 * h);
      EXPECT_NEAR(sample.slope, slope, 1e-7);
    }
  }
}

TEST(CompoundFamily, LimitsAreThoseOfWhatRunsOut) {
  EXPECT_TRUE(CompoundFamily({2, 0.5, 0.5}, 1).limit_drawn());   // a cusp at the sharp end
  EXPECT_TRUE(CompoundFamily({0.5, -1, 0.5}, 1).limit_drawn());  // an inflection at the flat one
  EXPECT_FALSE(CompoundFamily({0.5, 0.5, 0.5}, 1).limit_drawn());
  EXPECT_EQ(CompoundFamily({0.5, 0.7, 0.5}, 1).limit_chord_angle(), 1);
}

}  // namespace
}  // namespace keyline::lac::detail
