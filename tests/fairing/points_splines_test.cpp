#include "keyline/fairing/points_splines.h"

#include <cmath>

#include <gtest/gtest.h>

#include "keyline/acquire/acquire.h"
#include "keyline/core/angle.h"
#include "keyline/curve/view.h"
#include "keyline/numeric/random.h"

namespace keyline::fairing {
namespace {

/// Two arcs of radius 1 that meet in two corners of 60 degrees inside, all around.
acquire::RawCurve lens() {
  acquire::RawCurve raw;
  numeric::Random random(3);
  constexpr int kSide = 60;
  const auto add = [&](double side, int i) {
    const double a = core::kPi / 3 * (2.0 * i / kSide - 1);
    raw.points.push_back({side * (std::cos(a) - 0.5) + 5e-4 * random.normal(),
                          side * std::sin(a) + 5e-4 * random.normal(), 0});
  };
  for (int i = 0; i < kSide; ++i) add(1, i);
  for (int i = 0; i < kSide; ++i) add(-1, i);
  return raw;
}

// One spline all around follows the points through the corners with needles of a million.
TEST(PointsSplines, EndAtCorners) {
  acquire::AcquireOptions options;
  options.closed = true;
  const auto line = acquire::acquire_key_line(lens(), options);
  ASSERT_TRUE(line);
  ASSERT_EQ(line->corners.size(), 2U);
  const auto splines = splines_of(*line, fit::SplineFitOptions::for_fairing());
  ASSERT_TRUE(splines);
  ASSERT_EQ(splines->size(), 2U);
  for (const curve::BSpline2& spline : *splines)
    for (int i = 0; i <= 400; ++i) EXPECT_NEAR(curvature(jet(spline, i / 400.0)), 1, 0.5) << i;
}

}  // namespace
}  // namespace keyline::fairing
