#include "keyline/core/second_moments.h"

#include <gtest/gtest.h>

namespace keyline::core {
namespace {

// Points at the ends of both axes of an ellipse, weighted: along each axis twice the weight times
// the square of its half length.
TEST(SecondMoments, OfAnEllipseAreThoseOfItsAxes) {
  for (const double turn : {-1.5, -0.7, 0.0, 0.4, kPi / 2}) {
    const Vector2 u = unit_vector(turn), v = perpendicular_left(u);
    SecondMoments m;
    for (const double side : {-1.0, 1.0}) {
      m.add(side * 3 * u, 0.5);
      m.add(side * 2 * v);
    }
    EXPECT_NEAR(m.along(), 9, 1e-14) << turn;
    EXPECT_NEAR(m.across(), 8, 1e-14) << turn;
    EXPECT_NEAR(std::abs(dot(m.direction(), u)), 1, 1e-15) << turn;
    EXPECT_GE(m.direction().x, 0) << turn;
  }
}

TEST(SecondMoments, OfALineHaveNoWidth) {
  SecondMoments m;
  for (int i = -5; i <= 5; ++i) m.add(Vector2{0.1, 0.3} * i);
  EXPECT_NEAR(m.along(), 0.1 * 110, 1e-14);
  EXPECT_GE(m.across(), 0);
  EXPECT_NEAR(m.across(), 0, 1e-14);
}

}  // namespace
}  // namespace keyline::core
