#include "keyline/surface/edit_patches.h"

#include <cmath>

#include <gtest/gtest.h>

#include "keyline/surface/hold_joints.h"

#include "test_surfaces.h"

namespace keyline::surface {
namespace {

/// Bicubic, two by two patches, waves in its net: smooth joints.
BSplineSurface four_patches() {
  BSplineSurface s;
  s.net = wavy_net(5, 5);
  for (core::Point3& p : s.net.points) p = {40 * p.x, 40 * p.y, 6 * p.z};
  s.knots = {{{0, 0, 0, 0, 0.4, 1, 1, 1, 1}, {0, 0, 0, 0, 2, 3, 3, 3, 3}}};
  return s;
}

TEST(Joints, FindsThePatchesOfASplineTogether) {
  const auto patches = to_beziers(four_patches()).patches;
  const auto joints = joints_of(patches, 1e-6);
  ASSERT_EQ(joints.size(), 4U);
  EXPECT_EQ(joints[0].first, 0U);
  EXPECT_EQ(joints[0].second, 1U);
  EXPECT_EQ(joints[0].edges, (std::array{Edge::v1, Edge::v0}));
  const JointSummary summary = measure_joints(joints, patches);
  EXPECT_EQ(summary.order_at_least[1], 4U);
  EXPECT_LT(summary.gap, 1e-9);
  auto apart = patches;
  for (core::Point3& p : apart[3].net.points) p.z += 0.5;
  EXPECT_EQ(joints_of(apart, 1e-6).size(), 2U);
  const JointSummary torn = measure_joints(joints, apart);
  EXPECT_EQ(torn.order_at_least[0], 2U);
  EXPECT_NEAR(torn.gap, 0.5, 0.1);
}

TEST(Joints, LostOrdersAreThoseThatWereToBeHeld) {
  const auto patches = to_beziers(four_patches()).patches;
  const auto joints = joints_of(patches, 1e-6);
  EXPECT_EQ(lost_orders(joints, patches, patches, 2), 0U);
  auto folded = patches;
  folded[3].net.at(1, 2).z += 0.5;  // beside the edge to patch 1 alone
  EXPECT_EQ(lost_orders(joints, patches, folded, 1), 1U);
  EXPECT_EQ(lost_orders(joints, patches, folded, 0), 0U);
  EXPECT_EQ(lost_orders(joints, folded, folded, 2), 0U);
  auto torn = patches;
  for (core::Point3& p : torn[3].net.points) p.z += 0.5;
  EXPECT_EQ(lost_orders(joints, patches, torn, 0), 2U);
}

TEST(Joints, SecondEdgeMayRunTheOtherWay) {
  const auto [low, high] = halves_u(crowned_patch());
  BezierSurface turned = high;  // v run backwards
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) turned.net.at(i, j) = high.net.at(i, 3 - j);
  EXPECT_EQ(joints_of(std::vector{low, turned}, 1e-6).size(), 1U);
}

TEST(JoinedSurface, IsTheSplineItWasCutFrom) {
  const BSplineSurface s = four_patches();
  const PatchGrid grid = to_beziers(s);
  const auto again = joined(grid, breakpoints_u(s), breakpoints_v(s), 1e-9);
  ASSERT_TRUE(again);
  EXPECT_TRUE(validate(*again));
  EXPECT_EQ(again->net.rows, 7);
  for (const double u : {0.0, 0.3, 0.4, 0.77, 1.0})
    for (const double v : {0.0, 0.5, 0.9})
      EXPECT_LT(distance(evaluate(s, u, v), evaluate(*again, u, v)), 1e-12);
  PatchGrid torn = grid;
  torn.patches[1].net.at(0, 0).z += 1;
  EXPECT_FALSE(joined(torn, breakpoints_u(s), breakpoints_v(s), 1e-9));
  EXPECT_FALSE(joined(grid, {0, 1}, breakpoints_v(s), 1e-9));
}

TEST(EditPatches, BoundaryKeptStaysOneSurface) {
  const BSplineSurface s = four_patches();
  EditOptions options;
  options.keep = Keep::boundary;
  const auto edit = edit_surface(s, options, 1, {}, HoldJoints::free);
  ASSERT_TRUE(edit) << edit.error().message;
  EXPECT_EQ(edit->edited.before.order_at_least[1], 4U);
  EXPECT_EQ(edit->edited.after.order_at_least[0], 4U);
  EXPECT_LT(edit->edited.after.gap, 1e-9);
  ASSERT_TRUE(edit->whole);
  EXPECT_TRUE(std::holds_alternative<BSplineSurface>(*edit->whole));
  double before = 0;
  double after = 0;
  for (const PatchValue& p : values_before(*edit)) before += p.value.sav;
  for (const PatchValue& p : values_after(*edit)) after += p.value.sav;
  EXPECT_LT(after, before);
  EXPECT_GT(edit->edited.departure, 0);
}

TEST(EditPatches, JointsKeptMoveAndStayClosed) {
  const BSplineSurface s = four_patches();
  EditOptions options;
  options.keep = Keep::joints;
  const auto edit = edit_surface(s, options, 1, {}, HoldJoints::free);
  ASSERT_TRUE(edit) << edit.error().message;
  EXPECT_EQ(edit->edited.after.order_at_least[0], 4U);
  EXPECT_LT(edit->edited.after.gap, 1e-9);
  EXPECT_TRUE(edit->whole);
  for (const PatchValue& p : values_after(*edit)) EXPECT_LT(p.value.sav, 150);
}

double largest_jump_of_normals(const BezierSurface& a, const BezierSurface& b) {
  double largest = 0;
  for (int i = 0; i <= 20; ++i) {  // a's edge v = 1 is b's edge v = 0
    const auto normal = [&](const BezierSurface& s, double v) {
      const double h = 1e-6;
      const double u = std::min(i / 20.0, 1 - h);
      const double w = v > 0.5 ? v - h : v;
      const core::Vector3 n = cross(evaluate(s, u + h, v) - evaluate(s, u, v),
                                    evaluate(s, u, w + h) - evaluate(s, u, w));
      return n / norm(n);
    };
    largest = std::max(largest, norm(normal(a, 1) - normal(b, 0)));
  }
  return largest;
}

// Tangent planes stay common and SAV falls; differences of the surfaces themselves say so too.
TEST(EditPatches, JointsHeldStayTangent) {
  const BSplineSurface s = four_patches();
  for (const Keep keep : {Keep::joints, Keep::boundary}) {
    EditOptions options;
    options.keep = keep;
    const auto edit = edit_surface(s, options, 2);
    ASSERT_TRUE(edit) << edit.error().message;
    const PatchesEdit& all = edit->edited;
    EXPECT_EQ(all.before.order_at_least[1], 4U);
    EXPECT_EQ(all.after.order_at_least[1], 4U);
    EXPECT_EQ(all.lost, 0U);
    EXPECT_LT(largest_jump_of_normals(all.surfaces[0], all.surfaces[1]), 1e-4);
    EXPECT_LT(all.sav_after, 0.97 * all.sav_before);
    EXPECT_LT(all.sav_apart, all.sav_after);
    EXPECT_GT(all.departure, 0);
    EXPECT_TRUE(edit->whole);
  }
}

/// The largest difference of a cubic's edge ratios, as complex numbers in the plane of the curve:
/// 0 where it has one control matrix.
double ratio_spread(const std::vector<core::Point3>& c) {
  const auto turn = [](core::Vector3 a, core::Vector3 b) {
    return std::atan2(norm(cross(a, b)), dot(a, b));
  };
  const core::Vector3 e0 = c[1] - c[0];
  const core::Vector3 e1 = c[2] - c[1];
  const core::Vector3 e2 = c[3] - c[2];
  return std::hypot(turn(e0, e1) - turn(e1, e2), norm(e1) / norm(e0) - norm(e2) / norm(e1));
}

// A skin whose sections are not quite translates of one another: its patches' rows and columns can
// be taken to one matrix each, all of them but few, without any joint coming loose.
TEST(EditPatches, CurvesOfJoinedPatchesTakeOneMatrixTogether) {
  BSplineSurface s;
  s.net = {5, 6, {}};
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 6; ++j)
      s.net.points.push_back({i * 240.0, j * 180.0 - 450,
                              80 - 0.00011 * (i * 240 - 900) * (i * 240 - 900) -
                                  7.0 * (j - 2.5) * (j - 2.5) + 0.2 * i * j});
  s.knots = {{{0, 0, 0, 0, 0.5, 1, 1, 1, 1}, {0, 0, 0, 0, 1.0 / 3, 2.0 / 3, 1, 1, 1, 1}}};
  EditOptions options;
  options.keep = Keep::joints;
  const auto edit = edit_surface(s, options, 2);
  ASSERT_TRUE(edit) << edit.error().message;
  const PatchesEdit& all = edit->edited;
  EXPECT_LT(all.sav_after, 0.2 * all.sav_before);
  EXPECT_EQ(all.after.order_at_least[1], 7U);
  EXPECT_LT(largest_jump_of_normals(all.surfaces[0], all.surfaces[1]), 1e-4);
  int of_one_matrix = 0;
  for (const BezierSurface& patch : all.surfaces)
    for (const NetworkCurve& c : network_curves(patch.net))
      of_one_matrix += ratio_spread(c.control) < 2e-6;
  EXPECT_GE(of_one_matrix, 40);  // of 48
  ASSERT_FALSE(all.tradeoff.empty());
  const auto corner = [](const BezierSurface& p) { return p.net.at(0, 0); };
  EXPECT_LT(distance(corner(all.surfaces[0]), s.net.at(0, 0)), 1e-12);
}

TEST(EditPatches, CurvatureIsHeldOnRequest) {
  const BSplineSurface s = four_patches();
  EditOptions options;
  options.keep = Keep::joints;
  const auto edit = edit_surface(s, options, 2, {}, HoldJoints::G2);
  ASSERT_TRUE(edit) << edit.error().message;
  EXPECT_EQ(edit->edited.before.order_at_least[2], 4U);
  EXPECT_EQ(edit->edited.after.order_at_least[2], 4U);
  EXPECT_LT(edit->edited.sav_after, edit->edited.sav_before);
}

TEST(EditPatches, LimitHoldsForPatchesTogether) {
  EditOptions options;
  options.keep = Keep::joints;
  options.limit = 0.5;
  const auto edit = edit_surface(four_patches(), options, 2);
  ASSERT_TRUE(edit) << edit.error().message;
  EXPECT_LE(edit->edited.departure, 0.5);
  EXPECT_EQ(edit->edited.after.order_at_least[1], 4U);
}

// Two surfaces of a file are one problem; the second edge runs the other way.
TEST(EditPatches, SurfacesOfAFileAreHeldTogether) {
  const auto patches = to_beziers(four_patches()).patches;
  BezierSurface turned = patches[1];
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) turned.net.at(i, j) = patches[1].net.at(3 - i, j);
  const std::vector<Surface> surfaces{patches[0], turned};
  EditOptions options;
  options.keep = Keep::joints;
  PatchesEdit together;
  const auto edits = edit_surfaces(surfaces, options, 1, {}, HoldJoints::G1, &together);
  ASSERT_TRUE(edits) << edits.error().message;
  ASSERT_EQ(edits->size(), 2U);
  EXPECT_EQ(together.before.order_at_least[1], 1U);
  EXPECT_EQ(together.after.order_at_least[1], 1U);
  EXPECT_LT(together.sav_after, together.sav_before);
  EXPECT_EQ((*edits)[1].edited.joints.size(), 0U);
}

TEST(HoldJoints, MovesOnePatchWithItsNeighbour) {
  const auto patches = to_beziers(four_patches()).patches;
  const std::vector<BezierSurface> two{patches[0], patches[1]};
  std::vector<BezierSurface> wanted = two;
  for (int i = 0; i < 4; ++i) wanted[0].net.at(i, 3).z += 1;  // the common edge of one alone
  const auto joints = joints_of(two, 1e-6);
  ASSERT_EQ(joints.size(), 1U);
  const auto held = hold_joints(two, wanted, std::vector{HeldJoint{joints[0], 1, false}});
  EXPECT_GT(held[1].net.at(1, 0).z - two[1].net.at(1, 0).z, 0.1);
  EXPECT_EQ(measure_joints(joints, held).order_at_least[1], 1U);
  const auto loose = hold_joints(two, wanted, std::vector{HeldJoint{joints[0], 0, false}});
  EXPECT_EQ(measure_joints(joints, loose).order_at_least[0], 1U);
  EXPECT_EQ(measure_joints(joints, loose).order_at_least[1], 0U);
}

TEST(EditPatches, CurvesInsideKeptJointsHaveOneMatrix) {
  EditOptions options;
  options.keep = Keep::joints;
  const auto r = edit(distorted_patch(), options);
  ASSERT_TRUE(r) << r.error().message;
  EXPECT_GT(r->before.sav, 250);
  EXPECT_LT(r->after.sav, 25);
  EXPECT_EQ(r->target, "one matrix inside");
}

TEST(EditPatches, LessKeptTellsTheGaps) {
  const BSplineSurface s = four_patches();
  EditOptions options;
  options.keep = Keep::start;
  const auto edit = edit_surface(s, options, 2, {}, HoldJoints::free);
  ASSERT_TRUE(edit) << edit.error().message;
  EXPECT_EQ(edit->edited.joints.size(), 4U);
  EXPECT_LT(edit->edited.after.order_at_least[0], 4U);
  EXPECT_GT(edit->edited.after.gap, 0.01);
  EXPECT_FALSE(edit->whole);
  EXPECT_EQ(edit->edited.surfaces.size(), 4U);
}

TEST(EditPatches, OnePatchIsAPatch) {
  const auto edit = edit_surface(distorted_patch());
  ASSERT_TRUE(edit);
  ASSERT_TRUE(edit->whole);
  EXPECT_TRUE(std::holds_alternative<BezierSurface>(*edit->whole));
  EXPECT_LT(edit->edited.patches.front().result->after.sav, 1e-5);
}

TEST(EditPatches, WhatCannotBeEditedStays) {
  BezierSurface collapsed = crowned_patch();
  for (int j = 0; j < 4; ++j) collapsed.net.at(0, j) = collapsed.net.at(0, 0);
  const std::vector<BezierSurface> patches{distorted_patch(), collapsed};
  const auto edit = edit_patches(patches);
  ASSERT_TRUE(edit) << edit.error().message;
  EXPECT_FALSE(edit->patches[1].result);
  EXPECT_FALSE(edit->patches[1].why.message.empty());
  EXPECT_EQ(edit->surfaces[1], collapsed);
  EXPECT_FALSE(edit_patches(std::vector{collapsed}));
  EXPECT_EQ(edit_surface(sphere_octant(1)).error().code, core::ErrorCode::unsupported);
}

}  // namespace
}  // namespace keyline::surface
