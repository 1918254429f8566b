#include "keyline/surface/sweep.h"

#include <cmath>

#include <gtest/gtest.h>

#include "keyline/core/angle.h"
#include "keyline/curve/length.h"
#include "keyline/surface/curvature.h"

#include "test_surfaces.h"

namespace keyline::surface {
namespace {

using core::distance;
using core::Point3;
using core::Vector3;
using curve::BSpline3;

BSpline3 wavy_curve() {
  return {3,
          {0, 0, 0, 0, 0.3, 1, 1, 1, 1},
          {{1, 0, 0}, {1.5, 0, 1}, {1, 0, 2}, {2, 0, 3}, {1.4, 0, 4}},
          {}};
}

/// A circle of radius 10 in the xy plane to within 1e-9, from (10, 0, 0), as a cubic spline.
BSpline3 circle_rail(double angle) {
  BSpline3 rail{3, {0, 0, 0, 0}, {}, {}};
  constexpr int n = 96;
  const double step = angle / n;
  const double k = 10 * 4.0 / 3 * std::tan(step / 4);
  for (int i = 0; i < n; ++i) {
    const double a = i * step;
    const double b = a + step;
    if (i == 0) rail.control.push_back({10, 0, 0});
    rail.control.push_back(
        {10 * std::cos(a) - k * std::sin(a), 10 * std::sin(a) + k * std::cos(a), 0});
    rail.control.push_back(
        {10 * std::cos(b) + k * std::sin(b), 10 * std::sin(b) - k * std::cos(b), 0});
    rail.control.push_back({10 * std::cos(b), 10 * std::sin(b), 0});
    rail.knots.insert(rail.knots.end(), i + 1 < n ? 3 : 4, (i + 1.0) / n);
  }
  return rail;
}

TEST(Sweep, ExtrusionAndTranslationAreExact) {
  const BSpline3 profile = wavy_curve();
  const auto e = extrude(profile, {0, 5, 1});
  ASSERT_TRUE(e);
  ASSERT_TRUE(validate(*e));
  const BSpline3 rail{2, {0, 0, 0, 1, 1, 1}, {{0, 0, 0}, {0, 3, 1}, {1, 5, 0}}, {}};
  const auto t = translate(profile, rail);
  ASSERT_TRUE(t);
  ASSERT_TRUE(validate(*t));
  for (double u = 0; u <= 1; u += 0.25)
    for (double v = 0; v <= 1; v += 0.125) {
      const Point3 p = curve::evaluate(profile, v);
      EXPECT_LT(distance(evaluate(*e, u, v), p + u * Vector3{0, 5, 1}), 1e-13);
      const Vector3 by = curve::evaluate(rail, u) - curve::evaluate(rail, 0);
      EXPECT_LT(distance(evaluate(*t, u, v), p + by), 1e-13);
    }
  EXPECT_EQ(extrude(profile, {}).error().path, "rail");
}

TEST(Sweep, RevolutionIsExactForAnyAngle) {
  const BSpline3 profile = wavy_curve();
  const Axis3 axis{{0, 0, 0}, {0, 0, 2}};
  for (const double angle : {1e-10, 0.4, -1.9, core::kPi, 2 * core::kPi}) {
    const auto s = revolve(profile, axis, angle);
    ASSERT_TRUE(s);
    ASSERT_TRUE(validate(*s));
    for (double u = 0; u <= 1; u += 0.1)
      for (double v = 0; v <= 1; v += 0.25) {
        const Point3 p = curve::evaluate(profile, v);
        const Point3 q = evaluate(*s, u, v);
        EXPECT_NEAR(std::hypot(q.x, q.y), p.x, 1e-14);
        EXPECT_NEAR(q.z, p.z, 1e-14);
      }
    const Point3 end = evaluate(*s, 1, 0);
    EXPECT_NEAR(end.x, std::cos(angle), 1e-13);
    EXPECT_NEAR(end.y, std::sin(angle), 1e-13);
  }
  EXPECT_EQ(revolve(profile, {{}, {}}, 1).error().path, "axis");
  EXPECT_EQ(revolve(profile, axis, 7).error().path, "angle");
}

TEST(Sweep, AlongACircleIsTheRevolution) {
  const BSpline3 profile{1, {0, 0, 1, 1}, {{9, 0, 0}, {11, 0, 1}}, {}};
  const double tolerance = 1e-5;
  const auto made = sweep(profile, circle_rail(2), tolerance);
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_LE(made->deviation, tolerance);
  ASSERT_TRUE(validate(made->surface));
  for (double u = 0; u <= 1; u += 0.05) {
    const Point3 inner = evaluate(made->surface, u, 0);
    EXPECT_NEAR(std::hypot(inner.x, inner.y), 9, 2 * tolerance);
    const Point3 outer = evaluate(made->surface, u, 1);
    EXPECT_NEAR(std::hypot(outer.x, outer.y), 11, 2 * tolerance);
    EXPECT_NEAR(outer.z, 1, 2 * tolerance);
  }
}

TEST(Sweep, CarriesTheProfileAsARigidBodyAlongASpaceRail) {
  const BSpline3 rail{
      3, {0, 0, 0, 0, 1, 1, 1, 1}, {{0, 0, 0}, {0, 0, 5}, {6, 3, 9}, {9, 9, 9}}, {}};
  const BSpline3 profile{2, {0, 0, 0, 1, 1, 1}, {{-1, 0, 0}, {0, 1.5, 0}, {1, 0, 0}}, {}};
  const auto made = sweep(profile, rail, 1e-6);
  ASSERT_TRUE(made);
  for (double u = 0; u <= 1; u += 0.1) {
    const auto at = [&](double v) { return evaluate(made->surface, u, v); };
    EXPECT_NEAR(distance(at(0), at(1)), 2, 3e-6);
    const double t = curve::parameter_at_length(rail, u * curve::arc_length(rail));
    EXPECT_NEAR(distance(at(0.5), curve::evaluate(rail, t)), 0.75, 3e-6);
    const auto tangent = curve::jet(rail, t).first;
    EXPECT_NEAR(dot(at(0) - at(1), tangent) / norm(tangent), 0, 3e-6);  // stays across
  }
}

// Without twist a normal turns back, against the rail's own, by the integral of its torsion: to the
// fourth order of steps, which are eight for each place that a loose tolerance takes.
TEST(Sweep, TurnsAgainstTheRailsNormalByItsTorsion) {
  const BSpline3 rail{
      3, {0, 0, 0, 0, 1, 1, 1, 1}, {{0, 0, 0}, {0, 0, 5}, {6, 3, 9}, {9, 9, 9}}, {}};
  const auto binormal = [](const curve::Jet3& j) {
    const Vector3 b = cross(j.first, j.second);
    return b / norm(b);
  };
  double turn = 0;  // by Simpson's rule
  constexpr int kSteps = 1000;
  for (int i = 0; i <= kSteps; ++i) {
    const auto j = curve::jet(rail, static_cast<double>(i) / kSteps);
    const double rate = curve::torsion(j) * norm(j.first);
    turn -= rate * (i == 0 || i == kSteps ? 1 : i % 2 == 1 ? 4 : 2) / (3.0 * kSteps);
  }
  EXPECT_GT(std::abs(turn), 0.5);
  const auto start = curve::jet(rail, 0), end = curve::jet(rail, 1);
  const Vector3 first = cross(binormal(start), start.first) / norm(start.first);
  const Vector3 last = cross(binormal(end), end.first) / norm(end.first);
  const auto made = sweep({1, {0, 0, 1, 1}, {{0, 0, 0}, Point3{} + first}, {}}, rail, 1e-2);
  ASSERT_TRUE(made) << made.error().message;
  const Vector3 there = evaluate(made->surface, 1, 1) - end.point;
  const Vector3 expected = std::cos(turn) * last + std::sin(turn) * binormal(end);
  EXPECT_LT(norm(there - expected), 1e-8);
}

TEST(Sweep, FollowsARailWhoseCurvatureJumps) {
  const BSpline3 rail{2, {0, 0, 0, 1, 2, 2, 2}, {{0, 0, 0}, {1, 0.5, 0}, {2, 0, 0}, {3, 1, 0}}, {}};
  const BSpline3 profile{1, {0, 0, 1, 1}, {{0, 0, 0}, {0, 1, 2}}, {}};
  const auto made = sweep(profile, rail, 1e-6);
  ASSERT_TRUE(made) << made.error().message;
  ASSERT_TRUE(validate(made->surface));
  for (double u = 0; u <= 1; u += 0.03)
    EXPECT_NEAR(distance(evaluate(made->surface, u, 0), evaluate(made->surface, u, 1)),
                std::sqrt(5), 3e-6);
}

TEST(Sweep, SaysWhatItCannot) {
  const BSpline3 corner{1, {0, 0, 0.5, 1, 1}, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, {}};
  EXPECT_EQ(sweep(wavy_curve(), corner, 1e-3).error().code, core::ErrorCode::unsupported);
  EXPECT_EQ(sweep(wavy_curve(), circle_rail(1), 0).error().path, "tolerance");
  EXPECT_EQ(sweep(wavy_curve(), circle_rail(1), 1e-15).error().code,
            core::ErrorCode::not_converged);
}

TEST(Loft, PassesThroughSectionsOfDifferentDegreesAndKnots) {
  std::vector<BSpline3> sections{wavy_curve()};
  sections.push_back({2, {0, 0, 0, 2, 4, 4, 4}, {{1, 2, 0}, {2, 2, 1}, {1, 2, 3}, {1, 2, 4}}, {}});
  sections.push_back({1, {0, 0, 1, 1}, {{1, 4, 0}, {2, 4, 4}}, {}});
  sections.push_back(wavy_curve());
  for (auto& p : sections[3].control) p.y = 7;
  for (std::size_t n = 2; n <= 4; ++n) {
    const std::vector<BSpline3> some(sections.begin(), sections.begin() + n);
    const auto s = loft(some);
    ASSERT_TRUE(s) << s.error().message;
    ASSERT_TRUE(validate(*s));
    // the sections lie at constant u: the u at which y is the section's
    for (std::size_t i = 0; i < n; ++i) {
      double low = 0;
      double high = 1;
      for (int k = 0; k < 60; ++k)
        (evaluate(*s, 0.5 * (low + high), 0).y < some[i].control[0].y ? low : high) =
            0.5 * (low + high);
      for (double v = 0; v <= 1; v += 0.1)
        EXPECT_LT(distance(evaluate(*s, high, v), curve::evaluate(some[i], v)), 1e-9);
    }
  }
  EXPECT_EQ(loft({wavy_curve()}).error().path, "sections");
  EXPECT_EQ(loft({wavy_curve(), wavy_curve()}).error().path, "sections[1]");
}

TEST(Loft, RationalSectionsNeedTheSameWeights) {
  const double w = std::numbers::sqrt2 / 2;
  const auto arc = [&](double z, double middle) {
    return BSpline3{2, {0, 0, 0, 1, 1, 1}, {{1, 0, z}, {1, 1, z}, {0, 1, z}}, {1, middle, 1}};
  };
  const auto s = loft({arc(0, w), arc(1, w), arc(3, w)});
  ASSERT_TRUE(s);
  const Point3 p = evaluate(*s, 0.4, 0.3);
  EXPECT_NEAR(std::hypot(p.x, p.y), 1, 1e-14);
  EXPECT_EQ(loft({arc(0, w), arc(1, 1)}).error().code, core::ErrorCode::unsupported);
}

}  // namespace
}  // namespace keyline::surface
