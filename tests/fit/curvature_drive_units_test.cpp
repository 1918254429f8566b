#include <cmath>

#include <gtest/gtest.h>

#include "keyline/fit/curvature_drive.h"
#include "keyline/fit/curvature_target.h"
#include "keyline/numeric/random.h"

namespace keyline::fit {
namespace {

using core::Point2;
using curve::PiecewiseBezier;

/// Edges that turn left by equal angles, of uneven lengths.
PiecewiseBezier uneven_chain(numeric::Random& random) {
  PiecewiseBezier chain;
  Point2 p{1, 2};
  for (int i = 0; i < 4; ++i) {
    curve::Bezier2 piece{{p}, {}};
    for (int n = 0; n < 5; ++n) {
      const double angle = 0.3 + 0.12 * (4 * i + n);
      const double length = random.uniform(0.8, 1.3);
      p = {p.x + length * std::cos(angle), p.y + length * std::sin(angle)};
      piece.control.push_back(p);
    }
    chain.pieces.push_back(piece);
  }
  return chain;
}

// The search went by the logarithms of lengths, whose steps are small beside another unit's.
TEST(CurvatureDrive, IsTheSameInEveryUnit) {
  for (const bool held : {false, true})
    for (const double farthest : {0.0, 0.02}) {
      numeric::Random random(11);
      const PiecewiseBezier start = uneven_chain(random);
      auto targets = smooth_target(start, false, 0);
      PiecewiseBezier large = start;
      for (auto& piece : large.pieces)
        for (Point2& p : piece.control) p = {1024 * p.x, 1024 * p.y};
      const auto once =
          drive_curvature(start, targets, {.hold_end = held, .max_deviation = farthest});
      for (CurvatureTarget& t : targets) t.curvature /= 1024;
      const auto again =
          drive_curvature(large, targets, {.hold_end = held, .max_deviation = 1024 * farthest});
      ASSERT_TRUE(once && again);
      EXPECT_EQ(once->iterations, again->iterations);
      for (std::size_t i = 0; i < large.pieces.size(); ++i)
        for (std::size_t k = 0; k < 6; ++k) {
          const Point2 p = once->chain.pieces[i].control[k];
          EXPECT_EQ(again->chain.pieces[i].control[k], (Point2{1024 * p.x, 1024 * p.y}));
        }
    }
}

}  // namespace
}  // namespace keyline::fit
