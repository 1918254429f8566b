#include "keyline/operations/subject.h"

#include <cmath>

#include <gtest/gtest.h>

#include "keyline/core/angle.h"

namespace keyline::operations {
namespace {

using core::Point2;

/// A quarter of a circle from the direction, as a cubic (its radius off by 2.7e-4), and where it
/// ends.
curve::Bezier2 quarter(Point2 from, double direction, double radius) {
  const double handle = 4.0 / 3 * (std::sqrt(2.0) - 1) * radius;
  const core::Vector2 t{std::cos(direction), std::sin(direction)}, n{-t.y, t.x};
  const Point2 to = from + radius * (t + n);
  return {{from, from + handle * t, to - handle * n, to}, {}};
}

/// Two quarters, of radius 40 and so much, that meet in a kink of so many degrees.
std::size_t corners(double radius, double degrees, double tolerance) {
  const double turned = core::kPi / 2 + degrees * core::kPi / 180;
  document::Path path;
  path.curves.push_back({quarter({0, 0}, 0, 40)});
  path.curves.push_back({quarter({40, 40}, turned, radius)});
  const auto line = sampled_line(path, tolerance);
  return line ? line->corners.size() : 99;
}

// A kink of t radians is hidden within d by an arc of radius R, R t^2 / 8 = d: of 5 degrees and 0.4
// R is 420, of 20 degrees 26.
TEST(SampledLine, HasNoCornerWhereABendFlatterThanTheCurveHidesIt) {
  EXPECT_EQ(corners(40, 5, 0.4), 0U);
  EXPECT_EQ(corners(380, 5, 0.4), 0U);
  EXPECT_EQ(corners(460, 5, 0.4), 1U);  // its own flat side would show the bend
  EXPECT_EQ(corners(40, 20, 0.4), 1U);
  EXPECT_EQ(corners(40, -20, 0.4), 1U);
  EXPECT_EQ(corners(40, 5, 0.03), 1U);
  EXPECT_EQ(corners(40, 5, 0), 1U);  // by default a ten-thousandth of the length, 0.013
}

TEST(SampledLine, HasACornerBetweenLines) {
  document::Path path;
  path.curves.push_back({curve::Bezier2{{{0, 0}, {10, 0}}, {}}});
  path.curves.push_back({curve::Bezier2{{{10, 0}, {20, 0.5}}, {}}});
  const auto line = sampled_line(path, 0.4);
  ASSERT_TRUE(line);
  EXPECT_EQ(line->corners.size(), 1U);
}

}  // namespace
}  // namespace keyline::operations
