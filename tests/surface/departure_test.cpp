#include "keyline/surface/departure.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "keyline/surface/closest_point.h"

namespace keyline::surface {
namespace {

using core::Point3;

/// A bicubic patch over the unit square, control points evenly spread, heights by `height`.
template <class Height>
BezierSurface patch(Height height) {
  BezierSurface s;
  s.net = {4, 4, {}};
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) s.net.points.push_back({i / 3.0, j / 3.0, height(i, j)});
  return s;
}

TEST(Departure, OfOneControlPointLiftedIsItsBernsteinPolynomialsTop) {
  const double top = 0.3 * std::pow(4.0 / 9, 2);  // of 3 u (1 - u)^2, at a third, in u and in v
  const BezierSurface flat = patch([](int, int) { return 0.0; });
  const BezierSurface lifted = patch([](int i, int j) { return i == 1 && j == 1 ? 0.3 : 0.0; });
  EXPECT_GE(departure_bound(flat, lifted), top * (1 - 1e-12));
  EXPECT_LE(departure_bound(flat, lifted), top * 1.006);
  EXPECT_EQ(departure_bound(flat, lifted), departure_bound(lifted, flat));
  EXPECT_EQ(departure_bound(lifted, lifted), 0);
}

TEST(Departure, IsABoundAndCloseToWhatSamplesShow) {
  std::mt19937_64 random(5);
  const auto uniform = [&](double most) {
    return most * (2 * (static_cast<double>(random() >> 11) * 0x1p-53) - 1);
  };
  for (int round = 0; round < 12; ++round) {
    BezierSurface a = patch([&](int, int) { return uniform(0.4); }), b = a;
    for (Point3& p : b.net.points)
      p = p + core::Vector3{uniform(0.05), uniform(0.05), uniform(0.05)};
    const double bound = departure_bound(a, b), shown = departure(a, b, 41);
    EXPECT_GE(bound, shown * (1 - 1e-12)) << round;
    EXPECT_LE(bound, shown * 1.02) << round;
    // what is enough is not looked at more closely, and nothing is passed for enough that is not
    EXPECT_LE(departure_bound(a, b, 1.1 * bound), 1.1 * bound) << round;
    EXPECT_GE(departure_bound(a, b, 1.1 * bound), shown * (1 - 1e-12)) << round;
    EXPECT_GT(departure_bound(a, b, 0.95 * shown), 0.95 * shown) << round;
  }
}

}  // namespace
}  // namespace keyline::surface
