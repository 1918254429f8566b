#include "keyline/lac/chain/extend.h"

#include <cmath>

#include <gtest/gtest.h>

#include "keyline/core/angle.h"

namespace keyline::lac {
namespace {

using core::ErrorCode;
using core::Point2;
using core::Pose2;

TEST(Extend, GivesBackWhatWasTrimmed) {
  for (const double alpha : {-3.0, -1.0, 0.0, 0.5, 1.0, 2.5}) {
    for (const double k1 : {0.9, 0.3, 0.05}) {
      const Segment whole{{{1, 2}, 0.4}, alpha, 3, 0.3, k1};
      const auto again = extend(part(whole, 0.2, 0.7), 0.6, 0.9);
      ASSERT_TRUE(again) << alpha << " " << k1 << again.error().message;
      EXPECT_NEAR(again->curvature_start, 0.3, 1e-13);
      EXPECT_NEAR(again->curvature_end, k1, 1e-13);
      EXPECT_LT(distance(again->start.position, whole.start.position), 1e-13);
      EXPECT_NEAR(again->start.direction, 0.4, 1e-13);
      const auto chain = extend(chain_of(part(whole, 0.2, 0.7)), 0.6, 0.9);
      ASSERT_TRUE(chain);
      EXPECT_LT(distance(end_pose(*chain).position, end_pose(whole).position), 1e-13);
    }
  }
}

TEST(Extend, StatesTheNaturalBound) {
  // Circle involute: rho^2 is linear in the arc length; rho falls from 2 to 1 over length 3.
  const Segment involute{{}, 2, 3, 0.5, 1};
  EXPECT_NEAR(natural_bounds(piece_of(involute)).after, 1, 1e-13);
  EXPECT_TRUE(std::isinf(natural_bounds(piece_of(involute)).before));
  EXPECT_TRUE(extend(involute, 5, 0.99));
  EXPECT_EQ(extend(involute, 0, 1.01).error().code, ErrorCode::undrawable);
  EXPECT_EQ(extend(involute, -1, 0).error().code, ErrorCode::bad_input);
  const auto through = extend(Segment{{}, -1, 1, 2, 1}, 0, 3);
  ASSERT_TRUE(through);
  EXPECT_NEAR(through->curvature_end, -2, 1e-14);
}

TEST(Mirrored, MirrorsInAnyLine) {
  const Segment s{{{1, 2}, 0.4}, -1, 3, 0.3, -0.9};
  const Pose2 line{{2, 1}, 0.8};
  const Segment image = mirrored(s, line);
  const Chain chain = mirrored(chain_of(s), line);
  for (const double t : {0.0, 0.4, 1.0}) {
    const Point2 p = to_local(line, evaluate(s, t));
    EXPECT_LT(distance(from_local(line, {p.x, -p.y}), evaluate(image, t)), 1e-13);
    EXPECT_LT(distance(evaluate(chain, t), evaluate(image, t)), 1e-13);
  }
}

}  // namespace
}  // namespace keyline::lac
