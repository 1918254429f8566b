#include "keyline/fairing/between_points.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

/// The centripetal Catmull-Rom curve by its other definition: a cubic of Hermite whose slopes at
/// the middle points are the parabolas' through three neighbours, in a parameter that grows by the
/// roots of the chords.
namespace keyline::fairing::detail {
namespace {

using core::Point2;
using core::Vector2;

Point2 hermite(const std::vector<Point2>& p, double u) {
  std::vector<double> t{0};
  for (int i = 1; i < 4; ++i)
    t.push_back(t.back() + std::sqrt(std::hypot(p[i].x - p[i - 1].x, p[i].y - p[i - 1].y)));
  const auto slope = [&](int i) {
    const double before = t[i] - t[i - 1], after = t[i + 1] - t[i];
    const Vector2 first = (p[i] - p[i - 1]) / before, second = (p[i + 1] - p[i]) / after;
    return (after * first + before * second) / (before + after);
  };
  const double h = t[2] - t[1];
  const double u2 = u * u, u3 = u2 * u;
  const Vector2 from = h * slope(1), to = h * slope(2);
  return p[1] + (3 * u2 - 2 * u3) * (p[2] - p[1]) + (u - 2 * u2 + u3) * from + (u3 - u2) * to;
}

const std::vector<Point2> kBent{{0, 0}, {1, 0.2}, {1.5, 1}, {4, 1.5}, {4.2, 3}, {2, 4}};

TEST(BetweenPoints, IsTheCubicOfTheParabolasSlopes) {
  for (std::size_t i = 1; i + 2 < kBent.size(); ++i)
    for (const double u : {0.0, 0.2, 0.5, 0.9, 1.0}) {
      const Point2 found = between_points(kBent, false, i, u);
      const Point2 meant = hermite({kBent[i - 1], kBent[i], kBent[i + 1], kBent[i + 2]}, u);
      EXPECT_NEAR(found.x, meant.x, 1e-13) << i << ' ' << u;
      EXPECT_NEAR(found.y, meant.y, 1e-13) << i << ' ' << u;
    }
}

// Beyond an open curve's ends its first and last chords go on straight.
TEST(BetweenPoints, EndsGoOnAsTheirChords) {
  const std::size_t last = kBent.size() - 1;
  const Point2 before{-1, -0.2};
  const Point2 after{-0.2, 5};
  for (const double u : {0.3, 0.8}) {
    const Point2 first = between_points(kBent, false, 0, u);
    const Point2 meant = hermite({before, kBent[0], kBent[1], kBent[2]}, u);
    EXPECT_NEAR(core::distance(first, meant), 0, 1e-13);
    const Point2 end = between_points(kBent, false, last - 1, u);
    const Point2 wanted = hermite({kBent[last - 2], kBent[last - 1], kBent[last], after}, u);
    EXPECT_NEAR(core::distance(end, wanted), 0, 1e-13);
  }
}

TEST(BetweenPoints, ClosedCurvesGoOnAtTheirOtherEnd) {
  const std::size_t n = kBent.size();
  for (const double u : {0.25, 0.6}) {
    const auto seam = hermite({kBent[n - 2], kBent[n - 1], kBent[0], kBent[1]}, u);
    EXPECT_NEAR(core::distance(between_points(kBent, true, n - 1, u), seam), 0, 1e-13);
    const auto first = hermite({kBent[n - 1], kBent[0], kBent[1], kBent[2]}, u);
    EXPECT_NEAR(core::distance(between_points(kBent, true, 0, u), first), 0, 1e-13);
  }
}

}  // namespace
}  // namespace keyline::fairing::detail
