#include "keyline/lac/g2/spline_start.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/core/angle.h"

namespace keyline::lac::detail {
namespace {

using core::Point2;

/// A closed request under other first points, directions of travel and mirrors.
struct Named {
  std::vector<Point2> points;
  SplineOptions options;
};

std::vector<Named> under_all_names(const std::vector<Point2>& points,
                                   const std::vector<double>& alpha) {
  std::vector<Named> all;
  for (std::size_t first = 0; first < points.size(); ++first)
    for (const bool back : {false, true})
      for (const bool mirrored : {false, true}) {
        Named named{points, {}};
        named.options.closed = true;
        named.options.alpha = alpha;
        std::rotate(named.points.begin(), named.points.begin() + first, named.points.end());
        std::rotate(named.options.alpha.begin(), named.options.alpha.begin() + first,
                    named.options.alpha.end());
        if (back) {
          std::reverse(named.points.begin() + 1, named.points.end());
          std::reverse(named.options.alpha.begin(), named.options.alpha.end());
        }
        if (mirrored)
          for (Point2& p : named.points) p.y = -p.y;
        all.push_back(named);
      }
  return all;
}

/// Chord, slope and turn at every point of the way, the first turn that is one to the left.
std::vector<double> shape_on_way(const Named& named) {
  const SplineStart way = spline_start(named.points, named.options);
  const auto points = travelled(named.points, way);
  const auto alpha = travelled(named.options, way).alpha;
  const std::size_t n = points.size();
  std::vector<double> shape;
  double side = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const auto chord = points[(i + 1) % n] - points[i];
    const double turn = core::angle_between(points[i] - points[(i + n - 1) % n], chord);
    if (side == 0 && std::abs(turn) > 1e-9) side = std::copysign(1, turn);
    shape.insert(shape.end(), {norm(chord), alpha[i], side * turn});
  }
  return shape;
}

void expect_one_way(const std::vector<Point2>& points, const std::vector<double>& alpha) {
  std::vector<double> first;
  for (const Named& named : under_all_names(points, alpha)) {
    const auto shape = shape_on_way(named);
    if (first.empty()) first = shape;
    for (std::size_t i = 0; i < shape.size(); ++i) EXPECT_NEAR(shape[i], first[i], 1e-12);
  }
}

TEST(SplineStart, IsOneUnderAllNamesOfARequest) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int n = 0; n < 20; ++n) {
    std::vector<Point2> points;
    std::vector<double> alpha;
    for (int i = 0; i < 6; ++i) {
      points.push_back({unit(random), unit(random)});
      alpha.push_back(unit(random));
    }
    expect_one_way(points, alpha);
  }
}

// Sides and angles are all the same; only whether they turn left or right tells.
TEST(SplineStart, IsOneOnALattice) {
  const std::vector<Point2> outline{{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {1, 1}, {0, 1}};
  const std::vector<Point2> stairs{{0, 0}, {1, 0}, {1, 1}, {2, 1},  {2, 2},  {1, 2},
                                   {1, 3}, {0, 3}, {0, 2}, {-1, 2}, {-1, 1}, {0, 1}};
  for (const auto& points : {outline, stairs})
    expect_one_way(points, std::vector<double>(points.size(), -1.0));
}

TEST(SplineStart, FollowsTheSlopesWhereAllElseIsTheSame) {
  const std::vector<Point2> square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  expect_one_way(square, {-1, -2, -1, -1});
  expect_one_way(square, {-1, -2, -3, -1});
}

}  // namespace
}  // namespace keyline::lac::detail
