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

PiecewiseBezier backwards(const PiecewiseBezier& chain) {
  PiecewiseBezier back;
  for (auto piece = chain.pieces.rbegin(); piece != chain.pieces.rend(); ++piece)
    back.pieces.push_back({{piece->control.rbegin(), piece->control.rend()}, {}});
  return back;
}

/// A wave of quintics on a circle of radius 3, with inflections.
PiecewiseBezier waves(numeric::Random& random) {
  PiecewiseBezier chain = uneven_chain(random);
  for (auto& piece : chain.pieces)
    for (Point2& p : piece.control) p.y += 0.8 * std::sin(1.7 * p.x);
  for (std::size_t i = 1; i < chain.pieces.size(); ++i) {  // equal directions at joints
    const Point2 before = chain.pieces[i - 1].control[4];
    const Point2 joint = chain.pieces[i].control[0];
    chain.pieces[i].control[1] = {2 * joint.x - before.x, 2 * joint.y - before.y};
  }
  return chain;
}

// Targets lay beside the middle of the samples they stand for, and of two samples beside an
// inflection the second counted: other targets from the other end.
TEST(CurvatureTargets, AreTheSameFromTheOtherEnd) {
  numeric::Random random(5);
  for (int n = 0; n < 20; ++n) {
    const PiecewiseBezier chain = waves(random);
    for (const bool rhythm : {false, true}) {
      const auto of = [&](const PiecewiseBezier& given) {
        return rhythm ? rhythm_target(given, false).places : smooth_target(given, false);
      };
      const auto there = of(chain), back = of(backwards(chain));
      ASSERT_EQ(there.size(), back.size());
      for (std::size_t i = 0; i < there.size(); ++i) {
        EXPECT_NEAR(back[back.size() - 1 - i].t, 1 - there[i].t, 1e-12);
        EXPECT_NEAR(-back[back.size() - 1 - i].curvature, there[i].curvature, 1e-9);
      }
    }
  }
}

// Of two lengths at a joint the second was given up, whichever way the curve was travelled.
TEST(CurvatureDrive, IsTheSameFromTheOtherEnd) {
  numeric::Random random(6);
  for (int n = 0; n < 10; ++n) {
    const PiecewiseBezier start = uneven_chain(random);
    for (const double farthest : {0.0, 0.02}) {
      const CurvatureDriveOptions options{.hold_end = true, .max_deviation = farthest};
      const auto there = drive_curvature(start, smooth_target(start, false), options);
      const PiecewiseBezier turned = backwards(start);
      const auto back = drive_curvature(turned, smooth_target(turned, false), options);
      ASSERT_TRUE(there && back);
      const PiecewiseBezier again = backwards(back->chain);
      for (std::size_t i = 0; i < again.pieces.size(); ++i)
        for (std::size_t k = 0; k < 6; ++k)
          EXPECT_LT(core::distance(again.pieces[i].control[k], there->chain.pieces[i].control[k]),
                    1e-7);
      EXPECT_NEAR(back->target.front().t, 1 - there->target.back().t, 1e-12);
      EXPECT_NEAR(back->target.front().curvature, -there->target.back().curvature, 1e-9);
    }
  }
}

}  // namespace
}  // namespace keyline::fit
