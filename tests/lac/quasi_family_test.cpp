#include "keyline/lac/quasi/quasi_family.h"

#include <cmath>

#include <gtest/gtest.h>

#include "keyline/lac/quasi/quasi_search.h"

/// The Bézier polygons among which the best form is looked for.
namespace keyline::lac::detail {
namespace {

using core::Vector2;

// Bernstein's polynomials and their slopes, written out.
TEST(Basis, IsBernsteins) {
  const Basis b(3, 0.25);
  const double t = 0.25, u = 0.75;
  const std::vector<double> value{u * u * u, 3 * t * u * u, 3 * t * t * u, t * t * t};
  const std::vector<double> slope{-3 * u * u, 3 * u * u - 6 * t * u, 6 * t * u - 3 * t * t,
                                  3 * t * t};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(b.value[i], value[i], 1e-15);
    EXPECT_NEAR(b.slope[i], slope[i], 1e-15);
  }
  double all = 0, turned = 0;
  const Basis high(20, 0.37);
  for (std::size_t i = 0; i <= 20; ++i) {
    all += high.value[i];
    turned += high.slope[i];
  }
  EXPECT_NEAR(all, 1, 1e-14);
  EXPECT_NEAR(turned, 0, 1e-12);
  EXPECT_EQ(combine(b.value, {{1, 0}, {1, 0}, {1, 0}, {1, 2}}).y, 2 * t * t * t);
}

Eigen::VectorXd some(int n) {
  Eigen::VectorXd x(n);
  for (int i = 0; i < n; ++i) x[i] = 0.15 + 0.03 * i;
  return x;
}

// Whatever the unknowns: ends, tangents and, where held, curvatures are the piece's.
TEST(QuasiFamily, KeepsEndsTangentsAndCurvatures) {
  const UnitPiece unit = unit_piece({0.5, 1, 0.6, 1.8});
  const Vector2 end = displacement(unit.piece, 1);
  for (const bool held : {false, true})
    for (const int degree : {5, 7}) {
      const Family family(unit, degree, held);
      EXPECT_EQ(family.unknowns(), 4 + 2 * (degree - 5) + (held ? 0 : 2));
      const ControlPolygon b = family.polygon(some(family.unknowns()));
      ASSERT_EQ(b.size(), static_cast<std::size_t>(degree) + 1);
      EXPECT_EQ(b[0], (Vector2{0, 0}));
      EXPECT_NEAR(core::norm(b.back() - end), 0, 1e-15);
      EXPECT_EQ(b[1].y, 0);
      EXPECT_GT(b[1].x, 0);
      const Vector2 last = b[degree] - b[degree - 1];
      EXPECT_NEAR(std::atan2(last.y, last.x), unit.turning, 1e-14);
      if (!held) continue;
      // Curvature at an end of a Bézier: (n - 1) / n of the second edge's height over the first's
      // square.
      const double share = (degree - 1.0) / degree;
      EXPECT_NEAR(share * core::cross(b[1] - b[0], b[2] - b[1]) / std::pow(core::norm(b[1]), 3),
                  0.6, 1e-13);
      const Vector2 before = b[degree - 1] - b[degree - 2];
      EXPECT_NEAR(share * core::cross(before, last) / std::pow(core::norm(last), 3), 1.8, 1e-12);
    }
}

TEST(QuasiFamily, ChangesAreDifferences) {
  const UnitPiece unit = unit_piece({0.5, 1, 0.6, 1.8});
  for (const bool held : {false, true})
    for (const int degree : {5, 8}) {
      const Family family(unit, degree, held);
      const Eigen::VectorXd x = some(family.unknowns());
      const Basis basis(degree, 0.4);
      for (int k = 0; k < family.unknowns(); ++k) {
        constexpr double h = 1e-6;
        Eigen::VectorXd up = x, down = x;
        up[k] += h;
        down[k] -= h;
        const Vector2 by = (combine(basis.value, family.polygon(up)) -
                            combine(basis.value, family.polygon(down))) /
                           (2 * h);
        EXPECT_NEAR(core::norm(family.change(x, basis.value, k) - by), 0, 1e-9) << k;
      }
    }
}

// A polygon of the family is its own nearest, and is found by least squares from its points.
TEST(QuasiFamily, FindsItsOwnMembers) {
  const UnitPiece unit = unit_piece({0.5, 1, 0.6, 1.8});
  for (const bool held : {false, true}) {
    const Family family(unit, 7, held);
    Eigen::VectorXd x = some(family.unknowns());
    const ControlPolygon b = family.polygon(x);
    const Eigen::VectorXd nearest = family.nearest(b);
    for (int k = 0; k < x.size(); ++k) EXPECT_NEAR(nearest[k], x[k], 1e-13) << k;
    // Moved as a whole and stretched at the end, what is missed is spread over it.
    ControlPolygon moved = b;
    for (std::size_t i = 0; i < moved.size(); ++i)
      moved[i] = moved[i] + Vector2{1, 2} - double(i) / 7 * Vector2{0.03, -0.01};
    const Eigen::VectorXd same = family.nearest(moved);
    for (int k = 0; k < x.size(); ++k) EXPECT_NEAR(same[k], x[k], 1e-13) << k;
    std::vector<double> at;
    std::vector<Vector2> points;
    for (int i = 1; i < 30; ++i) {
      at.push_back(i / 30.0);
      points.push_back(combine(Basis(7, at.back()).value, b));
    }
    double miss = 1;
    const Eigen::VectorXd found = family.start(x[0], x[2], at, points, miss);
    EXPECT_LT(miss, 1e-13);
    for (int k = 0; k < x.size(); ++k) EXPECT_NEAR(found[k], x[k], 1e-9) << k;
    for (Vector2& p : points) p.y += 0.01;
    family.start(x[0], x[2], at, points, miss);
    EXPECT_GT(miss, 1e-4);
    EXPECT_LT(miss, 0.01);
  }
}

// ---- The search's piece and miss -------------------------------------------------------------

TEST(HandleSearch, PieceHasItsTurningAndRatio) {
  for (const double alpha : {-1.0, 0.5, 2.0})
    for (const Unknowns& x : {Unknowns{0.7, 1.2}, {-0.7, 1.2}, {0, 2}}) {
      const UnitPiece unit = piece_from(alpha, x);
      EXPECT_NEAR(unit.turning, x.turning, 1e-14);
      EXPECT_NEAR(std::log(unit.piece.curvature_start / unit.piece.curvature_end), x.log_ratio,
                  1e-14);
      EXPECT_EQ(unit.length, 1);
    }
  EXPECT_EQ((Miss{-3, 2}.size()), 3);
  EXPECT_EQ((Miss{1, -2}.size()), 2);
}

}  // namespace
}  // namespace keyline::lac::detail
