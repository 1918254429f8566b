#include "keyline/lac/space/compound_plane.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "keyline/lac/space/compound_family.h"

namespace keyline::lac::detail::space {
namespace {

/// To either side together, by the middles of many parts.
double turned(const Chain& c) {
  constexpr int kParts = 400;
  double sum = 0;
  for (const Piece& p : c.pieces)
    for (int i = 0; i < kParts; ++i)
      sum += std::abs(curvature(p, (i + 0.5) / kParts)) * p.length / kParts;
  return sum;
}

// Seen from its other end a curve leaves the chord as it reached it, its pieces exchanged. Of
// several curves each side takes the one that turns least, so that both take the same.
TEST(CompoundPlane, ReversedDataGiveTheSameCurve) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  int found = 0;
  for (int n = 0; n < 400; ++n) {
    const double from = 2.6 * (2 * unit(random) - 1), to = 2.6 * (2 * unit(random) - 1);
    const PlaneRhythm rhythm{3 * unit(random) - 2, 3 * unit(random) - 2, 0.15 + 0.7 * unit(random)};
    SCOPED_TRACE(testing::Message() << n << ": " << from << ' ' << to << ' ' << rhythm.alpha0 << ' '
                                    << rhythm.alpha1 << ' ' << rhythm.length_share);
    const auto there = solve_compound_plane(from, to, rhythm);
    const auto back =
        solve_compound_plane(to, from, {rhythm.alpha1, rhythm.alpha0, 1 - rhythm.length_share});
    ASSERT_EQ(there.found.has_value(), back.found.has_value());
    if (!there.found) continue;
    ++found;
    EXPECT_NEAR(turned(*there.found), turned(*back.found), 1e-6 * turned(*there.found));
  }
  EXPECT_GT(found, 200);
}

TEST(CompoundPlane, AlongTheChordItIsTheChord) {
  const auto line = solve_compound_plane(0, 0, {-1, 0.5, 0.4});
  ASSERT_TRUE(line.found);
  ASSERT_EQ(line.found->pieces.size(), 2U);
  EXPECT_NEAR(line.found->pieces[0].length, 0.4, 1e-15);
  EXPECT_NEAR(line.found->pieces[1].length, 0.6, 1e-15);
  for (const Piece& p : line.found->pieces) {
    EXPECT_EQ(p.curvature_start, 0);
    EXPECT_EQ(p.curvature_end, 0);
  }
}

}  // namespace
}  // namespace keyline::lac::detail::space
