#include "keyline/fairing/sideways.h"

#include <vector>

#include <gtest/gtest.h>

/// How far curves of a few cells come to lie elsewhere, in closed form.
namespace keyline::fairing::detail {
namespace {

// A bend of curvature k over a length w rises by k w^2 / 8 over its chord.
TEST(Sideways, IsHalfTheHeightOfABend) {
  const std::vector<CellMean> two{{3, 0.2}, {3, 0.2}};
  EXPECT_NEAR(sideways(two, 0), 3 * 0.4 * 0.4 / 8 / 2, 1e-15);
  EXPECT_NEAR(sideways(two, 1), 2 * 0.4 * 0.4 / 8 / 2, 1e-15);
  EXPECT_NEAR(sideways(two, 3), 0, 1e-15);
}

// One bend to the left and one like it to the right: each as high on its own side of the chord.
TEST(Sideways, CountsBothSides) {
  const std::vector<CellMean> s{{4, 0.1}, {4, 0.1}, {-4, 0.1}, {-4, 0.1}};
  // Heights at the joints from the chord: y'' = 4 twice, then -4: 0, -0.02, 0, 0.02, 0.
  EXPECT_NEAR(sideways(s, 0), 0.02, 1e-15);
}

TEST(MeansOf, AreOfCellsOnAnyLap) {
  DenseCurve curve;
  curve.at = {0, 0.2, 0.5, 1};
  curve.joints = {{{}, 0, 1}, {{}, 0, 3}, {{}, 0, -1}, {{}, 0, 1}};
  const auto means = means_of(curve, -1, 4);
  ASSERT_EQ(means.size(), 5U);
  const std::vector<double> curvature{0, 2, 1, 0, 2}, width{0.5, 0.2, 0.3, 0.5, 0.2};
  for (std::size_t i = 0; i < means.size(); ++i) {
    EXPECT_NEAR(means[i].curvature, curvature[i], 1e-15) << i;
    EXPECT_NEAR(means[i].width, width[i], 1e-15) << i;
  }
}

}  // namespace
}  // namespace keyline::fairing::detail
