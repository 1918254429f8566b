#include "keyline/surface/edit_patches.h"

#include <cmath>

#include <gtest/gtest.h>

#include "test_surfaces.h"

namespace keyline::surface {
namespace {

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
    const auto edit = edit_surface(s, options, 2, {}, HoldJoints::g1);
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

// The right half bent down along the joint, the same everywhere: a crease of about a degree, and
// two tangent joints that go through it.
TEST(EditPatches, CreasesGrowNoSharper) {
  std::vector<BezierSurface> patches = to_beziers(four_patches()).patches;
  for (const std::size_t i : {1U, 3U})
    for (int row = 0; row < 4; ++row)
      for (int column = 0; column < 4; ++column) patches[i].net.at(row, column).z -= 0.3 * column;
  EditOptions options;
  options.keep = Keep::joints;
  const auto all = edit_patches(patches, options, 2);
  ASSERT_TRUE(all) << all.error().message;
  EXPECT_EQ(all->before.order_at_least[0], 4U);
  EXPECT_EQ(all->before.order_at_least[1], 2U);
  EXPECT_GT(all->before.angle, 0.01);
  EXPECT_EQ(all->after.order_at_least[0], 4U);
  EXPECT_GE(all->after.order_at_least[1], 2U);
  EXPECT_EQ(all->lost, 0U);
  EXPECT_LT(all->fold_growth, EdgeTolerance{}.angle);
  for (const std::size_t i : {0U, 2U})
    EXPECT_LT(largest_jump_of_normals(all->surfaces[i], all->surfaces[i + 1]),
              largest_jump_of_normals(patches[i], patches[i + 1]) + EdgeTolerance{}.angle);
  EXPECT_LT(all->sav_after, 0.97 * all->sav_before);
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
  const auto edit = edit_surface(s, options, 2, {}, HoldJoints::g2);
  ASSERT_TRUE(edit) << edit.error().message;
  EXPECT_EQ(edit->edited.before.order_at_least[2], 4U);
  EXPECT_EQ(edit->edited.after.order_at_least[2], 4U);
  EXPECT_LT(edit->edited.sav_after, edit->edited.sav_before);
}

// The right half bent up from the joint on, so that curvature jumps there and tangent planes do
// not: held as they are, no stripe turns farther; with G1 asked for, some do.
TEST(EditPatches, StripesTurnNoFartherUnlessAskedFor) {
  std::vector<BezierSurface> patches = to_beziers(four_patches()).patches;
  for (const std::size_t i : {1U, 3U})
    for (int row = 0; row < 4; ++row)
      for (const int column : {2, 3}) patches[i].net.at(row, column).z += 4.0 * (column - 1);
  EditOptions options;
  options.keep = Keep::joints;
  const auto held = edit_patches(patches, options, 2);
  ASSERT_TRUE(held) << held.error().message;
  EXPECT_EQ(held->before.order_at_least[1], 4U);
  EXPECT_EQ(held->before.order_at_least[2], 2U);
  EXPECT_GT(held->before.zebra.turn, 0.02);
  EXPECT_EQ(held->after.order_at_least[1], 4U);
  EXPECT_EQ(held->after.order_at_least[2], 2U);
  EXPECT_EQ(held->turned, 0U);
  EXPECT_LT(held->after.zebra.turn, held->before.zebra.turn + 0.005);
  EXPECT_LT(held->sav_after, held->sav_before);
  const auto tangent = edit_patches(patches, options, 2, {}, HoldJoints::g1);
  ASSERT_TRUE(tangent) << tangent.error().message;
  EXPECT_EQ(tangent->after.order_at_least[1], 4U);
  EXPECT_GT(tangent->turned, 0U);
  const auto was = joint_states(tangent->joints, patches);
  const auto is = joint_states(tangent->joints, tangent->surfaces);
  double farther = 0;
  for (std::size_t i = 0; i < was.size(); ++i)
    farther = std::max(farther, is[i].turn - was[i].turn);
  EXPECT_GT(farther, 0.02);
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
  const auto edits = edit_surfaces(surfaces, options, 1, {}, HoldJoints::g1, &together);
  ASSERT_TRUE(edits) << edits.error().message;
  ASSERT_EQ(edits->size(), 2U);
  EXPECT_EQ(together.before.order_at_least[1], 1U);
  EXPECT_EQ(together.after.order_at_least[1], 1U);
  EXPECT_LT(together.sav_after, together.sav_before);
  EXPECT_EQ((*edits)[1].edited.joints.size(), 0U);
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

/// A quarter of a cylinder about y, and a bent cubic patch that goes on from its edge
/// z = 1, whose points lie off it by rounding.
std::vector<Surface> cylinder_and_more() {
  const double w = std::sqrt(0.5);
  BezierSurface round;
  round.net.rows = 3;
  round.net.columns = 2;
  round.net.points = {{1, 0, 0}, {1, 1, 0}, {1, 0, 1}, {1, 1, 1}, {0, 0, 1}, {0, 1, 1}};
  round.weights = {1, 1, w, w, 1, 1};
  BezierSurface bent;
  bent.net.rows = 4;
  bent.net.columns = 2;
  for (const core::Point3 p : {core::Point3{0, 0, 1}, {-0.3, 0, 1.1}, {-1, 0, 1.2}, {-2, 0, 0.7}})
    for (const double y : {0.0, 1 + 1e-14}) bent.net.points.push_back({p.x, y, p.z - 1e-14});
  for (BezierSurface* s : {&round, &bent})
    for (core::Point3& p : s->net.points) p = {1.1 * p.x + 0.37, 1.1 * p.y, 1.1 * p.z + 0.7};
  return {round, bent};
}

TEST(EditPatches, RationalOnesStayToTheBit) {
  const auto given = cylinder_and_more();
  EditOptions near;
  near.limit = 1e-3;
  for (const EditOptions& options : {EditOptions{}, near}) {
    const auto edits = edit_surfaces(given, options, 1, {}, HoldJoints::g1);
    ASSERT_TRUE(edits) << edits.error().message;
    EXPECT_EQ(edits->at(0).edited.surfaces.at(0), std::get<BezierSurface>(given[0]));
    EXPECT_FALSE(edits->at(0).edited.patches.at(0).result);
    if (!options.limit) {
      EXPECT_NE(edits->at(1).edited.surfaces.at(0), std::get<BezierSurface>(given[1]));
    }
  }
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
