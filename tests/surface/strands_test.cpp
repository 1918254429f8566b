#include "keyline/surface/strands.h"

#include <algorithm>
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

// Steps that ask for the same as the one before, for the same with other weights, and for as much
// of another row or of more: each is the step that a system makes which has made none before.
TEST(StrandSystem, StepsDoNotDependOnThoseBefore) {
  const std::vector<std::vector<std::size_t>> asked{{0}, {0}, {0},          {1},         {0, 1, 5},
                                                    {1}, {},  {0, 1, 2, 3}, {4, 5, 6, 7}};
  Given used;
  Eigen::MatrixX3d x = used.system.given();
  for (Eigen::Index i = 0; i < x.rows(); ++i)
    x.row(i) += 0.05 * Eigen::RowVector3d{std::sin(i), std::cos(2.0 * i), std::sin(3.0 * i)};
  const Eigen::MatrixX3d home = x;
  double most = 0;
  for (std::size_t k = 0; k < asked.size(); ++k) {
    Given fresh;
    for (Given* g : {&used, &fresh}) {
      for (Strand& s : g->system.strands()) s.asked = Asked::nothing;
      for (const std::size_t i : asked[k]) g->system.strands()[i].asked = Asked::one_matrix;
    }
    const std::vector<double> shape(used.system.strands().size(), k == 2 ? 30 : 1);
    const std::vector<double> none(shape.size(), 0);
    Eigen::MatrixX3d expected = x;
    const double way = fresh.system.step(expected, home, 1, {shape, none});
    most = std::max(most, way);
    EXPECT_NEAR(used.system.step(x, home, 1, {shape, none}), way, 1e-12) << k;
    EXPECT_LT((x - expected).norm(), 1e-12) << k;
  }
  EXPECT_GT(most, 0.01);
}

}  // namespace
}  // namespace keyline::surface::detail
