#include "keyline/lac/cad/cad_cubic.h"

#include <cmath>
#include <random>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "keyline/lac/segment/segment.h"

namespace keyline::lac::detail {
namespace {

using core::Vector2;

/// (C' x C''')(C' . C') - 3 (C' x C'')(C' . C'') at t, of the derivatives as they are defined.
double rate_numerator(const Cubic& c, double t) {
  const auto& b = c.control;
  const Vector2 third = 6 * (b[3] - 3 * b[2] + 3 * b[1] - b[0]);
  const Vector2 second = 6 * (b[2] - 2 * b[1] + b[0]) + t * third;
  const Vector2 first = 3 * (b[1] - b[0]) + 6 * t * (b[2] - 2 * b[1] + b[0]) + t * t / 2 * third;
  return cross(first, third) * dot(first, first) - 3 * cross(first, second) * dot(first, second);
}

/// The coefficients of Bernstein's basis of degree 5 that six values of it have.
Eigen::VectorXd coefficients_by_values(const Cubic& c) {
  Eigen::MatrixXd basis(6, 6);
  Eigen::VectorXd values(6);
  for (int i = 0; i < 6; ++i) {
    const double t = 0.5 - 0.5 * std::cos(3.14159265358979 * (i + 0.5) / 6);
    values[i] = rate_numerator(c, t);
    double choose = 1;
    for (int k = 0; k < 6; ++k) {
      basis(i, k) = choose * std::pow(t, k) * std::pow(1 - t, 5 - k);
      choose *= (5.0 - k) / (k + 1);
    }
  }
  return basis.fullPivLu().solve(values);
}

// Nielsen's spiral, whose curvature falls to a 272th: entire, so that a series of degree 12 serves
// a tenth of it to 1e-12 and no stretch has to be a straight line.
TEST(CadCubic, SeriesServeWhereCurvatureFallsFar) {
  const Piece piece{0, 1, 7.710393604050716, 0.028326324476182968};
  const SeriesTable table(unit_piece(piece), 3e-13);
  EXPECT_LE(table.stretches().size(), 16u);
  for (double v = 0; v <= 1; v += 0.01)
    EXPECT_LT(norm(table.point(v) - exact_frame(unit_piece(piece), v).point), 1e-12);
}

// The coefficients found from six values of the numerator, whose signs are plain in nearly all of
// four thousand cubics.
TEST(CadCubic, PlainlyMonotoneIsWhereCoefficientsHaveOneSign) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(-1, 1);
  int yes = 0, no = 0;
  for (int n = 0; n < 4000; ++n) {
    const double a = 0.3 + 0.1 * std::abs(unit(random)), b = 0.3 + 0.1 * std::abs(unit(random));
    const double first = 0.6 * unit(random), last = first * (1 + 2 * unit(random));
    const Vector2 end{1, 0};
    const Cubic c{{Vector2{0, 0}, a * Vector2{std::cos(first), std::sin(first)},
                   end - b * Vector2{std::cos(last), -std::sin(last)}, end}};
    const Eigen::VectorXd k = coefficients_by_values(c);
    const double clear = 1e-9 * k.lpNorm<Eigen::Infinity>();
    if (k.cwiseAbs().minCoeff() < clear) continue;
    const bool one_sign = k.minCoeff() > 0 || k.maxCoeff() < 0;
    ASSERT_EQ(plainly_monotone(c), one_sign) << n << '\n' << k;
    ++(one_sign ? yes : no);
  }
  EXPECT_GT(yes, 300);
  EXPECT_GT(no, 300);
}

}  // namespace
}  // namespace keyline::lac::detail
