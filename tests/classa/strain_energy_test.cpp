#include "keyline/classa/strain_energy.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "keyline/core/angle.h"
#include "keyline/curve/bspline.h"
#include "keyline/numeric/random.h"

namespace keyline::classa {
namespace {

/// Arc of a circle, exactly: radius r, the angle as parameter.
struct Arc {
  double radius, angle;
};
core::Point2 evaluate(const Arc& c, double t) {
  return {c.radius * std::sin(c.angle * t), c.radius * (1 - std::cos(c.angle * t))};
}
curve::Jet2 jet(const Arc& c, double t) {
  const double a = c.angle;
  const core::Vector2 u = core::unit_vector(a * t);
  const core::Vector2 n = core::perpendicular_left(u);
  return {evaluate(c, t), c.radius * a * u, c.radius * a * a * n, -c.radius * a * a * a * u};
}
std::vector<double> breakpoints(const Arc&) { return {0, 1}; }

TEST(StrainEnergy, OfAnArcIsItsAngleOverItsRadius) {
  for (const double angle : {0.01, 1.0, 5.0})
    EXPECT_NEAR(strain_energy(Arc{2.5, angle}), angle / 2.5, 1e-14 * angle);
  // The same arc as a rational Bezier curve.
  const double half = 0.6;
  const curve::Bezier2 rational{
      {{0, 0}, {std::tan(half), 0}, {std::sin(2 * half), 1 - std::cos(2 * half)}},
      {1, std::cos(half), 1}};
  EXPECT_NEAR(strain_energy(rational), 2 * half, 1e-12);
}

/// y = x^2/2 over [-a, b]: the integral of (1+x^2)^(-5/2) is x(2x^2+3)/(3(1+x^2)^(3/2)).
TEST(StrainEnergy, Parabola) {
  const auto primitive = [](double x) {
    return x * (2 * x * x + 3) / (3 * std::pow(1 + x * x, 1.5));
  };
  for (const double a : {0.1, 3.0, 1000.0}) {
    const curve::Bezier2 c{{{-a, a * a / 2}, {0.5 - a / 2, -a / 2}, {1, 0.5}}, {}};
    const double expected = primitive(1) - primitive(-a);
    EXPECT_NEAR(strain_energy(c), expected, 1e-10 * expected) << a;
  }
}

/// From mpmath.quad with 40 digits of Eq. 7, tests/classa/energies.py.
TEST(StrainEnergy, ThirtyDigitQuadrature) {
  struct Case {
    curve::Bezier2 curve;
    double energy;
  };
  const Case cases[] = {
      {{{{0, 0}, {1, 0}, {2, 1}, {2.5, 3}}, {}}, 0.55291489308654306844},
      {{{{0, 0}, {1, 2}, {0, 3}, {-2, 3.5}, {-4, 2}}, {}}, 1.2617983861221356441},
      {{{{0, 0}, {3, 0.01}, {0.02, 0.03}, {3, 0.05}}, {}}, 474.81008000604137712},
      {{{{0, 0}, {1, 0}, {2, 1}, {3, 1}}, {}}, 0.39190905232090172316},
      {{{{-1, 5}, {0, 5.5}, {1.5, 5}, {2, 3}, {3, 2.9}, {4, 2.5}, {5, 0}}, {}},
       0.71151269885839896195},
  };
  for (const Case& c : cases)
    EXPECT_NEAR(strain_energy(c.curve), c.energy, 1e-10 * c.energy) << c.energy;
}

TEST(StrainEnergy, MatrixFormEqualsQuadrature) {
  numeric::Random random(11);
  for (int i = 0; i < 200; ++i) {
    MatrixCurve c{{1, 2}, {1, -2}, random.uniform(0.1, 4), {}, 2};
    c.matrix = {random.uniform(-1.5, 1.5), random.uniform(0.4, 3)};
    c.degree = 2 + static_cast<int>(random.index(8));
    const double direct = strain_energy(to_bezier(c));
    EXPECT_NEAR(strain_energy(c), direct, 1e-10 * direct) << i;
  }
}

TEST(StrainEnergy, RatesAreDerivatives) {
  numeric::Random random(12);
  for (int i = 0; i < 100; ++i) {
    const ControlMatrix m{random.uniform(0.01, 1.4), random.uniform(0.5, 3)};
    const int degree = 2 + static_cast<int>(random.index(9));
    const double h = 1e-5 * m.alpha;
    const auto log_energy = [&](double alpha, double s) {
      return std::log(matrix_energy({alpha, s}, degree).value);
    };
    const MatrixEnergy e = matrix_energy(m, degree);
    const double by_alpha = (log_energy(m.alpha + h, m.s) - log_energy(m.alpha - h, m.s)) / (2 * h);
    const double by_s = (log_energy(m.alpha, m.s + h) - log_energy(m.alpha, m.s - h)) / (2 * h);
    EXPECT_NEAR(e.log_by_alpha, by_alpha, 1e-6 / m.alpha);
    EXPECT_NEAR(e.log_by_s, by_s, 1e-6 / m.alpha);
  }
}

TEST(StrainEnergy, StraightPointLikeAndCusped) {
  EXPECT_EQ(strain_energy(curve::Bezier2{{{0, 0}, {1, 3}, {3, 9}, {4, 12}}, {}}), 0);
  EXPECT_EQ(strain_energy(curve::Bezier2{{{0.1, 0.3}, {0.2, 0.6}, {0.7, 2.1}}, {}}), 0);
  EXPECT_EQ(strain_energy(curve::Bezier2{{{2, 3}, {2, 3}, {2, 3}}, {}}), 0);
  EXPECT_EQ(strain_energy(MatrixCurve{{0, 0}, {1, 2}, 1, {0, 3}, 5}), 0);
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(strain_energy(curve::Bezier2{{{0, 0}, {0, 0}, {1, 0}, {1, 1}}, {}}), infinity);
  EXPECT_EQ(strain_energy(curve::Bezier2{{{0, 0}, {1, 1}, {0, 1}, {1, 0}}, {}}), infinity);
}

/// A spline is its Bezier pieces.
TEST(StrainEnergy, OfASplineIsThatOfItsBeziers) {
  const curve::BSpline2 spline{
      3, {0, 0, 0, 0, 0.4, 1, 1, 1, 1}, {{0, 0}, {1, 0}, {2, 1}, {2, 3}, {1, 4}}, {}};
  double sum = 0;
  for (const auto& piece : curve::to_beziers(spline)) sum += strain_energy(piece);
  EXPECT_NEAR(strain_energy(spline), sum, 1e-10 * sum);
}

}  // namespace
}  // namespace keyline::classa
