#include "keyline/lac/space/compound_steer.h"

#include <cmath>

#include <gtest/gtest.h>

#include "keyline/lac/segment/piece_shape.h"

/// Newton's method on quick shots of compound curves, against exact ends.
namespace keyline::lac::detail::space {
namespace {

constexpr SpaceRhythm kRhythms[] = {{{-1, 0.5}, {-1, 1}, 0.3, 0.4},
                                    {{2, -2}, {0.5, -1.5}, -0.2, 0.7},
                                    {{0, 1}, {0, 2}, 0.4, 0.5},
                                    {{-0.5, -1}, {2, -0.5}, 0, 0.3}};

/// Of the rhythm's omega.
Joint with_omega(const JointFamily& family, Joint x) {
  for (int i = 0; i < 60; ++i) x.flow -= *family.omega_miss(x);
  return x;
}

TEST(JointFamily, KeepsTheRhythmAndItsRates) {
  for (const SpaceRhythm& r : kRhythms) {
    const JointFamily family(r);
    const auto chain = family.chain(with_omega(family, {0.4, 0.1, -0.5, -1, true}));
    ASSERT_TRUE(chain);
    EXPECT_NEAR(arc_length(*chain), 1, 1e-15);
    const SpacePiece &a = chain->pieces[0], &b = chain->pieces[1];
    EXPECT_NEAR(curvature_rate(curvature_law(a), 1), curvature_rate(curvature_law(b), 0), 1e-12);
    EXPECT_NEAR(curvature_rate(torsion_law(a), 1), curvature_rate(torsion_law(b), 0), 1e-12);
    // torsion' = -omega torsion^(beta + 1), both in units of the radius at the start
    const double unit = a.curvature_start, torsion = a.torsion_start / unit;
    EXPECT_NEAR(curvature_rate(torsion_law(a), 0) / (unit * unit),
                -r.omega * std::pow(torsion, r.beta[0] + 1), 1e-12);
  }
}

TEST(JointFamily, SteersToAnEndAsQuicklyAsNewton) {
  for (const SpaceRhythm& r : kRhythms) {
    SCOPED_TRACE(r.beta[0]);
    const JointFamily family(r);
    const Joint meant = with_omega(family, {0.4, 0.1, -0.5, -1, true});
    const SpaceFrame end = frame_at(*family.chain(meant), 1);
    const auto setting =
        setting_of({{}, end.position, {1, 0, 0}, end.tangent}, r.alpha[0], r.beta[0], r.omega);
    ASSERT_TRUE(setting);
    ASSERT_FALSE(setting->mirrored);
    Joint x{meant.bend + 0.05, meant.size - 0.05, meant.twist + 0.1, meant.flow, true};
    int iterations = 0;
    ASSERT_TRUE(family.steer(setting->wanted, 1e-6, x, iterations));
    EXPECT_LE(iterations, 4);
    const auto exact = family.polished(setting->wanted, x, iterations);
    ASSERT_TRUE(exact);
    EXPECT_NEAR(exact->bend, meant.bend, 1e-9);
    EXPECT_NEAR(exact->size, meant.size, 1e-9);
    EXPECT_NEAR(exact->twist, meant.twist, 1e-9);
    if (r.omega != 0) {
      EXPECT_NEAR(exact->flow, meant.flow, 1e-9);
    }
    EXPECT_LE(iterations, 8);
  }
}

TEST(JointFamily, TakesACurveOfOneSlopeAsItsOwn) {
  const SpacePiece piece{0.5, -1, 2, 0.3, 0.7, -0.2, 0.4};
  const JointFamily family({{0.5, 0.5}, {-1, -1}, -0.3, 0.25});
  const auto x = family.joint_of(piece);
  ASSERT_TRUE(x);
  const auto chain = family.chain(*x);
  ASSERT_TRUE(chain);
  EXPECT_NEAR(chain->pieces[0].curvature_start, 0.6, 1e-12);  // of length 1
  EXPECT_NEAR(chain->pieces[1].curvature_end, 1.4, 1e-12);
  EXPECT_NEAR(chain->pieces[0].torsion_start, -0.4, 1e-12);
  EXPECT_NEAR(chain->pieces[1].torsion_end, 0.8, 1e-12);
  EXPECT_FALSE(family.joint_of({-1, -1, 1, 0.25, -0.75, 0.2, 0.4}));  // the inflection at the joint
}

TEST(JointFamily, TurnsToEitherSide) {
  // Curvature runs from 1 to -1: half a turn back and forth, together 1/2; torsion 2 all along.
  EXPECT_NEAR(turning_of({{}, {{-1, -1, 1, 1, -1, 0.2, 0.2}}}), 0.5, 1e-12);
  EXPECT_NEAR(turning_of({{}, {{-1, -1, 1, 1, -1, 2, 2}, {-1, -1, 1, -1, 0, 2, 2}}}), 4, 1e-12);
}

}  // namespace
}  // namespace keyline::lac::detail::space
