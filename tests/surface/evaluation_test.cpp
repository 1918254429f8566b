#include <cmath>
#include <functional>
#include <numbers>

#include <gtest/gtest.h>

#include "keyline/surface/surface.h"

#include "test_surfaces.h"

namespace keyline::surface {
namespace {

using core::distance;
using core::norm;
using core::Point3;
using core::Vector3;

std::vector<double> wavy_weights(std::size_t count) {
  std::vector<double> w;
  for (std::size_t i = 0; i < count; ++i) w.push_back(1 + 0.4 * std::sin(2.0 * i));
  return w;
}

BSplineSurface wavy_spline() {
  return {{2, 3},
          {{{0, 0, 0, 1, 1.5, 3, 3, 3}, {-1, -1, -1, -1, 0, 0.25, 1, 1, 1, 1}}},
          wavy_net(5, 6),
          wavy_weights(30)};
}

std::vector<Surface> surfaces() {
  BSplineSurface open = wavy_spline();
  open.knots[0] = {0, 0.5, 1, 2, 2.5, 3, 4, 4.5};  // not clamped
  open.weights.clear();
  return {BezierSurface{wavy_net(4, 4), {}},
          BezierSurface{wavy_net(3, 6), wavy_weights(18)},
          BezierSurface{wavy_net(2, 2), {}},
          BezierSurface{wavy_net(16, 2), {}},
          wavy_spline(),
          open};
}

/// Central difference of a vector function.
Vector3 slope(const std::function<Vector3(double)>& f, double t) {
  constexpr double h = 1e-5;
  return (f(t + h) - f(t - h)) / (2 * h);
}

TEST(SurfaceEvaluation, DerivativesAgreeWithDifferences) {
  for (const Surface& s : surfaces()) {
    for (const auto& [u, v] : {std::pair{0.3, 0.4}, {0.71, 0.13}, {0.95, 0.9}}) {
      const SurfaceJet j = jet(s, u, v);
      const auto by_u = [&](auto get) {
        return slope([&](double x) { return get(jet(s, x, v)); }, u);
      };
      const auto by_v = [&](auto get) {
        return slope([&](double x) { return get(jet(s, u, x)); }, v);
      };
      const auto near = [](Vector3 a, Vector3 b) { return norm(a - b) <= 2e-8 * (1 + norm(a)); };
      EXPECT_LT(distance(j.point, evaluate(s, u, v)), 1e-13);
      EXPECT_TRUE(near(by_u([](const SurfaceJet& x) { return x.point - Point3{}; }), j.u));
      EXPECT_TRUE(near(by_v([](const SurfaceJet& x) { return x.point - Point3{}; }), j.v));
      EXPECT_TRUE(near(by_u([](const SurfaceJet& x) { return x.u; }), j.uu));
      EXPECT_TRUE(near(by_v([](const SurfaceJet& x) { return x.u; }), j.uv));
      EXPECT_TRUE(near(by_v([](const SurfaceJet& x) { return x.v; }), j.vv));
      EXPECT_TRUE(near(by_u([](const SurfaceJet& x) { return x.uu; }), j.uuu));
      EXPECT_TRUE(near(by_v([](const SurfaceJet& x) { return x.uu; }), j.uuv));
      EXPECT_TRUE(near(by_u([](const SurfaceJet& x) { return x.vv; }), j.uvv));
      EXPECT_TRUE(near(by_v([](const SurfaceJet& x) { return x.vv; }), j.vvv));
    }
  }
}

TEST(SurfaceEvaluation, CornersAreCornersOfTheNet) {
  const BezierSurface s{wavy_net(4, 5), {}};
  EXPECT_EQ(evaluate(s, 0, 0), s.net.at(0, 0));
  EXPECT_EQ(evaluate(s, 1, 0), s.net.at(3, 0));
  EXPECT_EQ(evaluate(s, 0, 1), s.net.at(0, 4));
  EXPECT_EQ(evaluate(s, 1, 1), s.net.at(3, 4));
  EXPECT_EQ(evaluate(s, -1, 2), s.net.at(0, 4));  // clamped
}

TEST(SurfaceEvaluation, RationalQuarterTurnIsACylinder) {
  const double w = std::numbers::sqrt2 / 2;
  Net net{3, 2, {}};
  net.points = {{1, 0, 0}, {1, 0, 2}, {1, 1, 0}, {1, 1, 2}, {0, 1, 0}, {0, 1, 2}};
  const BezierSurface s{net, {1, 1, w, w, 1, 1}};
  for (double u = 0; u <= 1; u += 0.125) {
    const Point3 p = evaluate(s, u, 0.3);
    EXPECT_NEAR(std::hypot(p.x, p.y), 1, 1e-15);
    EXPECT_NEAR(p.z, 0.6, 1e-15);
  }
}

TEST(SurfaceConversion, ElevationKeepsTheSurface) {
  for (const Surface& s : surfaces()) {
    if (net_of(s).rows > 10) continue;
    const Surface raised =
        std::visit([](const auto& x) { return Surface{elevate_degree(x, 2, 1)}; }, s);
    ASSERT_TRUE(validate(raised));
    for (double u = 0; u <= 1; u += 0.1)
      for (double v = 0; v <= 1; v += 0.1)
        EXPECT_LT(distance(evaluate(s, u, v), evaluate(raised, u, v)), 1e-12);
  }
}

TEST(SurfaceConversion, BezierPatchesCoverTheSpline) {
  for (const Surface& s : surfaces()) {
    const PatchGrid grid = patches_of(s);
    const auto us = breakpoints_u(s);
    const auto vs = breakpoints_v(s);
    ASSERT_EQ(grid.rows + 1, static_cast<int>(us.size()));
    ASSERT_EQ(grid.columns + 1, static_cast<int>(vs.size()));
    for (int i = 0; i < grid.rows; ++i) {
      for (int j = 0; j < grid.columns; ++j) {
        const BezierSurface& patch = grid.patches[i * grid.columns + j];
        ASSERT_TRUE(validate(patch));
        const double u = us[i] + 0.37 * (us[i + 1] - us[i]);
        const double v = vs[j] + 0.81 * (vs[j + 1] - vs[j]);
        EXPECT_LT(distance(evaluate(patch, 0.37, 0.81), evaluate(s, u, v)), 1e-12);
      }
    }
  }
}

TEST(SurfaceConversion, TransposedAndReversed) {
  for (const Surface& s : surfaces())
    EXPECT_LT(distance(evaluate(transposed(s), 0.2, 0.7), evaluate(s, 0.7, 0.2)), 1e-14);
  const BezierSurface s{wavy_net(3, 6), wavy_weights(18)};
  EXPECT_LT(distance(evaluate(reversed_u(s), 0.2, 0.7), evaluate(s, 0.8, 0.7)), 1e-14);
  EXPECT_LT(distance(curve::evaluate(iso_u(s, 0.2), 0.7), evaluate(s, 0.2, 0.7)), 1e-14);
  EXPECT_LT(distance(curve::evaluate(iso_v(s, 0.7), 0.2), evaluate(s, 0.2, 0.7)), 1e-14);
  EXPECT_LT(distance(evaluate(to_bspline(s), 0.2, 0.7), evaluate(s, 0.2, 0.7)), 1e-14);
}

TEST(SurfaceValidation, SaysWhatIsWrong) {
  const auto path = [](const Surface& s) {
    const auto sound = validate(s);
    return sound ? "fine" : sound.error().path;
  };
  for (const Surface& s : surfaces()) EXPECT_EQ(path(s), "fine");
  BezierSurface b{wavy_net(4, 4), wavy_weights(16)};
  b.net.at(2, 1).y = std::nan("");
  EXPECT_EQ(path(b), "points[2][1]");
  b = {wavy_net(4, 4), wavy_weights(16)};
  b.weights[7] = -1;
  EXPECT_EQ(path(b), "weights[1][3]");
  b.weights.pop_back();
  EXPECT_EQ(path(b), "weights");
  EXPECT_EQ(path(BezierSurface{wavy_net(1, 4), {}}), "points");
  EXPECT_EQ(path(BezierSurface{wavy_net(32, 2), {}}), "points");
  b = {wavy_net(2, 2), {}};
  b.net.points.pop_back();
  EXPECT_EQ(path(b), "points");
  BSplineSurface n = wavy_spline();
  n.knots[1][3] = 7;
  EXPECT_EQ(path(n), "knots[1][4]");
  n = wavy_spline();
  n.knots[0].pop_back();
  EXPECT_EQ(path(n), "knots[0]");
  n = wavy_spline();
  n.degree[1] = 0;
  EXPECT_EQ(path(n), "degree[1]");
  n.degree[1] = 7;
  EXPECT_EQ(path(n), "points");
  EXPECT_THROW(evaluate(n, 0.5, 0.5), core::InvalidInput);
}

}  // namespace
}  // namespace keyline::surface
