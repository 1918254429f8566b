#include "keyline/lac/chain/drag.h"

#include <cmath>

#include <gtest/gtest.h>

#include "keyline/core/angle.h"

namespace keyline::lac {
namespace {

using core::ErrorCode;
using core::Point2;

TEST(Drag, MovesOnePointAndHoldsTheEnds) {
  for (const double alpha : {-1.0, -2.0, 0.5, 1.0}) {
    for (const bool hold : {false, true}) {
      const Chain chain{{{1, 1}, 0.2},
                        {{alpha, 1, 0.3, 0.5}, {alpha, 1.5, 0.5, 0.2}, {alpha, 1, 0.2, 0.4}},
                        false};
      const Point2 target = evaluate(chain, 0.45) + core::Vector2{0.02, -0.03};
      const auto dragged = drag(chain, 0.45, target, {hold});
      ASSERT_TRUE(dragged) << alpha << dragged.error().message;
      const Chain& c = dragged->chain;
      EXPECT_EQ(c.pieces.size(), 4u);
      EXPECT_LT(distance(joints(c)[dragged->joint].position, target), 1e-12);
      EXPECT_LT(distance(end_pose(c).position, end_pose(chain).position), 1e-12);
      EXPECT_NEAR(end_pose(c).direction, end_pose(chain).direction, 1e-12);
      EXPECT_LT(largest_joint_gap(c).curvature, 1e-14);
      if (hold) {
        EXPECT_NEAR(c.pieces.back().curvature_end, 0.4, 1e-13);
      }
      for (const Piece& p : c.pieces) EXPECT_EQ(p.alpha, alpha);
    }
  }
}

TEST(Drag, NoWayIsNoChangeAndEndsCanBeDragged) {
  const Chain chain{{{1, 1}, 0.2}, {{-1, 1, 0.3, 0.5}, {-1, 1.5, 0.5, -0.2}}, false};
  const auto same = drag(chain, 0.4, evaluate(chain, 0.4));
  ASSERT_TRUE(same) << same.error().message;
  EXPECT_LT(same->change, 1e-12);
  const auto end = drag(chain, 1, end_pose(chain).position + core::Vector2{0.1, 0});
  ASSERT_TRUE(end);
  EXPECT_NEAR(end_pose(end->chain).position.x, end_pose(chain).position.x + 0.1, 1e-12);
  const auto start = drag(chain, 0, {0.9, 1.05});
  ASSERT_TRUE(start);
  EXPECT_LT(distance(start->chain.start.position, {0.9, 1.05}), 1e-12);
  EXPECT_NEAR(core::wrap_angle(start->chain.start.direction - 0.2), 0, 1e-12);
  EXPECT_LT(distance(end_pose(start->chain).position, end_pose(chain).position), 1e-12);
  EXPECT_EQ(drag(chain, 2, {0, 0}).error().code, ErrorCode::bad_input);
  EXPECT_EQ(drag(chain, 0.5, {900, 0}).error().code, ErrorCode::not_converged);
}

}  // namespace
}  // namespace keyline::lac
