#include "keyline/operations/joints_inside.h"

#include <gtest/gtest.h>

#include "keyline/core/angle.h"

namespace keyline::operations {
namespace {

using curve::Bezier2;
using document::Path;

// (t^2, t^3) from t = -1 to 1, whose cusp is at its middle, where it turns back.
TEST(JointsInside, AreAlsoCuspsOfACurve) {
  const Path path{{{Bezier2{{{1, -1}, {-1. / 3, 1}, {-1. / 3, -1}, {1, 1}}, {}}}}, false};
  const auto joints = joints_inside(path);
  ASSERT_EQ(joints.size(), 1u);
  EXPECT_NEAR(joints[0].t, 0.5, 1e-12);
  EXPECT_NEAR(joints[0].joint.position.x, 0, 1e-12);
  EXPECT_NEAR(std::abs(joints[0].joint.angle), core::kPi, 1e-6);
  EXPECT_EQ(joints[0].joint.order, 0);
}

// Of curvature^2 linear in arc length the rate is infinite where it is 0, of a clothoid 1.
TEST(JointsInside, KnowRatesThatAreInfinite) {
  const auto path_of = [](double alpha) {
    return Path{{{lac::Chain{{{0, 0}, 0}, {{alpha, 1, -1, 0}, {alpha, 1, 0, 1}}, false}}}, false};
  };
  const auto steep = joints_inside(path_of(-2));
  ASSERT_EQ(steep.size(), 1u);
  EXPECT_EQ(steep[0].joint.order, 2);
  EXPECT_FALSE(steep[0].joint.curvature_rate_jump);
  EXPECT_EQ(joints_inside(path_of(-1)).at(0).joint.order, 3);
}

TEST(JointsInside, MembersOfNoLengthAreNone) {
  const Path path{{{curve::Polyline2{{{0, 0}, {1, 0}}}},
                   {Bezier2{{{1, 0}, {1, 0}, {1, 0}}, {}}},
                   {curve::Polyline2{{{1, 0}, {1, 2}}}}},
                  false};
  const auto joints = joints_inside(path);
  ASSERT_EQ(joints.size(), 1u);
  EXPECT_NEAR(joints[0].joint.angle, core::kPi / 2, 1e-12);
}

}  // namespace
}  // namespace keyline::operations
