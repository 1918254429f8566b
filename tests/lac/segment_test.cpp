#include "keyline/lac/segment/segment.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/core/angle.h"
#include "keyline/curve/concept.h"
#include "keyline/lac/chain/chain.h"
#include "keyline/lac/hermite/hermite.h"
#include "keyline/numeric/quadrature.h"

namespace keyline::lac {
namespace {

using core::Point2;
using core::Vector2;

static_assert(curve::PlanarCurve<Segment>);
static_assert(curve::PlanarCurve<Chain>);
static_assert(std::is_trivially_copyable_v<Segment>);

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Displacement by many small Gauss panels in arc length, with the turning in closed form; panels
/// shrink towards both ends and the inflection, where the angle is not smooth.
Vector2 brute_displacement(const Piece& p, double t) {
  std::vector<double> marks{0, t};
  const double at = inflection(p);
  if (at > 0 && at < t) marks.insert(marks.begin() + 1, at);
  Vector2 sum;
  const auto f = [&](double v) { return core::unit_vector(turning(p, v)); };
  for (std::size_t i = 0; i + 1 < marks.size(); ++i) {
    const double low = marks[i];
    const double width = marks[i + 1] - low;
    double before = 0;
    for (int k = 1; k <= 160; ++k) {  // geometric towards both ends
      const double x = k <= 80 ? 0.5 * std::pow(0.6, 80 - k) : 1 - 0.5 * std::pow(0.6, k - 81);
      const double here = k == 160 ? 1 : x;
      sum = sum + numeric::integrate_gauss<16>(f, low + width * before, low + width * here);
      before = here;
    }
  }
  return p.length * sum;
}

TEST(Segment, StraightLineAndCircle) {
  const Segment line{{{1, 2}, 0.5}, 3, 2, 0, 0};
  EXPECT_NEAR(distance(evaluate(line, 0.5), Point2{1 + std::cos(0.5), 2 + std::sin(0.5)}), 0,
              1e-15);
  for (const double alpha : {-1e3, -1.0, 0.0, 1.0, 2.5, 1e3}) {
    const Segment circle{{{0, -2}, 0}, alpha, std::numbers::pi, 0.5, 0.5};
    EXPECT_NEAR(distance(evaluate(circle, 1), Point2{2, 0}), 0, 1e-15) << alpha;
    EXPECT_EQ(curvature(circle, 0.3), 0.5);
    EXPECT_EQ(curvature_rate(circle, 0.3), 0);
    EXPECT_NEAR(tangent_angle(circle, 1), std::numbers::pi / 2, 1e-15);
  }
}

TEST(Segment, LogarithmicSpiralClosedForm) {
  // rho = rho0 e^(m theta): position = rho0 (e^((m+i) theta) - 1) / (m + i).
  const double m = 0.7, theta = 1.9, rho0 = 1.5;
  const double rho1 = rho0 * std::exp(m * theta);
  const Segment s{{}, 1, (rho1 - rho0) / m, 1 / rho0, 1 / rho1};
  const double re = rho1 * std::cos(theta) - rho0, im = rho1 * std::sin(theta);
  const Point2 expected{(re * m + im) / (m * m + 1), (im * m - re) / (m * m + 1)};
  EXPECT_NEAR(distance(evaluate(s, 1), expected), 0, 3e-15);
  EXPECT_NEAR(total_turning(s), theta, 1e-15);
}

TEST(Segment, CircleInvoluteClosedForm) {
  // Involute of the unit circle: rho = theta, from the cusp: (cos t + t sin t - 1, sin t - t cos t)
  // runs with tangent angle t; start tangent along x.
  const double t0 = 0, t1 = 2.4;
  const Segment s{{{1, 0}, 0}, 2, (t1 * t1 - t0 * t0) / 2, kInfinity, 1 / t1};
  ASSERT_TRUE(validate(s));
  const Point2 end{std::cos(t1) + t1 * std::sin(t1), std::sin(t1) - t1 * std::cos(t1)};
  EXPECT_NEAR(distance(evaluate(s, 1), end), 0, 4e-15);
  EXPECT_NEAR(total_turning(s), t1, 1e-15);
  const double half = t1 * std::sqrt(0.5);
  const Point2 middle{std::cos(half) + half * std::sin(half),
                      std::sin(half) - half * std::cos(half)};
  EXPECT_NEAR(distance(evaluate(s, 0.5), middle), 0, 4e-15);
}

TEST(Segment, ClothoidAgainstPowerSeries) {
  // Fresnel integrals: kappa = pi s; C(1), S(1).
  const Segment s{{}, -1, 1, 0, std::numbers::pi};
  EXPECT_NEAR(distance(evaluate(s, 1), Point2{0.7798934003768228, 0.4382591473903548}), 0, 1e-15);
}

class AgainstBruteForce : public ::testing::TestWithParam<Piece> {};

TEST_P(AgainstBruteForce, DisplacementSampleAndJet) {
  const Piece p = GetParam();
  ASSERT_TRUE(validate(p));
  const Segment s = place(p, {{0, 0}, 0});
  const std::vector<Point2> points = sample(s, 9);
  for (int i = 0; i <= 8; ++i) {
    const double t = i / 8.0;
    const Vector2 expected = brute_displacement(p, t);
    EXPECT_NEAR(distance(evaluate(s, t), Point2{expected.x, expected.y}), 0, 6e-15 * p.length) << t;
    EXPECT_NEAR(distance(points[i], Point2{expected.x, expected.y}), 0, 6e-15 * p.length) << t;
  }
  const double h = 1e-5;
  for (const double t : {0.2, 0.45, 0.8}) {
    const double measured = (turning(p, t + h) - turning(p, t - h)) / (2 * h * p.length);
    EXPECT_NEAR(curvature(p, t), measured, 1e-6 * (1 + std::abs(measured))) << t;
    const double rate = (curvature(p, t + h) - curvature(p, t - h)) / (2 * h * p.length);
    EXPECT_NEAR(curvature_rate(p, t), rate, 1e-6 * (1 + std::abs(rate))) << t;
    EXPECT_NEAR(curve::curvature(jet(s, t)), curvature(s, t), 1e-13);
    EXPECT_NEAR(curve::curvature_rate(jet(s, t)), curvature_rate(s, t),
                1e-12 * (1 + std::abs(rate)));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Slopes, AgainstBruteForce,
    ::testing::Values(Piece{-1, 1, 2, 0.1}, Piece{-1, 1, -2, 3}, Piece{-1, 1, 0, 2},
                      Piece{-2.5, 1, 3, 0}, Piece{-2.5, 2, -1, 1.7}, Piece{-0.3, 1, 4, 0},
                      Piece{-0.3, 1, 2, -1}, Piece{-10, 1, 0, -2}, Piece{-1e3, 1, 2, 1e-3},
                      Piece{-1e-13, 1, 3, 0.2}, Piece{0, 1, 3, 0.2}, Piece{1e-13, 1, 0.2, 3},
                      Piece{0.5, 1, 6, 0.4}, Piece{1 - 1e-13, 1, 0.4, 3}, Piece{1, 1, 5, 0.5},
                      Piece{1 + 1e-13, 1, -0.5, -5}, Piece{2, 1, 4, 0.5}, Piece{3, 1, 5, 1},
                      Piece{10, 1, 1, 4}, Piece{1e3, 1, 1, 2}, Piece{-1, 1, 0.3, 30},
                      Piece{0.5, 1, 1, 1 + 1e-9}, Piece{-2, 3, 1e-9, 1.1e-9}));

TEST(Segment, CuspIsIntegratedInTangentAngle) {
  for (const double alpha : {1.3, 2.0, 4.0, 12.0}) {
    const Piece p{alpha, 1, kInfinity, 1};
    const double theta = total_turning(p);
    EXPECT_NEAR(theta, alpha / (alpha - 1), 1e-13 * theta);
    // s = theta^(alpha/(alpha-1)) up to scale: integrate e^(i theta) ds by x = theta^(1/(alpha-1)).
    const auto f = [&](double x) {
      const double u = std::pow(x, alpha - 1);
      return alpha * std::pow(x, alpha - 1) * core::unit_vector(theta * u);
    };
    Vector2 sum;
    double before = 0;
    for (int k = 300; k >= 0; --k) {
      const double x = std::pow(0.8, k);
      sum = sum + numeric::integrate_gauss<16>(f, before, x);
      before = x;
    }
    const Vector2 v = displacement(p, 1);
    EXPECT_NEAR(v.x, sum.x, 1e-12) << alpha;
    EXPECT_NEAR(v.y, sum.y, 1e-12) << alpha;
    const Vector2 r = displacement(reversed(p), 1);
    EXPECT_NEAR(norm(r), norm(v), 1e-14);
  }
}

Piece random_piece(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  const double alpha = 6 * unit(random);
  const double k0 = 3 * unit(random);
  const double k1 = 3 * unit(random);
  return {alpha, 1, k0, alpha < 0 ? k1 : std::copysign(k1, k0)};
}

TEST(Segment, ReversingSplittingAndMovingChangeNothing) {
  std::mt19937 random(7);
  for (int n = 0; n < 300; ++n) {
    const Segment s = place(random_piece(random), {{0.3, -0.2}, 0.4});
    const Segment back = reverse(s);
    const SegmentPair halves = split(s, 0.37);
    const core::Similarity2 map{2.5, 1.1, {3, -4}};
    for (const double t : {0.0, 0.2, 0.5, 1.0}) {
      EXPECT_NEAR(distance(evaluate(s, t), evaluate(back, 1 - t)), 0, 5e-15);
      EXPECT_NEAR(distance(apply(map, evaluate(s, t)), evaluate(transform(s, map), t)), 0, 2e-14);
      EXPECT_NEAR(distance(evaluate(halves.first, t), evaluate(s, 0.37 * t)), 0, 5e-15);
      EXPECT_NEAR(distance(evaluate(halves.second, t), evaluate(s, 0.37 + 0.63 * t)), 0, 2e-14)
          << s.alpha << ' ' << s.curvature_start << ' ' << s.curvature_end;
    }
  }
}

TEST(Segment, FractionAtTurningInvertsTurning) {
  std::mt19937 random(8);
  for (int n = 0; n < 300; ++n) {
    Piece p = random_piece(random);
    p.curvature_end = std::copysign(p.curvature_end, p.curvature_start);
    for (const double u : {0.1, 0.5, 0.9}) {
      EXPECT_NEAR(turning(p, fraction_at_turning(p, u)), u * total_turning(p), 1e-13);
    }
  }
  EXPECT_NEAR(fraction_at_turning({-1, 1, 1, 0}, 0.75), 0.5, 1e-15);
  EXPECT_NEAR(fraction_at_turning({2, 1, kInfinity, 1}, 0.5), 0.25, 1e-15);
}

TEST(Segment, EvoluteHasSlopeOneOverTwoMinusAlpha) {
  for (const double alpha : {-3.0, -1.0, 0.0, 0.5, 1.0, 1.7, 2.0, 2.3, 4.0}) {
    for (const double end : {0.6, 2.9}) {
      for (const double sign : {1.0, -1.0}) {
        const Segment s{{{1, 2}, 0.3}, alpha, 1.2, sign * 1.3, sign * end};
        const auto e = evolute(s);
        ASSERT_TRUE(e);
        for (const double t : {0.0, 0.3, 0.7, 1.0}) {
          const double at = (1 / curvature(s, t) - sign / 1.3) / (sign / end - sign / 1.3);
          const Point2 centre = centre_of_curvature(jet(s, t));
          EXPECT_NEAR(distance(evaluate(*e, at), centre), 0, 1e-14) << alpha << ' ' << end;
        }
      }
    }
  }
  EXPECT_FALSE(evolute(Segment{{}, -1, 1, 1, 1}));
  EXPECT_FALSE(evolute(Segment{{}, -1, 1, 1, -1}));
}

TEST(Segment, HoldsAtExtremeScales) {
  for (const double scale : {1e150, 1e-150}) {
    const Segment s = transform({{}, 0.7, 1, 3, 0.5}, {scale, 0, {}});
    const Segment unit{{}, 0.7, 1, 3, 0.5};
    EXPECT_NEAR(distance(evaluate(s, 1), {}) / scale, distance(evaluate(unit, 1), {}), 2e-15);
  }
}

TEST(Segment, ValidateNamesTheBrokenRule) {
  EXPECT_TRUE(validate(Piece{-1, 1, 0, -1}));
  EXPECT_TRUE(validate(Piece{2, 1, kInfinity, 1}));
  const Piece bad[] = {{std::nan(""), 1, 1, 1},
                       {kInfinity, 1, 1, 1},
                       {0, 0, 1, 1},
                       {0, -1, 1, 1},
                       {0, 1, 1, 0},
                       {0.5, 1, 1, -1},
                       {2, 1, kInfinity, kInfinity},
                       {1, 1, kInfinity, 1},
                       {-1, 1, kInfinity, 1},
                       {0, 1, 1, std::nan("")},
                       {0, 1, 1e9, 1e9}};
  for (const Piece& p : bad) {
    const auto valid = validate(p);
    ASSERT_FALSE(valid);
    EXPECT_EQ(valid.error().code, core::ErrorCode::bad_input);
  }
}

TEST(Chain, AgreesWithItsSegments) {
  const Chain chain{{{1, 1}, 0.3}, {{-1, 2, 0, 1}, {0.5, 1, 1, 2}, {-2, 1.5, 2, -0.5}}, false};
  ASSERT_TRUE(validate(chain));
  EXPECT_EQ(largest_joint_gap(chain).curvature, 0);
  const std::vector<Segment> placed = segments(chain);
  EXPECT_NEAR(distance(evaluate(chain, 1), evaluate(placed[2], 1)), 0, 1e-15);
  EXPECT_NEAR(distance(evaluate(chain, 2.5 / 4.5), evaluate(placed[1], 0.5)), 0, 1e-15);
  EXPECT_NEAR(end_pose(chain).direction, 0.3 + total_turning(chain), 1e-14);
  EXPECT_EQ(breakpoints(chain).size(), 5u);
  const std::vector<Point2> points = sample(chain, 46);
  for (int i = 0; i < 46; ++i) {
    EXPECT_NEAR(distance(points[i], evaluate(chain, i / 45.0)), 0, 1e-14) << i;
  }
  const Chain back = reverse(chain);
  EXPECT_NEAR(distance(evaluate(back, 0.3), evaluate(chain, 0.7)), 0, 1e-14);
  const ChainPair halves = split(chain, 0.5);
  EXPECT_NEAR(distance(evaluate(halves.second, 1), evaluate(chain, 1)), 0, 1e-14);
  EXPECT_NEAR(distance(evaluate(halves.first, 1), evaluate(chain, 0.5)), 0, 1e-14);
  const double t = 0.4, h = 1e-6;
  const Vector2 measured = (1 / (2 * h)) * (evaluate(chain, t + h) - evaluate(chain, t - h));
  EXPECT_NEAR(norm(measured - jet(chain, t).first), 0, 1e-8);
  EXPECT_FALSE(validate(Chain{}));
}

/// Found at random: all of the curve's length was added to the straight beginning of a curve whose
/// radius falls by e^39.7. The end of the handles' curve is known: (1, 0).
TEST(Segment, IsSampledPastAStraightBeginning) {
  const auto solved =
      solve_g1_directions({{0, 0}, -0.023952056369365315}, {{1, 0}, 1.43}, 0.016728668809351706);
  ASSERT_TRUE(solved);
  const Segment& s = solved->segment;
  const std::vector<double> at{0, 0.02, 0.1, 0.5, 0.9, 0.98, 0.999, 1};
  std::vector<Point2> points(at.size());
  sample(s, at, points);
  for (std::size_t i = 0; i < at.size(); ++i)
    EXPECT_LT(norm(points[i] - evaluate(s, at[i])), 1e-12) << at[i];
  EXPECT_NEAR(points.back().x, 1, 1e-12);
  EXPECT_NEAR(points.back().y, 0, 1e-12);
}

}  // namespace
}  // namespace keyline::lac
