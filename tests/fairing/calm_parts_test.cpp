#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/fairing/cell_nodes.h"
#include "keyline/fairing/fair.h"
#include "keyline/fairing/least_variation.h"
#include "keyline/fairing/piece_energy.h"
#include "keyline/fairing/residuals.h"
#include "keyline/fairing/rise_barrier.h"
#include "keyline/fairing/straights.h"

#include "truth.h"

/// What the calmest chain is made with, against definitions worked out here.
namespace keyline::fairing::detail {
namespace {

/// Curvature of a log-aesthetic piece at a share of its length, by its definition.
double curvature_at(double a, double b, double alpha, double v) {
  if (alpha == 0) return a * std::pow(b / a, v);
  const double p = -alpha;
  const auto power = [](double x, double e) { return std::copysign(std::pow(std::abs(x), e), x); };
  return power((1 - v) * power(a, p) + v * power(b, p), 1 / p);
}

/// Sum of squared differences over a fine grid, graded towards both ends.
double sampled_energy(double a, double b, double alpha) {
  constexpr int kSteps = 200000;
  double sum = 0;
  double s = 0;
  double k = a;
  for (int i = 1; i <= kSteps; ++i) {
    const double t = 0.5 * (1 - std::cos(M_PI * i / kSteps));
    const double next = curvature_at(a, b, alpha, t);
    sum += (next - k) * (next - k) / (t - s);
    k = next;
    s = t;
  }
  return sum;
}

TEST(PieceEnergy, IsTheIntegralOfTheSquaredRate) {
  for (const double alpha : {-3.0, -2.0, -1.5, -1.0, -0.3, 0.0, 0.7, 2.0, 3.0})
    for (const auto& [a, b] : {std::pair{1.0, 4.0}, {-2.0, -0.5}, {3.0, 3.1}, {0.2, 20.0}}) {
      const double root = piece_energy(a, b, alpha).root;
      const double expected = sampled_energy(a, b, alpha);
      EXPECT_NEAR(root * root, expected, 1e-4 * expected) << alpha << ": " << a << " to " << b;
      EXPECT_EQ(root > 0, b > a);
    }
}

TEST(PieceEnergy, PassesAnInflection) {
  for (const double alpha : {-1.0, -0.8, -0.4})
    for (const auto& [a, b] : {std::pair{-1.0, 2.0}, {3.0, -0.2}, {1.0, 0.0}}) {
      const double root = piece_energy(a, b, alpha).root;
      const double expected = sampled_energy(a, b, alpha);
      EXPECT_NEAR(root * root, expected, 2e-3 * expected) << alpha << ": " << a << " to " << b;
    }
}

TEST(PieceEnergy, OfNoCurvatureIsNone) {
  for (const double alpha : {-1.0, -0.5}) EXPECT_EQ(piece_energy(0, 0, alpha).root, 0);
}

TEST(PieceEnergy, RatesAreDifferences) {
  constexpr double h = 1e-6;
  for (const double alpha : {-2.5, -1.0, -0.5, 0.0, 1.3})
    for (const auto& [a, b] : {std::pair{1.0, 4.0}, {-2.0, -0.5}, {5.0, 4.9}}) {
      const PieceEnergy e = piece_energy(a, b, alpha);
      const auto root = [&](double da, double db) {
        return piece_energy(a + da, b + db, alpha).root;
      };
      EXPECT_NEAR(e.by_start, (root(h, 0) - root(-h, 0)) / (2 * h), 1e-6);
      EXPECT_NEAR(e.by_end, (root(0, h) - root(0, -h)) / (2 * h), 1e-6);
    }
}

// With p = -alpha its square is (|a|^p + |b|^p) / p times (|a|^(2-p) + |b|^(2-p)) / (2-p).
TEST(PieceEnergy, RatesThroughAnInflectionAreThoseOfTheClosedForm) {
  constexpr double h = 1e-6;
  for (const double alpha : {-1.6, -0.7, -0.3})
    for (const auto& [a, b] : {std::pair{-1.0, 2.0}, {3.0, -0.2}, {0.4, -0.5}, {-7.0, 9.0}}) {
      const auto root = [alpha](double from, double to) {
        const auto sum = [&](double q) {
          return (std::pow(std::abs(from), q) + std::pow(std::abs(to), q)) / q;
        };
        return std::copysign(std::sqrt(sum(-alpha) * sum(2 + alpha)), to - from);
      };
      const PieceEnergy e = piece_energy(a, b, alpha);
      EXPECT_NEAR(e.root, root(a, b), 1e-12 * std::abs(e.root));
      EXPECT_NEAR(e.by_start, (root(a + h, b) - root(a - h, b)) / (2 * h), 1e-6);
      EXPECT_NEAR(e.by_end, (root(a, b + h) - root(a, b - h)) / (2 * h), 1e-6);
    }
}

std::vector<FitPoint> spread(int n) {
  std::vector<FitPoint> points(n);
  for (int i = 0; i < n; ++i) points[i].position = {i / double(n), 0};
  return points;
}

TEST(Residuals, AreTheNoiseWhereTheToleranceIsMadeForIt) {
  const auto points = spread(200);
  const double noise = 1e-3;
  const double tolerance = noise_factor(200) * noise;
  const Residuals near = allowed_residuals(points, false, 200, noise, tolerance, 0);
  EXPECT_DOUBLE_EQ(near.rms, noise);
  EXPECT_DOUBLE_EQ(near.most(2), noise * 1.1);  // a mean square of 200: one in twenty is its error
  const Residuals r = allowed_residuals(points, false, 200, noise, tolerance, 0.5);
  EXPECT_DOUBLE_EQ(r.rms, noise * 1.05);
}

// 100,000 errors of 1e-3 have a root of their mean square of 1e-3 * (1 + 1 / sqrt(2e5)) to within
// their standard error; of that, means of a hundred leave what is beyond their scatter,
// 1e-6 * (1 - 1 / 100). Of five standard errors likewise.
TEST(Residuals, AreOfTheMeasuredPointsWhereMeansAreFitted) {
  std::vector<FitPoint> points;
  for (int i = 0; i < 1000; ++i) points.push_back({.position = {0.001 * i, 0}, .count = 100});
  const double noise = 1e-3;
  const Residuals r =
      allowed_residuals(points, false, 100'000, noise, noise_factor(100'000) * noise, 0.5);
  EXPECT_NEAR(r.noise, 1e-4, 1e-9);
  EXPECT_NEAR(r.rms, std::sqrt(1.004477e-6 - 0.99e-6), 1e-8);
  EXPECT_NEAR(
      r.most(5),
      std::sqrt(1e-6 * std::pow(1 + 1 / std::sqrt(2e5), 2) * std::pow(1 + 5 / std::sqrt(2e5), 2) -
                0.99e-6),
      1e-8);
}

TEST(Residuals, GrowWithToleranceAndSmoothness) {
  const auto points = spread(200);
  double last = 0;
  for (double t = 1e-3; t < 1e-2; t *= 1.1) {
    const Residuals r = allowed_residuals(points, false, 200, 1e-3, t, 0.5);
    if (r.rms == 0) break;
    EXPECT_GE(r.rms, last) << t;
    last = r.rms;
  }
  last = 0;
  for (const double smoothness : {0.0, 0.2, 0.4, 0.5, 0.7, 0.9}) {
    const double rms = allowed_residuals(points, false, 200, 1e-3, 5e-3, smoothness).rms;
    EXPECT_GT(rms, last) << smoothness;
    last = rms;
  }
  EXPECT_EQ(allowed_residuals(points, false, 200, 1e-3, 5e-3, 1).rms, 0);
}

// Curvature to the power -alpha is linear in arc length, so that its rate at an end is the
// difference of the powers times curvature to the power 1 + alpha over -alpha: fastest where that
// is larger.
TEST(TooFast, IsTheFastestRateOverTheOneAllowed) {
  for (const double alpha : {-2.5, -1.5, -0.5, 0.7})
    for (const auto& [a, b] : {std::pair{1.0, 4.0}, {3.0, 0.5}}) {
      DenseCurve curve;
      curve.at = {0, 0.5};
      curve.cut = {0, 1};
      curve.value = {a, b};
      curve.alpha = {alpha};
      curve.length = 2;
      curve.most_rate = 3;
      const double rise = (std::pow(b, -alpha) - std::pow(a, -alpha)) / -alpha / 0.5;
      const double fastest = std::max(std::abs(rise) * std::pow(a, 1 + alpha),
                                      std::abs(rise) * std::pow(b, 1 + alpha));
      EXPECT_NEAR(too_fast(curve), fastest / (3 * 2 * 2), 1e-12) << alpha;
    }
}

// An alternating series errs by less than the first term it leaves out.
TEST(SmallTurn, IsCosineAndSineToTheTermsLeftOut) {
  constexpr double kRounding = 2e-16;
  for (double angle = -kSmallTurn; angle <= kSmallTurn; angle += 0.01) {
    const core::Vector2 by = small_turn(angle);
    const double size = std::abs(angle);
    EXPECT_NEAR(by.x, std::cos(angle), kRounding + std::pow(size, 12) / 479001600) << angle;
    EXPECT_NEAR(by.y, std::sin(angle), kRounding + std::pow(size, 11) / 39916800) << angle;
  }
}

struct Followed {
  std::vector<FitPoint> points;
  DenseCurve curve;
};

Followed followed(const lac::Chain& chain, int n, double noise) {
  Followed f;
  const double length = lac::arc_length(chain);
  for (const core::Point2 p : testing::measure(chain, n, noise, 3))
    f.points.push_back({.position = {p.x / length, p.y / length}});
  f.curve = dense_curve(f.points, false, 240);
  least_variation(f.curve, f.points, {.tolerance = 4 * noise + 1e-5, .progress = {}});
  return f;
}

TEST(Straights, AreFoundWhereTheyAre) {
  const lac::Chain chain{
      {{0, 0}, 0.3}, {{-1, 40, 0, 0}, {-1, 30, 0, 0.05}, {-1, 30, 0.05, 0.05}}, false};
  const Followed f = followed(chain, 400, 1e-4);
  const auto found = straight_stretches(f.curve, f.points, 1e-4);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].first, 0);
  EXPECT_NEAR(f.curve.at[found[0].last], 0.4, 0.06);
}

// Nothing around it is bent, so that nothing but its being the whole tells it.
TEST(Straights, AllOfAnOpenCurveIsOne) {
  std::vector<FitPoint> points;
  for (int i = 0; i <= 40; ++i)
    points.push_back({.position = {i / 40.0, 1e-4 * ((7 * i) % 5 - 2)}});
  DenseCurve curve = dense_curve(points, false, 240);
  least_variation(curve, points, {.tolerance = 1e-3, .progress = {}});
  const auto found = straight_stretches(curve, points, 1.5e-4);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].first, 0);
  EXPECT_EQ(found[0].last, static_cast<int>(curve.at.size()) - 1);
}

TEST(Straights, AreNotFoundAboutAnInflection) {
  const lac::Chain chain{{{0, 0}, 0}, {{-1, 100, 0.03, -0.03}}, false};
  for (const double noise : {1e-6, 1e-4, 1e-3}) {
    const Followed f = followed(chain, 400, noise);
    EXPECT_TRUE(straight_stretches(f.curve, f.points, noise).empty()) << noise;
  }
}

}  // namespace
}  // namespace keyline::fairing::detail
