#include "keyline/lac/segment/piece_curvature.h"

#include <cmath>
#include <utility>

#include <gtest/gtest.h>

namespace keyline::lac {
namespace {

double with_sign(double size, double sign) { return std::copysign(size, sign); }

// Through zero the signed power -alpha of curvature runs linearly: curvature itself for alpha = -1,
// its square for -2, its root for -1/2. Whichever end bends more.
TEST(PieceCurvature, ThroughZeroAPowerRunsLinearly) {
  for (const auto& [k0, k1] : {std::pair{-3.0, 1.0}, {0.5, -2.0}, {4.0, 0.0}, {0.0, -0.25}})
    for (const double v : {0.0, 0.1, 0.45, 0.8, 1.0}) {
      SCOPED_TRACE(testing::Message() << k0 << ' ' << k1 << ' ' << v);
      const double squares = std::lerp(k0 * std::abs(k0), k1 * std::abs(k1), v);
      const double roots = std::lerp(with_sign(std::sqrt(std::abs(k0)), k0),
                                     with_sign(std::sqrt(std::abs(k1)), k1), v);
      const double expected[] = {std::lerp(k0, k1, v),
                                 with_sign(std::sqrt(std::abs(squares)), squares),
                                 with_sign(roots * roots, roots)};
      const double alphas[] = {-1, -2, -0.5};
      for (int i = 0; i < 3; ++i) {
        const PieceCurvature piece(k0, k1, alphas[i]);
        EXPECT_NEAR(piece.curvature(v), expected[i], 2e-15 * 4) << alphas[i];
        EXPECT_NEAR(piece.at(v).curvature, expected[i], 2e-15 * 4) << alphas[i];
      }
    }
}

// Of one sign too; for alpha = 0 its logarithm, for 1 the radius.
TEST(PieceCurvature, OfOneSignAPowerRunsLinearly) {
  for (const auto& [k0, k1] : {std::pair{3.0, 1.0}, {-0.5, -2.0}})
    for (const double v : {0.0, 0.1, 0.45, 0.8, 1.0}) {
      const double sign = k0 < 0 ? -1 : 1;
      EXPECT_NEAR(PieceCurvature(k0, k1, -1).curvature(v), std::lerp(k0, k1, v), 2e-15);
      EXPECT_NEAR(PieceCurvature(k0, k1, 0).curvature(v),
                  sign * std::pow(std::abs(k0), 1 - v) * std::pow(std::abs(k1), v), 4e-15);
      EXPECT_NEAR(PieceCurvature(k0, k1, 1).curvature(v), 1 / std::lerp(1 / k0, 1 / k1, v), 4e-15);
    }
}

// For alpha = -1/2 the root r of curvature runs linearly, and the curvature r^2 changes with its
// start by |r| (1 - v) / root of the start, however small that is and of whichever sign.
TEST(PieceCurvature, ChangesWithAnEndThatIsNearlyZeroAsItsPowerDoes) {
  for (const double start : {1e-6, -1e-6, 1e-14, -1e-14, 1e-20, -1e-20})
    for (const double v : {0.1, 0.5, 0.9}) {
      const double root = std::lerp(with_sign(std::sqrt(std::abs(start)), start), 2.0, v);
      const double expected = std::abs(root) * (1 - v) / std::sqrt(std::abs(start));
      const PieceCurvature piece(start, 4, -0.5);
      EXPECT_NEAR(piece.at(v).by_start, expected, 1e-12 * expected) << start;
      const PieceCurvature back(4, start, -0.5);
      EXPECT_NEAR(back.at(1 - v).by_end, expected, 1e-12 * expected) << start;
    }
}

}  // namespace
}  // namespace keyline::lac
