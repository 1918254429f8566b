#include "keyline/curve/arriving.h"

#include <cmath>

#include <gtest/gtest.h>

#include "keyline/core/angle.h"
#include "keyline/curve/bezier.h"

namespace keyline::curve {
namespace {

// Limits of the direction of travel by hand: towards the last of the control points that differs.
TEST(Arriving, IsTheWayTravelTook) {
  const Bezier2 straight{{{0, 0}, {0, 0}, {3, 0}, {3, 0}}, {}};
  EXPECT_EQ(arriving_angle(jet(straight, 1)), 0);
  EXPECT_EQ(tangent_angle(jet(straight, 0)), 0);
  const Bezier2 bent{{{0, 0}, {1, 0}, {2, 1}, {2, 1}}, {}};
  EXPECT_NEAR(arriving_angle(jet(bent, 1)), core::kPi / 4, 1e-15);
  EXPECT_NEAR(travel_angle(bent, 1), core::kPi / 4, 1e-15);
  EXPECT_EQ(travel_angle(bent, 0), 0);
  const core::Vector2 tangent = arriving_tangent(jet(bent, 1));
  EXPECT_NEAR(tangent.x, std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(tangent.y, std::sqrt(0.5), 1e-15);
  const Bezier2 thrice{{{0, 0}, {1, 2}, {1, 2}, {1, 2}}, {}};
  EXPECT_NEAR(arriving_angle(jet(thrice, 1)), std::atan2(2, 1), 1e-15);
  const Bezier2 moving{{{0, 0}, {1, 0}, {1, 1}}, {}};
  EXPECT_NEAR(arriving_angle(jet(moving, 1)), core::kPi / 2, 1e-15);
  EXPECT_EQ(arriving_tangent(jet(moving, 1)), unit_tangent(jet(moving, 1)));
  EXPECT_EQ(arriving_angle(Jet2{}), 0);
}

}  // namespace
}  // namespace keyline::curve
