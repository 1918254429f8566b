#include "keyline/numeric/power_mean.h"

#include <cmath>
#include <limits>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <gtest/gtest.h>

#include "keyline/numeric/quadrature.h"
#include "keyline/numeric/roots.h"

namespace keyline::numeric {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The geometric mean of values whose ratio no double holds.
TEST(PowerMean, RatiosMayBeAnySize) {
  EXPECT_NEAR(power_mean(1e-200, 1e200, 0, 0.5), 1, 1e-12);
  EXPECT_NEAR(power_mean(1e200, 1e-200, 0, 0.5), 1, 1e-12);
}

// The arithmetic mean with an end of 0 is a straight line: half of base times height.
TEST(PowerMean, IntegralOfALineFromZero) {
  EXPECT_NEAR(power_mean_integral(0, 3, 1, 0.5), 0.375, 1e-15);
  EXPECT_NEAR(power_mean_integral(3, 0, 1, 0.5), 1.125, 1e-15);
  EXPECT_NEAR(power_mean_integral(0, 3, 0.5, 1), 1, 1e-15);  // of slope 1/2: 3 u^2
}

TEST(PowerMean, KnownMeans) {
  EXPECT_NEAR(power_mean(1, 4, 1, 0.5), 2.5, 1e-15);
  EXPECT_NEAR(power_mean(1, 4, 0, 0.5), 2.0, 1e-15);
  EXPECT_NEAR(power_mean(1, 4, -1, 0.5), 1.6, 1e-15);
  EXPECT_NEAR(power_mean(1, 4, 2, 0.5), std::sqrt(8.5), 1e-15);
  EXPECT_EQ(power_mean(3, 3, 7, 0.3), 3);
}

TEST(PowerMean, LosesNothingNearTheGeometricMean) {
  for (const double p : {1e-12, -1e-12, 1e-15, 1e-300, 1e-308}) {
    EXPECT_NEAR(power_mean(2, 18, p, 0.5), 6, 5e-11 * std::fmin(1, std::abs(p) * 1e12) + 1e-14)
        << p;
  }
  // First order in p: ln M_p = ln M_0 + p u (1-u) ln(b/a)^2 / 2.
  const double p = 1e-7;
  const double l = std::log(9.0);
  EXPECT_NEAR(power_mean(2, 18, p, 0.25), 2 * std::exp(0.25 * l + p * 0.1875 * l * l / 2), 1e-13);
}

TEST(PowerMean, EndsAtZeroAndInfinity) {
  EXPECT_NEAR(power_mean(1, 0, 1, 0.25), 0.75, 1e-16);
  EXPECT_NEAR(power_mean(0, 2, 2, 0.25), 1, 1e-15);
  EXPECT_NEAR(power_mean(kInfinity, 2, -1, 0.25), 8, 1e-15);
  EXPECT_NEAR(power_mean(2, kInfinity, -2, 0.75), 4, 1e-15);
  EXPECT_EQ(power_mean(1, 0, -1, 0.5), 0);
  EXPECT_EQ(power_mean(1, 0, 0, 0.5), 0);
  EXPECT_EQ(power_mean(1, kInfinity, 1, 0.5), kInfinity);
}

TEST(PowerMean, SurvivesLargeExponents) {
  EXPECT_NEAR(power_mean(1, 5, 1000, 0.5), 5 * std::pow(0.5, 1e-3), 1e-13);
  EXPECT_NEAR(power_mean(1, 5, -1000, 0.5), std::pow(0.5, -1e-3), 1e-13);
  EXPECT_NEAR(power_mean_integral(1, 5, 1000, 1), 5 * 1000 / 1001.0, 1e-12);
}

TEST(PowerMean, SignedCrossesZero) {
  EXPECT_NEAR(signed_power_mean(-1, 3, 1, 0.5), 1, 1e-15);
  EXPECT_NEAR(signed_power_mean(-2, 2, 3, 0.5), 0, 1e-15);
  EXPECT_NEAR(signed_power_mean(-1, -3, 1, 0.5), -2, 1e-15);
}

TEST(PowerMeanIntegral, AgreesWithQuadrature) {
  for (const double p :
       {-7.0, -2.0, -1.0, -1 - 1e-13, -0.5, -1e-13, 0.0, 1e-13, 0.3, 1.0, 2.0, 9.0}) {
    for (const double b : {0.6, 0.9999999, 1.0000001, 2.0}) {
      for (const double u : {0.1, 0.5, 1.0}) {
        const auto f = [&](double v) { return power_mean(1, b, p, v); };
        const double expected =
            boost::math::quadrature::gauss_kronrod<double, 15>::integrate(f, 0.0, u, 15, 1e-13);
        EXPECT_NEAR(power_mean_integral(1, b, p, u), expected, 2e-14 * expected) << p << ' ' << b;
      }
    }
  }
}

TEST(PowerMeanIntegral, SingularEnds) {
  EXPECT_NEAR(power_mean_integral(1, 0, 1, 0.5), 0.375, 1e-16);        // 1 - v
  EXPECT_NEAR(power_mean_integral(0, 1, 2, 1), 2.0 / 3, 1e-15);        // sqrt(v)
  EXPECT_NEAR(power_mean_integral(kInfinity, 1, -2, 0.25), 1, 1e-15);  // 1 / sqrt(v)
  EXPECT_NEAR(power_mean_integral(1, kInfinity, -2, 1), 2, 1e-15);
  EXPECT_EQ(power_mean_integral(1, kInfinity, -1, 1), kInfinity);
  EXPECT_NEAR(signed_power_mean_integral(-1, 1, 3, 1), 0, 1e-16);
  EXPECT_NEAR(signed_power_mean_integral(-1, 3, 1, 1), 1, 1e-15);
}

// Closed forms: (-1, 3) to the power 2 is the line from -1 to 9.
TEST(PowerMean, SignedPowersOfALine) {
  EXPECT_NEAR(signed_power_mean(-1, 3, 2, 0.5), 2, 1e-15);
  EXPECT_NEAR(signed_power_mean(-1, 3, 2, 0.05), -std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(signed_power_mean(3, -1, 2, 0.5), 2, 1e-15);
  EXPECT_NEAR(signed_power_mean_integral(-1, 3, 2, 1), 26.0 / 15, 1e-15);
  EXPECT_NEAR(signed_power_mean_integral(-1, 3, 2, 0.05), (std::pow(0.5, 1.5) - 1) / 15, 1e-16);
  EXPECT_NEAR(signed_power_mean_integral(-1, -3, 1, 1), -2, 1e-15);
  EXPECT_NEAR(signed_power_mean_integral(0, 3, 1, 1), 1.5, 1e-15);
  EXPECT_NEAR(signed_power_mean_integral(0, -3, 1, 1), -1.5, 1e-15);
}

// The arithmetic and the harmonic mean have integrals without exponentials.
TEST(PowerMeanIntegral, RatiosMayBeAnySize) {
  const double l = std::log(1e200);
  EXPECT_NEAR(power_mean_integral(1, 1e200, 1, 1) / 0.5e200, 1, 1e-12);
  EXPECT_NEAR(power_mean_integral(1e200, 1, 1, 1) / 0.5e200, 1, 1e-12);
  EXPECT_NEAR(power_mean_integral(1, 1e-200, -1, 1) / (l * 1e-200), 1, 1e-12);
  EXPECT_NEAR(power_mean_integral(1, 1e200, -1, 1) / l, 1, 1e-12);
  EXPECT_EQ(power_mean_integral(1, 2, 3, 0), 0);
  EXPECT_EQ(power_mean_integral(2, 2, 3, 0.25), 0.5);
}

// Integrals of powers of a line: g from 1 to 343 to the power 1/3, from 1/25 to 4 to -1/2.
TEST(PowerMeanIntegral, OfCubesAndInverseSquaresIsThatOfALine) {
  const double g = 0.7 + 0.3 * 343;
  EXPECT_NEAR(power_mean_integral(1, 7, 3, 0.3), 0.75 * (std::pow(g, 4.0 / 3) - 1) / 342, 4e-15);
  EXPECT_NEAR(power_mean_integral(5, 0.5, -2, 0.8), 2 * (std::sqrt(3.208) - 0.2) / 3.96, 2e-15);
}

// (1 -+ 1/sqrt 3) / 2 with weights of 1/2; of three nodes the middle one weighs 4/9.
TEST(Quadrature, NodesAndWeightsAreThoseOfTheTables) {
  EXPECT_NEAR(gauss_legendre<2>.nodes[0], (1 - 1 / std::sqrt(3.0)) / 2, 1e-16);
  EXPECT_NEAR(gauss_legendre<2>.nodes[1], (1 + 1 / std::sqrt(3.0)) / 2, 2e-16);
  EXPECT_NEAR(gauss_legendre<2>.weights[1], 0.5, 1e-16);
  EXPECT_NEAR(gauss_legendre<3>.nodes[1], 0.5, 1e-16);
  EXPECT_NEAR(gauss_legendre<3>.weights[1], 4.0 / 9, 1e-16);
  EXPECT_NEAR(gauss_legendre<3>.weights[2], 5.0 / 18, 1e-16);
}

TEST(Quadrature, GaussRulesAreExactForPolynomials) {
  EXPECT_NEAR((integrate_gauss<2>([](double x) { return x * x * x; }, 1, 3)), 20, 1e-13);
  const auto power = [](int n) { return [n](double x) { return std::pow(x, n); }; };
  EXPECT_NEAR((integrate_gauss<8>(power(15), 0, 1)), 1.0 / 16, 1e-16);
  EXPECT_NEAR((integrate_gauss<16>(power(31), 0, 2)), std::pow(2.0, 32) / 32, 1e-7);
  EXPECT_NEAR((integrate_gauss<32>(power(63), 0, 1)), 1.0 / 64, 1e-16);
}

TEST(Roots, FindsTheSignChange) {
  const auto root = bracketed_root([](double x) { return x * x * x - 2; }, 0, 5, 1e-15);
  ASSERT_TRUE(root);
  EXPECT_NEAR(*root, std::cbrt(2.0), 1e-15);
  EXPECT_FALSE(bracketed_root([](double x) { return x * x + 1; }, -1, 1, 1e-9));
  EXPECT_FALSE(bracketed_root([](double) { return std::nan(""); }, -1, 1, 1e-9));
  EXPECT_FALSE(bracketed_root([](double x) { return x - 1; }, 2, 0, 1e-9));
}

// 60 digits (mpmath). The powers of a small p lie next to 1, their roots 1 / p times as far apart.
TEST(SignedPowerMeanIntegral, LosesNoDigitsToASmallPower) {
  EXPECT_NEAR(
      signed_power_mean_integral(1242683.2769814397, -467119.7191694522, 6.271148640438754e-07, 1),
      0.24318372953416206783, 1e-15);
  EXPECT_NEAR(signed_power_mean_integral(3, -5, 1e-9, 1), -1.0000000000216513098e-9, 1e-23);
  EXPECT_NEAR(signed_power_mean_integral(3, -5, 1e-9, 1e-9), 1.2969970744325250927e-9, 1e-23);
  EXPECT_NEAR(signed_power_mean_integral(-2, 7, 1e-5, 0.99999), -5.2632502751590258442e-6, 1e-19);
  EXPECT_NEAR(signed_power_mean_integral(-1, 3, 2, 0.05), -0.043096440627115084483, 1e-17);
}

// Up to the zero between the ends the mean is (1 - u/u0)^(1/p) of the first; rounding may put u
// beyond it.
TEST(SignedPowerMeanIntegral, StopsAtZeroWithinRounding) {
  for (const double p : {1e-6, 0.005, 0.3, 1.0, 2.0})
    for (int i = 1; i < 300; ++i) {
      const double a = i % 2 == 0 ? 0.01 * i : -0.01 * i;
      const double b = i % 2 == 0 ? -1 : 1;
      const double first = std::pow(std::abs(a), p);
      const double zero = first / (first + 1);
      for (const double u : {std::nextafter(zero, 0), zero, std::nextafter(zero, 1)})
        EXPECT_NEAR(signed_power_mean_integral(a, b, p, u), a * zero / (1 + 1 / p), 1e-15)
            << a << " " << p;
    }
}

}  // namespace
}  // namespace keyline::numeric
