#include "keyline/classa/between_in_space.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "keyline/curve/jet.h"

/// Problems are built from their answers: curves whose edges are turned about an axis and scaled.
namespace keyline::classa {
namespace {

using core::Point3;
using core::Vector3;

Vector3 turned(Vector3 v, Vector3 axis, double angle) {
  return std::cos(angle) * v + std::sin(angle) * cross(axis, v) +
         ((1 - std::cos(angle)) * dot(axis, v)) * axis;
}

curve::Bezier3 of_matrix(Vector3 first, Vector3 axis, double alpha, double s, int degree) {
  curve::Bezier3 c{{{1, -2, 0.5}}, {}};
  for (int i = 0; i < degree; ++i)
    c.control.push_back(c.control.back() + std::pow(s, i) * turned(first, axis, i * alpha));
  return c;
}

SpaceEndTangents ends_of(const curve::Bezier3& c) {
  const std::size_t n = c.control.size() - 1;
  return {c.control[0], c.control[1] - c.control[0], c.control[n],
          3 * (c.control[n] - c.control[n - 1])};
}

double curvature_at(const curve::Bezier3& c, double t) {
  const curve::Jet3 j = jet(c, t);
  return norm(cross(j.first, j.second)) / std::pow(norm(j.first), 3);
}

/// Whether sampled curvature runs one way.
bool runs_one_way(const curve::Bezier3& c) {
  bool rises = false, falls = false;
  double before = curvature_at(c, 0);
  for (int i = 1; i <= 400; ++i) {
    const double now = curvature_at(c, i / 400.0);
    rises |= now > before * (1 + 1e-9);
    falls |= now < before * (1 - 1e-9);
    before = now;
  }
  return !(rises && falls);
}

/// That every edge is the one before, turned by one angle about one axis and scaled by one factor.
void expect_one_matrix(const curve::Bezier3& c) {
  std::vector<Vector3> e;
  for (std::size_t i = 1; i < c.control.size(); ++i) e.push_back(c.control[i] - c.control[i - 1]);
  for (std::size_t i = 2; i < e.size(); ++i) {
    EXPECT_NEAR(norm(e[i]) / norm(e[i - 1]), norm(e[1]) / norm(e[0]), 1e-8);
    EXPECT_NEAR(dot(e[i], e[i - 1]) / norm(e[i]) / norm(e[i - 1]),
                dot(e[1], e[0]) / norm(e[1]) / norm(e[0]), 1e-8);
  }
  for (std::size_t i = 3; i < e.size(); ++i) {  // the third angle: of edges two apart
    EXPECT_NEAR(dot(e[i], e[i - 2]) / norm(e[i]) / norm(e[i - 2]),
                dot(e[2], e[0]) / norm(e[2]) / norm(e[0]), 1e-8);
  }
}

TEST(BetweenInSpace, FindsClassACurvesForTheEndsOfOne) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  int asked = 0, found = 0, same = 0;
  while (asked < 120) {
    const Vector3 draw{unit(random), unit(random), unit(random)};
    const Vector3 axis = draw / norm(draw);
    const Vector3 first{1 + unit(random), unit(random), unit(random)};
    const int degree = 3 + asked % 4;
    const double alpha = 0.1 + (2.4 / (degree - 1) - 0.1) * std::abs(unit(random));
    const double s = std::exp(0.9 * unit(random));
    if (alpha > 1.0) continue;
    const curve::Bezier3 given = of_matrix(first, axis, alpha, s, degree);
    if (!runs_one_way(given)) continue;
    ++asked;
    SCOPED_TRACE(asked);
    BetweenRange range;
    range.lowest_degree = degree;
    const auto c = class_a_between(ends_of(given), range);
    if (!c) continue;
    ++found;
    const std::size_t n = c->control.size() - 1;
    const SpaceEndTangents ends = ends_of(given);
    EXPECT_EQ(c->control[0], ends.start);
    const double size = norm(ends.end - ends.start);
    EXPECT_LT(norm(c->control[n] - ends.end), 1e-10 * size);
    EXPECT_LT(norm(cross(c->control[1] - c->control[0], ends.start_tangent)),
              1e-10 * norm(c->control[1] - c->control[0]) * norm(ends.start_tangent));
    EXPECT_LT(norm(cross(c->control[n] - c->control[n - 1], ends.end_tangent)),
              1e-10 * norm(c->control[n] - c->control[n - 1]) * norm(ends.end_tangent));
    expect_one_matrix(*c);
    EXPECT_TRUE(runs_one_way(*c));
    bool equal = c->control.size() == given.control.size();
    for (std::size_t i = 0; equal && i <= n; ++i)
      equal = norm(c->control[i] - given.control[i]) < 1e-6 * size;
    same += equal;
  }
  EXPECT_EQ(found, asked);
  EXPECT_GT(same, asked / 2);
}

// Whatever is found lies in the range of scales; where the range holds that of the curve the ends
// were taken from, one is.
TEST(BetweenInSpace, KeepsToTheRangeOfScales) {
  const Vector3 axis{0.6, 0, 0.8};
  for (const double s : {0.6, 1.6}) {
    const SpaceEndTangents ends = ends_of(of_matrix({1, 0.3, 0.2}, axis, 0.4, s, 4));
    const auto scale_in = [&](core::Interval range) {
      const auto c = class_a_between(ends, {.lowest_degree = 4, .highest_degree = 4, .s = range});
      return c ? norm(c->control[2] - c->control[1]) / norm(c->control[1] - c->control[0]) : 0;
    };
    EXPECT_NEAR(scale_in({0.01, 100}), s, 1e-8);
    EXPECT_NEAR(scale_in({s - 0.01, s + 0.01}), s, 1e-8);
    EXPECT_EQ(scale_in({s + 0.01, s + 0.02}), 0);
    EXPECT_EQ(scale_in({s - 0.02, s - 0.01}), 0);
  }
}

TEST(BetweenInSpace, InAPlaneIsThePlaneCurve) {
  const Vector3 x{2 / 3.0, 2 / 3.0, 1 / 3.0}, y{-2 / 3.0, 1 / 3.0, 2 / 3.0};
  const auto lifted = [&](double a, double b) { return a * x + b * y; };
  const Point3 at{3, 1, -2};
  const auto plane = class_a_between(EndTangents{{0, 0}, {1, 0}, {2, 1.2}, {0.2, 1}});
  const auto space =
      class_a_between(SpaceEndTangents{at, lifted(1, 0), at + lifted(2, 1.2), lifted(0.2, 1)});
  ASSERT_TRUE(plane && space);
  const curve::Bezier2 flat = to_bezier(*plane);
  ASSERT_EQ(flat.control.size(), space->control.size());
  for (std::size_t i = 0; i < flat.control.size(); ++i)
    EXPECT_LT(norm(space->control[i] - (at + lifted(flat.control[i].x, flat.control[i].y))), 1e-14);
}

TEST(BetweenInSpace, RefusesWhatThereIsNot) {
  EXPECT_FALSE(class_a_between(SpaceEndTangents{{}, {1, 0, 0}, {}, {0, 1, 0}}));
  EXPECT_FALSE(class_a_between(SpaceEndTangents{{}, {1, 0, 0}, {1, 1, 0}, {1, 0, 0}}));
  EXPECT_FALSE(class_a_between(SpaceEndTangents{{}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}}));
}

}  // namespace
}  // namespace keyline::classa
