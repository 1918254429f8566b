#include "keyline/surface/strands.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace keyline::surface::detail {
namespace {

/// Rows of four points, each edge the one before turned by a fifth and 1.2 times as long; columns
/// with edges of 2.
BezierSurface turned_rows() {
  BezierSurface s{{4, 4, {}}, {}};
  for (int i = 0; i < 4; ++i) {
    core::Point3 p{0, 0, 2.0 * i};
    for (int j = 0; j < 4; ++j) {
      s.net.points.push_back(p);
      const double size = std::pow(1.2, j);
      p = p + core::Vector3{size * std::cos(0.2 * j), size * std::sin(0.2 * j), 0};
    }
  }
  return s;
}

struct Given {
  std::vector<BezierSurface> patches{turned_rows()};
  StrandSystem system{patches, {}, {std::vector<bool>(16, false)}};
};

// The third edge is off by what its end was moved, told in units of the second, 1.2 long.
TEST(StrandSystem, MisfitIsWhatTheThirdEdgeLacks) {
  Given g;
  Strand row = g.system.strands()[0];
  ASSERT_EQ(row.points, (std::vector<Eigen::Index>{0, 1, 2, 3}));
  Eigen::MatrixX3d x = g.system.given();
  row.asked = Asked::one_matrix;
  EXPECT_NEAR(g.system.misfit(row, x), 0, 1e-14);
  EXPECT_NEAR(g.system.growth(row, x), std::log(1.2), 1e-14);
  x.row(3) += Eigen::RowVector3d{0.03, 0, 0.04};
  EXPECT_NEAR(g.system.misfit(row, x), 0.05 / 1.2, 1e-12);
  row.asked = Asked::nothing;
  EXPECT_EQ(g.system.misfit(row, x), 0);
  row.asked = Asked::plane;
  EXPECT_GT(g.system.misfit(row, x), 1e-3);
  x.row(3) = g.system.given().row(3);
  EXPECT_NEAR(g.system.misfit(row, x), 0, 1e-14);
}

// Steps of Newton's method: what is left is squared each time.
TEST(StrandSystem, StepsComeToOneMatrix) {
  Given g;
  for (Strand& s : g.system.strands()) s.asked = Asked::nothing;
  Strand& row = g.system.strands()[0];
  row.asked = Asked::one_matrix;
  Eigen::MatrixX3d x = g.system.given();
  x.row(1) += Eigen::RowVector3d{0.05, -0.03, 0};
  x.row(3) += Eigen::RowVector3d{-0.04, 0.06, 0.05};
  const Eigen::MatrixX3d home = x;
  const std::vector<double> some(g.system.strands().size(), 1), none(some.size(), 0);
  EXPECT_GT(g.system.misfit(row, x), 0.05);
  for (int i = 0; i < 4; ++i) g.system.step(x, home, 1e-9, {some, none});
  EXPECT_LT(g.system.misfit(row, x), 1e-7);
  EXPECT_LT((x - home).norm(), 0.2);
}

// A straight column with equal edges, drawn away at its end: its last two edges stay equal.
TEST(StrandSystem, StraightStrandsKeepTheirRatios) {
  Given g;
  for (Strand& s : g.system.strands()) s.asked = Asked::nothing;
  Strand& column = g.system.strands()[4];
  ASSERT_EQ(column.points, (std::vector<Eigen::Index>{0, 4, 8, 12}));
  column.asked = Asked::likeness;
  Eigen::MatrixX3d x = g.system.given(), home = x;
  home.row(12) += Eigen::RowVector3d{0.03, 0, 0.04};
  const std::vector<double> some(g.system.strands().size(), 1), none(some.size(), 0);
  for (int i = 0; i < 3; ++i) g.system.step(x, home, 1, {some, none});
  EXPECT_GT((x.row(12) - g.system.given().row(12)).norm(), 0.01);
  EXPECT_LT((x.row(12) - 2 * x.row(8) + x.row(4)).norm(), 1e-6);
}

}  // namespace
}  // namespace keyline::surface::detail
