#include "keyline/surface/curvature.h"

#include <cmath>

#include <gtest/gtest.h>

#include "keyline/surface/sample_grid.h"

#include "test_surfaces.h"

namespace keyline::surface {
namespace {

using core::dot;
using core::norm;

TEST(SurfaceCurvature, SphereIsEquallyCurvedEverywhereAndAtItsPole) {
  const Surface s = sphere_octant(2);
  for (const double u : {0.0, 0.3, 1.0})
    for (const double v : {0.0, 0.5, 0.9, 1.0}) {
      const auto k = curvature_of(jet_with_normal(s, u, v));
      ASSERT_TRUE(k);
      EXPECT_NEAR(k->gaussian, 0.25, 1e-9);
      EXPECT_NEAR(std::abs(k->mean), 0.5, 1e-9);
      EXPECT_NEAR(k->largest, k->smallest, 1e-8);
    }
  EXPECT_FALSE(curvature_of(jet(s, 0.3, 1)));  // the pole itself has no S_u
}

TEST(SurfaceCurvature, CylinderHasItsRadiusAndItsRulings) {
  const Surface s = quarter_cylinder(0, 0, 5, 3);
  const auto k = curvature_of(jet(s, 0.37, 0.2));
  ASSERT_TRUE(k);
  EXPECT_NEAR(k->gaussian, 0, 1e-15);
  EXPECT_NEAR(k->smallest, -0.2, 1e-14);  // normal outwards: bends away from it
  EXPECT_NEAR(std::abs(k->largest_direction.y), 1, 1e-14);
  EXPECT_NEAR(dot(k->largest_direction, k->smallest_direction), 0, 1e-14);
}

/// Gaussian and mean curvature from positions alone, by central differences.
std::pair<double, double> by_differences(const Surface& s, double u, double v) {
  constexpr double h = 1e-3;
  const auto p = [&](int i, int j) { return evaluate(s, u + i * h, v + j * h); };
  const auto su = (p(1, 0) - p(-1, 0)) / (2 * h);
  const auto sv = (p(0, 1) - p(0, -1)) / (2 * h);
  const auto suu = ((p(1, 0) - p(0, 0)) - (p(0, 0) - p(-1, 0))) / (h * h);
  const auto svv = ((p(0, 1) - p(0, 0)) - (p(0, 0) - p(0, -1))) / (h * h);
  const auto suv = ((p(1, 1) - p(1, -1)) - (p(-1, 1) - p(-1, -1))) / (4 * h * h);
  const auto cross = core::cross(su, sv);
  const auto n = cross / norm(cross);
  const double e = dot(su, su);
  const double f = dot(su, sv);
  const double g = dot(sv, sv);
  const double l = dot(suu, n);
  const double m = dot(suv, n);
  const double q = dot(svv, n);
  const double area = e * g - f * f;
  return {(l * q - m * m) / area, (e * q - 2 * f * m + g * l) / (2 * area)};
}

TEST(SurfaceCurvature, AgreesWithDifferencesOfPositions) {
  const BSplineSurface spline{
      {2, 3}, {{{0, 0, 0, 1, 1, 1}, {0, 0, 0, 0, 0.6, 1, 1, 1, 1}}}, wavy_net(3, 5), {}};
  for (const Surface& s :
       {Surface{crowned_patch()}, Surface{BezierSurface{wavy_net(5, 4), {}}}, Surface{spline}}) {
    for (const double u : {0.11, 0.5, 0.83})
      for (const double v : {0.2, 0.47, 0.91}) {
        const auto k = curvature_of(jet(s, u, v));
        ASSERT_TRUE(k);
        const auto [gaussian, mean] = by_differences(s, u, v);
        const double size = k->largest * k->largest + k->smallest * k->smallest;
        EXPECT_NEAR(k->gaussian, gaussian, 1e-4 * size);
        EXPECT_NEAR(k->mean, mean, 1e-4 * std::sqrt(size));
        EXPECT_NEAR(k->gaussian, k->largest * k->smallest, 1e-12 * size);
      }
  }
}

// z = (x^2 + 4 x y - 2 y^2) / 2 has the Hessian ((1, 2), (2, -2)) where it is level: eigenvalues 2
// and -3 with eigenvectors (2, 1) and (1, -2).
TEST(SurfaceCurvature, PrincipalDirectionsAreTheEigenvectors) {
  BezierSurface s{{3, 3, {}}, {}};
  const double place[] = {-0.5, 0, 0.5};
  const double square[] = {0.25, -0.25, 0.25};  // Bernstein coefficients of (t - 1/2)^2
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      s.net.points.push_back(
          {place[i], place[j], 0.5 * (square[i] + 4 * place[i] * place[j] - 2 * square[j])});
  const auto k = curvature_of(jet(Surface{s}, 0.5, 0.5));
  ASSERT_TRUE(k);
  EXPECT_NEAR(k->largest, 2, 1e-14);
  EXPECT_NEAR(k->smallest, -3, 1e-14);
  EXPECT_NEAR(k->largest_direction.y / k->largest_direction.x, 0.5, 1e-14);
  EXPECT_NEAR(k->smallest_direction.y / k->smallest_direction.x, -2, 1e-13);
}

TEST(SurfaceCurvature, DegenerateNetsHaveNone) {
  const BezierSurface point{{3, 3, std::vector<core::Point3>(9, {1, 2, 3})}, {}};
  EXPECT_FALSE(curvature_of(jet_with_normal(point, 0.5, 0.5)));
  BezierSurface line{{2, 2, {}}, {}};
  line.net.points = {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}};
  EXPECT_FALSE(curvature_of(jet_with_normal(line, 0.5, 0.5)));
}

TEST(SampleGrid, IsTheSurfaceAtEqualStepsWhateverTheThreads) {
  const Surface s = BSplineSurface{{2, 3},
                                   {{{0, 0, 0, 1, 1, 1}, {0, 0, 0, 0, 0.6, 1, 1, 1, 1}}},
                                   wavy_net(3, 5),
                                   std::vector<double>(15, 2)};
  const JetGrid grid = sample_grid(s, 5, 9, 1);
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 9; ++j) {
      const SurfaceJet here = jet(s, i / 4.0, j / 8.0);
      EXPECT_LT(core::distance(grid.at(i, j).point, here.point), 1e-13);
      EXPECT_LT(norm(grid.at(i, j).uv - here.uv), 1e-12);
    }
  EXPECT_EQ(sample_grid(s, 5, 9, 3).jets, grid.jets);
  EXPECT_THROW(sample_grid(s, 1, 5), core::InvalidInput);
  EXPECT_THROW(sample_grid(s, 1 << 20, 1 << 20), core::InvalidInput);
}

}  // namespace
}  // namespace keyline::surface
