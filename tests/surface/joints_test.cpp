#include "keyline/surface/joints.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "keyline/surface/hold_joints.h"
#include "keyline/surface/turn_over.h"

#include "test_surfaces.h"

namespace keyline::surface {
namespace {

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

// What patches share does not depend on the unit they are measured in.
TEST(Joints, SmallPatchesAreJoinedAsLargeOnesAre) {
  const auto patches = to_beziers(four_patches()).patches;
  const auto joints = joints_of(patches, 0.01);
  for (const double scale : {1e-2, 1e-4, 1e-6}) {
    SCOPED_TRACE(scale);
    auto small = patches;
    for (BezierSurface& s : small)
      for (core::Point3& p : s.net.points) p = {scale * p.x, scale * p.y, scale * p.z};
    const auto found = joints_of(small, 0.01);
    ASSERT_EQ(found.size(), joints.size());
    for (std::size_t i = 0; i < joints.size(); ++i) {
      EXPECT_EQ(found[i].first, joints[i].first);
      EXPECT_EQ(found[i].second, joints[i].second);
      EXPECT_EQ(found[i].edges, joints[i].edges);
    }
  }
}

/// A flat rectangle [x0, x1] by [0, 10] at height z.
BezierSurface rectangle(double x0, double x1, double z) {
  return {{2, 2, {{x0, 0, z}, {x0, 10, z}, {x1, 0, z}, {x1, 10, z}}}, {}};
}

// Two thin sheets of two narrow patches each, nearer to one another than the gap that is allowed:
// each joins what goes on beside it, and the free ends that lie opposite are one joint with a gap.
TEST(Joints, ThinSheetsAreNotJoinedAcross) {
  const std::vector<BezierSurface> sheets{rectangle(0, 1, 0), rectangle(1, 2, 0),
                                          rectangle(0, 1, 0.2), rectangle(1, 2, 0.2)};
  const auto joints = joints_of(sheets, 0.3);
  const auto is_joint = [&](std::size_t i, std::size_t k) {
    return std::ranges::count_if(
        joints, [&](const PatchJoint& j) { return j.first == i && j.second == k; });
  };
  EXPECT_EQ(is_joint(0, 1), 1);
  EXPECT_EQ(is_joint(2, 3), 1);
  for (const PatchJoint& j : joints) {
    const bool across = j.first + 2 == j.second;
    EXPECT_TRUE(across || j.first + 1 == j.second);
    EXPECT_FALSE(across && j.edges[0] == (j.first == 0 ? Edge::u1 : Edge::u0));
  }
  EXPECT_EQ(joints_of(sheets, 0.1).size(), 2U);
}

TEST(Joints, ShortEdgesJoinAndCollapsedOnesDoNot) {
  // Strips of 0.002 by 10, whose short edges (the gap allowed is 0.01) lie end to end.
  const auto strip = [](double y0, double y1) {
    return BezierSurface{{2, 2, {{0, y0, 0}, {0, y1, 0}, {0.002, y0, 0}, {0.002, y1, 0}}}, {}};
  };
  const auto joints = joints_of(std::vector{strip(0, 10), strip(10, 20)}, 0.01);
  ASSERT_EQ(joints.size(), 1U);
  EXPECT_EQ(joints[0].edges, (std::array{Edge::v1, Edge::v0}));
  const BezierSurface cap = sphere_octant(1);  // the pole is no joint of the cap with its mirror
  BezierSurface other = cap;
  for (core::Point3& p : other.net.points) p.x = -p.x;
  const auto meeting = joints_of(std::vector{cap, other}, 0.01);
  ASSERT_EQ(meeting.size(), 1U);
  EXPECT_EQ(meeting[0].edges, (std::array{Edge::u1, Edge::u1}));
}

TEST(Joints, GrowthOfAFoldIsWhatItGrewBy) {
  const auto tilted = [](double fold) {
    return std::vector<BezierSurface>{{{2, 2, {{-1, 0, 0}, {-1, 1, 0}, {0, 0, 0}, {0, 1, 0}}}, {}},
                                      {{2,
                                        2,
                                        {{0, 0, 0},
                                         {0, 1, 0},
                                         {std::cos(fold), 0, std::sin(fold)},
                                         {std::cos(fold), 1, std::sin(fold)}}},
                                       {}}};
  };
  const auto joints = joints_of(tilted(0), 1e-6);
  ASSERT_EQ(joints.size(), 1U);
  EXPECT_NEAR(fold_growth(joints, tilted(0.1), tilted(0.3)), 0.2, 1e-12);
  EXPECT_EQ(fold_growth(joints, tilted(0.3), tilted(0.1)), 0);
}

TEST(TurnOver, IsANormalThatPointsTheOtherWay) {
  const auto turned = [](double angle) {  // about the y axis
    return BezierSurface{{2,
                          2,
                          {{0, 0, 0},
                           {0, 1, 0},
                           {std::cos(angle), 0, std::sin(angle)},
                           {std::cos(angle), 1, std::sin(angle)}}},
                         {}};
  };
  EXPECT_FALSE(turns_over(turned(0), turned(1.56)));
  EXPECT_TRUE(turns_over(turned(0), turned(1.58)));
  EXPECT_FALSE(turns_over(turned(2), turned(1)));
  BezierSurface folded = crowned_patch();  // one inner point is drawn across the whole patch
  folded.net.at(1, 1).x += 900;
  EXPECT_TRUE(turns_over(crowned_patch(), folded));
  EXPECT_FALSE(turns_over(folded, folded));
}

TEST(HoldJoints, PointsThatWereOneAreOneAgain) {
  const auto patches = to_beziers(four_patches()).patches;
  std::vector<HeldJoint> held;
  for (const PatchJoint& joint : joints_of(patches, 1e-6)) held.push_back({joint, 1, false});
  std::vector<BezierSurface> moved = patches;
  double by = 1e-9;
  for (BezierSurface& s : moved)
    for (core::Point3& p : s.net.points) p.x += by += 1e-10;
  close_joints(patches, held, moved);
  EXPECT_EQ(moved[0].net.at(3, 3), moved[3].net.at(0, 0));
  EXPECT_EQ(moved[1].net.at(3, 0), moved[3].net.at(0, 0));
  EXPECT_EQ(moved[0].net.at(1, 3), moved[1].net.at(1, 0));
  EXPECT_NE(moved[0].net.at(1, 2), patches[0].net.at(1, 2));
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

// What joins does not hang on the unit: patches a hundred thousandth of all apart are joined, those
// a thousandth apart are not found.
TEST(Joints, AreFoundInEveryUnitTheSame) {
  for (const double unit : {1.0, 1e-3, 1e3}) {
    SCOPED_TRACE(unit);
    const auto three = [unit](double gap) {
      std::vector<BezierSurface> patches;
      for (int i = 0; i < 3; ++i) {
        BezierSurface s{{2, 2, {{0, 0, 0}, {0, 100, 0}, {100, 0, 0}, {100, 100, 0}}}, {}};
        for (auto& p : s.net.points) p = {unit * (p.x + (100 + gap) * i), unit * p.y, 0};
        patches.push_back(s);
      }
      return patches;
    };
    const auto patches = three(0.002);
    const EdgeTolerance joined = with_gap({}, patches);
    const auto joints = joints_of(patches, joined);
    ASSERT_EQ(joints.size(), 2U);
    EXPECT_EQ(measure_joints(joints, patches, joined).order_at_least[0], 2U);
    EXPECT_TRUE(joints_of(three(0.3), with_gap({}, three(0.3))).empty());
  }
}

}  // namespace
}  // namespace keyline::surface
