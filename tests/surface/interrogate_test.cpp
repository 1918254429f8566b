#include "keyline/surface/interrogate.h"

#include <cmath>

#include <gtest/gtest.h>

#include "keyline/core/angle.h"

#include "test_surfaces.h"

namespace keyline::surface {
namespace {

Field field_of(const Surface& s, FieldKind kind, const Lighting& lighting = {}, int rows = 33,
               int columns = 33) {
  auto field = interrogate(sample_grid(s, rows, columns), kind, lighting);
  EXPECT_TRUE(field) << field.error().message;
  return field ? *field : Field{};
}

TEST(Interrogate, CurvaturesOfASphere) {
  const Surface s = sphere_octant(4);
  const Field gaussian = field_of(s, FieldKind::gaussian);
  EXPECT_NEAR(gaussian.range.low, 1.0 / 16, 1e-8);
  EXPECT_NEAR(gaussian.range.high, 1.0 / 16, 1e-8);
  const Field principal = field_of(s, FieldKind::principal);
  ASSERT_EQ(principal.second.size(), principal.values.size());
  EXPECT_NEAR(std::abs(principal.range.low), 0.25, 1e-7);
}

TEST(Interrogate, ZebraOfASphereFollowsTheReflectedRay) {
  // Normal at polar angle a from the view: the ray is at 2a, so the latitude over stripes is 2a.
  const Surface s = quarter_cylinder(0, 0, 1, 1);
  Lighting l;
  l.view = core::Vector3{0, 0, 1};
  l.stripes = core::Vector3{1, 0, 0};
  l.stripe_count = 10;
  const JetGrid grid = sample_grid(s, 9, 2);
  const Field zebra = field_of(s, FieldKind::zebra, l, 9, 2);
  for (int i = 0; i < 9; ++i) {
    const double a = std::atan2(grid.at(i, 0).point.x, grid.at(i, 0).point.z);
    const double latitude = a <= core::kPi / 4 ? 2 * a : core::kPi - 2 * a;
    EXPECT_NEAR(zebra.values[i * 2], 10 * (0.5 + latitude / core::kPi), 1e-7);
  }
}

TEST(Interrogate, IsophoteIsTheCosine) {
  Lighting l;
  l.light = core::Vector3{0, 0, 7};
  const Surface s = sphere_octant(1);
  const JetGrid grid = sample_grid(s, 9, 9);
  const Field field = field_of(s, FieldKind::isophote, l, 9, 9);
  const double sign = field.values[4 * 9 + 4] < 0 ? -1 : 1;
  for (int i = 0; i < 9; ++i)
    for (int j = 0; j < 8; ++j)
      EXPECT_NEAR(sign * field.values[i * 9 + j], grid.at(i, j).point.z, 1e-12);
}

TEST(Interrogate, ReflectionInAFlatMirrorIsTheMirrorImage) {
  BezierSurface flat{{2, 2, {}}, {}};
  flat.net.points = {{0, 0, 0}, {0, 4, 0}, {4, 0, 0}, {4, 4, 0}};
  Lighting l;
  l.view = core::Vector3{0, 0, 1};
  l.stripes = core::Vector3{0, 1, 0};
  l.origin = core::Point3{1, 1, 10};
  l.spacing = 0.5;
  const Field field = field_of(flat, FieldKind::reflection, l, 3, 3);
  EXPECT_NEAR(field.values[0], -2, 1e-12);  // (0, 0) lies one unit before the first line
  EXPECT_NEAR(field.values[2], 6, 1e-12);
  l.view = core::Vector3{0.2, 0, 1};  // seen from the side: shifted along x only
  EXPECT_NEAR(field_of(flat, FieldKind::reflection, l, 3, 3).values[2], 6, 1e-12);
}

TEST(Interrogate, HighlightIsTheDistanceOfNormalAndLight) {
  const Surface s = quarter_cylinder(0, 0, 1, 1);  // normals pass the axis x = z = 0
  Lighting l;
  l.light = core::Vector3{0, 1, 0};
  l.origin = core::Point3{0, 0, 3};
  const JetGrid grid = sample_grid(s, 9, 2);
  const Field field = field_of(s, FieldKind::highlight, l, 9, 2);
  for (int i = 0; i < 9; ++i)
    EXPECT_NEAR(std::abs(field.values[i * 2]), 3 * grid.at(i, 0).point.x, 1e-12);
  EXPECT_NEAR(field.values[0], 0, 1e-12);
}

TEST(Interrogate, FieldsTurnWithTheSurface) {
  const BezierSurface s = crowned_patch();
  BezierSurface moved = s;
  const double c = std::cos(0.7);
  const double d = std::sin(0.7);
  for (core::Point3& p : moved.net.points) p = {5 + c * p.x - d * p.z, p.y - 3, d * p.x + c * p.z};
  for (const FieldKind kind :
       {FieldKind::gaussian, FieldKind::mean, FieldKind::principal, FieldKind::zebra,
        FieldKind::isophote, FieldKind::reflection, FieldKind::highlight}) {
    const Field a = field_of(s, kind);
    const Field b = field_of(moved, kind);
    const double size = std::abs(a.range.low) + std::abs(a.range.high);
    for (std::size_t i = 0; i < a.values.size(); ++i)
      EXPECT_NEAR(a.values[i], b.values[i], 1e-10 * size);
  }
}

/// Largest difference of the field on both sides of a joint u1–u0, and of its slope across.
struct Step {
  double value = 0;
  double slope = 0;
};
Step step_at_joint(const BezierSurface& a, const BezierSurface& b) {
  constexpr int n = 41;
  Lighting l;
  l.view = core::Vector3{-0.2, 0.1, 1};
  l.stripes = core::Vector3{1, 0.3, 0};
  const Field fa = field_of(a, FieldKind::zebra, l, n, n);
  const Field fb = field_of(b, FieldKind::zebra, l, n, n);
  Step step;
  for (int j = 0; j < n; ++j) {
    const auto last = static_cast<std::size_t>((n - 1) * n + j);
    const auto first = static_cast<std::size_t>(j);
    step.value = std::max(step.value, std::abs(fa.values[last] - fb.values[first]));
    const double before = (fa.values[last] - fa.values[last - n]) / 0.4;  // widths of the halves
    const double after = (fb.values[first + n] - fb.values[first]) / 0.6;
    step.slope = std::max(step.slope, std::abs(after - before));
  }
  return step;
}

TEST(Interrogate, ZebraIsContinuousAcrossG1AndBrokenAcrossG0) {
  const auto [a, smooth] = halves_u(crowned_patch());
  BezierSurface g1 = smooth;
  for (int j = 0; j < 4; ++j) g1.net.at(2, j).z += 6;
  BezierSurface g0 = smooth;
  for (int j = 0; j < 4; ++j) g0.net.at(1, j).z += 1;
  EXPECT_LT(step_at_joint(a, smooth).value, 1e-12);
  EXPECT_LT(step_at_joint(a, g1).value, 1e-12);
  EXPECT_GT(step_at_joint(a, g1).slope, 5 * step_at_joint(a, smooth).slope);
  EXPECT_GT(step_at_joint(a, g0).value, 0.05);
}

// Two edges of a triangle, the third collapsed into the origin.
TEST(Interrogate, PointsOfACollapsedEdgeStayInTheirPlace) {
  const Surface s = BezierSurface{{2, 2, {{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}, {}};
  const JetGrid grid = sample_grid(s, 2, 3);
  for (int j = 0; j < 3; ++j) {
    EXPECT_EQ(grid.at(0, j).point, (core::Point3{0, 0, 0}));
    ASSERT_TRUE(frame_of(grid.at(0, j)));
    EXPECT_NEAR(std::abs(frame_of(grid.at(0, j))->normal.z), 1, 1e-15);
  }
  EXPECT_EQ(grid.at(1, 2).point, (core::Point3{0, 1, 0}));
}

TEST(Interrogate, NoNormalNoValueAndNoNonsense) {
  const BezierSurface point{{3, 3, std::vector<core::Point3>(9, {1, 2, 3})}, {}};
  const Field field = field_of(point, FieldKind::zebra);
  for (const double x : field.values) EXPECT_TRUE(std::isnan(x));
  EXPECT_EQ(field.range, (core::Interval{0, 0}));
  const JetGrid grid = sample_grid(crowned_patch(), 3, 3);
  const auto path = [&](FieldKind kind, const Lighting& l) {
    const auto f = interrogate(grid, kind, l);
    return f ? std::string("fine") : f.error().path;
  };
  Lighting l;
  l.view = core::Vector3{};
  EXPECT_EQ(path(FieldKind::zebra, l), "view");
  l = {.light = core::Vector3{NAN, 0, 0}};
  EXPECT_EQ(path(FieldKind::isophote, l), "light");
  l = {.stripe_count = 0};
  EXPECT_EQ(path(FieldKind::zebra, l), "stripe_count");
  l = {.spacing = -1};
  EXPECT_EQ(path(FieldKind::reflection, l), "spacing");
  l = {.view = core::Vector3{0, 0, 1}, .stripes = core::Vector3{0, 0, 2}};
  EXPECT_EQ(path(FieldKind::zebra, l), "fine");
  EXPECT_EQ(path(FieldKind::reflection, l), "stripes");
}

}  // namespace
}  // namespace keyline::surface
