#include "keyline/surface/joint_rows.h"

#include <cmath>

#include <gtest/gtest.h>

#include "keyline/surface/edit_patches.h"

#include "test_surfaces.h"

namespace keyline::surface::detail {
namespace {

/// A wave, cubic of 11 spans of unequal length, whose rungs are straight, as of a wing.
BSplineSurface ruled_wave() {
  BSplineSurface s;
  s.degree = {3, 1};
  s.net = {14, 2, {}};
  std::vector<double> knots(4, 0.0);
  for (int k = 1; k < 11; ++k) knots.push_back(k + 0.2 * std::sin(2.0 * k));
  knots.insert(knots.end(), 4, 11.0);
  for (int i = 0; i < 14; ++i)
    for (int j = 0; j < 2; ++j)
      s.net.points.push_back(
          {10.0 * i, 100.0 * j, 30 - 0.5 * (i - 6.5) * (i - 6.5) + 0.3 * std::sin(2.0 * i)});
  s.knots = {{knots, {0, 0, 1, 1}}};
  return s;
}

// Derivatives against differences, away from the given net; the edge of one joint is straight.
TEST(JointRows, TellHowTheyChangeWithPointsAndMultipliers) {
  for (const BSplineSurface& s : {four_patches(), ruled_wave()}) {
    const auto patches = to_beziers(s).patches;
    std::vector<HeldJoint> joints;
    for (const PatchJoint& j : joints_of(patches)) joints.push_back({j, 2, false});
    const Eigen::MatrixX3d given = coordinates(patches);
    JointRows rows(joint_equations(patches, joints), given, 1, JointMultipliers::open);
    EXPECT_LT(rows.misfit(given), 1e-9);
    ASSERT_GT(rows.multipliers().size(), 5 * joints.size());
    Eigen::MatrixX3d x = given;
    for (Eigen::Index i = 0; i < x.rows(); ++i) x(i, i % 3) += std::sin(5.0 * i);
    const double h = 1e-6;
    for (std::size_t c = 0; c < rows.count(); c += 3) {
      const JointRow row = rows.at(c, x);
      for (const auto& [m, by] : row.multipliers) {
        const std::vector<double> at = rows.multipliers();
        std::vector<double> more = at;
        more[static_cast<std::size_t>(m)] += h;
        rows.set_multipliers(more);
        const Eigen::RowVector3d ahead = rows.at(c, x).lacks;
        rows.set_multipliers(at);
        EXPECT_LT(((ahead - row.lacks) / h - by).norm(), 1e-4 * (1 + by.norm())) << c;
      }
      for (const auto& [p, by] : row.points) {
        Eigen::MatrixX3d moved = x;
        moved(p, 1) += 1;
        EXPECT_NEAR(rows.at(c, moved).lacks[1] - row.lacks[1], by, 1e-9) << c;
      }
    }
  }
}

// Second derivatives along a straight edge are none; those across it have to be held all the same.
TEST(HoldJoints, CurvatureStaysAcrossStraightEdges) {
  const auto patches = to_beziers(ruled_wave()).patches;
  const auto joints = joints_of(patches);
  ASSERT_EQ(joints.size(), 10U);
  std::vector<HeldJoint> held;
  for (const PatchJoint& j : joints) held.push_back({j, 2, false});
  auto wanted = patches;
  for (std::size_t p = 0; p < wanted.size(); ++p)
    for (std::size_t i = 0; i < 8; ++i) wanted[p].net.points[i].z += std::sin(3.0 * i + 2.0 * p);
  const auto moved = hold_joints(patches, wanted, held);
  EXPECT_GT(std::abs(moved[5].net.points[3].z - patches[5].net.points[3].z), 0.01);
  EXPECT_EQ(measure_joints(joints, moved).order_at_least[2], 10U);
}

// Cubics of one matrix cannot keep the ratios of derivatives across their joints and stay near: a
// curve of common curvature there, and near, exists only with other ratios.
TEST(EditPatches, RatiosAcrossJointsMayChangeAsCurvatureStays) {
  const auto edit = edit_surface(ruled_wave());
  ASSERT_TRUE(edit) << edit.error().message;
  EXPECT_EQ(edit->edited.after.order_at_least[2], 10U);
  EXPECT_EQ(edit->edited.lost, 0U);
  EXPECT_LT(edit->edited.sav_after, 0.8 * edit->edited.sav_before);
}

}  // namespace
}  // namespace keyline::surface::detail
