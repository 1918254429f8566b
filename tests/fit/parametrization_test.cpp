#include "keyline/fit/parametrization.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace keyline::fit {
namespace {

using core::Point2;

// Chords of 3, 5 and 12 (and 0 between two that coincide).
const std::vector<Point2> kSteps{{0, 0}, {3, 0}, {6, 4}, {6, 4}, {6, 16}};

TEST(Parametrization, ByChordsIsTheirShare) {
  const auto t = parametrize(kSteps, Parametrization::chord);
  const std::vector<double> expected{0, 0.15, 0.4, 0.4, 1};
  ASSERT_EQ(t.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(t[i], expected[i], 1e-15);
  EXPECT_EQ(parametrize(kSteps, Parametrization::smooth_chord), t);  // too few to be averaged
}

TEST(Parametrization, CentripetalIsTheShareOfTheRoots) {
  const auto t = parametrize(kSteps, Parametrization::centripetal);
  const double sum = std::sqrt(3) + std::sqrt(5) + std::sqrt(12);
  ASSERT_EQ(t.size(), 5u);
  EXPECT_NEAR(t[1], std::sqrt(3) / sum, 1e-15);
  EXPECT_NEAR(t[2], (std::sqrt(3) + std::sqrt(5)) / sum, 1e-15);
  EXPECT_EQ(t[3], t[2]);
  EXPECT_EQ(t[4], 1);
}

TEST(Parametrization, OfNothingIsNone) {
  for (const auto kind :
       {Parametrization::chord, Parametrization::centripetal, Parametrization::smooth_chord}) {
    EXPECT_TRUE(parametrize({}, kind).empty());
    EXPECT_TRUE(parametrize(std::vector<Point2>{{1, 2}}, kind).empty());
    EXPECT_TRUE(parametrize(std::vector<Point2>{{1, 2}, {1, 2}}, kind).empty());
    EXPECT_TRUE(parametrize(std::vector<Point2>{{-1e308, 2}, {1e308, 2}}, kind).empty());
    EXPECT_EQ(parametrize(std::vector<Point2>{{1, 2}, {1, 3}}, kind), (std::vector<double>{0, 1}));
  }
}

/// Points on a half circle of radius 1 at even steps, pushed across by noise.
std::vector<Point2> noisy_half_circle(int n, double noise, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> any(0, 1);
  std::vector<Point2> points;
  for (int i = 0; i < n; ++i) {
    const double a = M_PI * i / (n - 1), r = 1 + noise * any(random);
    points.push_back({r * std::cos(a), r * std::sin(a)});
  }
  return points;
}

double largest_error(const std::vector<double>& t) {
  double most = 0;
  const auto n = static_cast<double>(t.size() - 1);
  for (std::size_t i = 0; i < t.size(); ++i)
    most = std::max(most, std::abs(t[i] - static_cast<double>(i) / n));
  return most;
}

// Zigzags of noise make chords about as long everywhere, but not of one length: their sums walk at
// random. Lengths along the mean do not.
TEST(Parametrization, SmoothChordsAreThoseOfTheCurveBelowTheNoise) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    const auto points = noisy_half_circle(2000, 0.004, seed);
    const auto t = parametrize(points, Parametrization::smooth_chord);
    ASSERT_EQ(t.size(), 2000u);
    EXPECT_LT(largest_error(t), 0.002) << seed;
    EXPECT_GT(largest_error(parametrize(points, Parametrization::chord)), 0.004) << seed;
    // The points were moved across only: each stays near the foot it has there.
    double worst = 0;
    for (std::size_t i = 1; i < t.size(); ++i)
      worst = std::max(worst, std::abs((t[i] - t[i - 1]) * 1999 - 1));
    EXPECT_LT(worst, 0.6) << seed;
  }
}

TEST(Parametrization, SmoothChordsWithoutNoiseAreChords) {
  const auto points = noisy_half_circle(2000, 0, 1);
  EXPECT_EQ(parametrize(points, Parametrization::smooth_chord),
            parametrize(points, Parametrization::chord));
}

TEST(Parametrization, SmoothChordsDoNotKnowWhereTheDataLieNorFromWhichEnd) {
  for (const int n : {130, 170, 700}) {  // a window of one to either side, of two, of more
    const auto points = noisy_half_circle(n, 7.0 / n, 4);
    const auto t = parametrize(points, Parametrization::smooth_chord);
    EXPECT_NE(t, parametrize(points, Parametrization::chord)) << n;
    std::vector<Point2> moved;
    for (const Point2& p : points) moved.push_back({3 + 7 * p.y, -2 - 7 * p.x});
    const auto same = parametrize(moved, Parametrization::smooth_chord);
    for (std::size_t i = 0; i < t.size(); ++i) EXPECT_NEAR(same[i], t[i], 1e-12);
    std::ranges::reverse(moved);
    const auto back = parametrize(moved, Parametrization::smooth_chord);
    for (std::size_t i = 0; i < t.size(); ++i) EXPECT_NEAR(1 - back[t.size() - 1 - i], t[i], 1e-12);
  }
}

// There and back on the same places: where it turns the averages before and behind are one point.
// Numbers of few binary digits, so that they are exactly.
TEST(Parametrization, SmoothChordsTurnWhereTheDataDo) {
  std::mt19937 random(3);
  std::vector<Point2> points;
  for (int i = 0; i <= 400; ++i)
    points.push_back({i / 16.0, static_cast<double>(random() % 64) / 64.0});
  for (int i = 399; i >= 0; --i) points.push_back(points[i]);
  const auto t = parametrize(points, Parametrization::smooth_chord);
  EXPECT_NE(t, parametrize(points, Parametrization::chord));
  for (std::size_t i = 0; i < t.size(); ++i) EXPECT_NEAR(t[i], 1 - t[t.size() - 1 - i], 1e-12) << i;
}

}  // namespace
}  // namespace keyline::fit
