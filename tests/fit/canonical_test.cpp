#include "keyline/fit/canonical.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/core/angle.h"
#include "keyline/core/polygon.h"

namespace keyline::fit::detail {
namespace {

TEST(DecimalRounding, IsTheLastDigitThatIsWritten) {
  const auto rounding = [](std::vector<double> values) { return decimal_rounding(values); };
  EXPECT_DOUBLE_EQ(rounding({0.1, 0.25, 3}), 0.01);
  EXPECT_DOUBLE_EQ(rounding({1200, -300}), 100);
  EXPECT_DOUBLE_EQ(rounding({1.234567, 0}), 1e-6);
  EXPECT_DOUBLE_EQ(rounding({-7, 12}), 1);
  EXPECT_DOUBLE_EQ(rounding({2e-7, 5e-7}), 1e-7);
  EXPECT_EQ(rounding({M_PI, 1.0 / 3}), 0);
  EXPECT_EQ(rounding({0, 0}), 0);
  EXPECT_EQ(rounding({1, INFINITY}), 0);
}

TEST(GivenDirection, TurnsKnotsAndTheirOrder) {
  CanonicalData canonical;
  EXPECT_EQ(given_direction(canonical, {0.25, 0.5}), (std::vector<double>{0.25, 0.5}));
  canonical.reversed = true;
  EXPECT_EQ(given_direction(canonical, {0.25, 0.5}), (std::vector<double>{0.5, 0.75}));
}

/// A bend whose later half lies farther from its middle.
std::vector<core::Point2> bend() {
  std::vector<core::Point2> points;
  for (int i = 0; i <= 30; ++i) points.push_back({0.1 * i + 0.003 * i * i, std::sin(0.13 * i)});
  return points;
}

std::vector<double> even(std::size_t n) {
  std::vector<double> t;
  for (std::size_t i = 0; i < n; ++i)
    t.push_back(static_cast<double>(i) / static_cast<double>(n - 1));
  return t;
}

void expect_same(const SplineData& a, const SplineData& b) {
  EXPECT_EQ(a.parameters, b.parameters);
  EXPECT_EQ(a.columns, b.columns);
  EXPECT_EQ(a.weights, b.weights);
}

TEST(CanonicalCurve, StandsAtItsFirstPointAlongItsCentroidAndHasSizeOne) {
  const auto points = bend();
  const CanonicalData c = canonical_curve(points, even(31), {});
  ASSERT_FALSE(c.reversed);
  const core::Point2 centre = core::centroid(points);
  double largest = 0;
  for (const core::Point2& p : points) largest = std::max(largest, distance(p, centre));
  EXPECT_NEAR(c.scale, 1 / largest, 1e-15);
  const auto at = [&](std::size_t i) {
    return core::Point2{c.data.columns[0][i], c.data.columns[1][i]};
  };
  constexpr double kRounded = 0x1p-33;
  EXPECT_EQ(at(0), core::Point2{});
  double x = 0, y = 0;
  for (std::size_t i = 0; i < 31; ++i) x += at(i).x / 31, y += at(i).y / 31;
  EXPECT_NEAR(x, c.scale * distance(points[0], centre), kRounded);
  EXPECT_NEAR(y, 0, kRounded);
  for (std::size_t i = 0; i < 31; ++i)
    for (const std::size_t j : {0, 7, 30}) {
      EXPECT_NEAR(distance(at(i), at(j)), c.scale * distance(points[i], points[j]), 2 * kRounded);
      EXPECT_NEAR(cross(at(j) - at(0), at(i) - at(0)),
                  c.scale * c.scale * cross(points[j] - points[0], points[i] - points[0]),
                  8 * kRounded);
    }
}

TEST(CanonicalCurve, IsTheSameHoweverTheDataLie) {
  const auto points = bend();
  std::vector<double> weights;
  for (int i = 0; i <= 30; ++i) weights.push_back(1 + 0.1 * i);
  const CanonicalData straight = canonical_curve(points, even(31), weights);
  std::vector<core::Point2> moved;
  for (const core::Point2& p : points) {
    const core::Vector2 v = core::rotate_ccw(3.7 * (p - core::Point2{}), 2.1);
    moved.push_back({v.x + 5, v.y - 9});
  }
  expect_same(canonical_curve(moved, even(31), weights).data, straight.data);
  std::ranges::reverse(moved);
  std::ranges::reverse(weights);
  const CanonicalData back = canonical_curve(moved, even(31), weights);
  EXPECT_NE(back.reversed, straight.reversed);
  expect_same(back.data, straight.data);
}

// Points all as far from their centre tell no way; the side they turn to does.
TEST(CanonicalCurve, GoesLeftWhereNothingElseTells) {
  std::vector<core::Point2> arc;
  for (int i = 0; i <= 20; ++i) arc.push_back({std::cos(0.1 * i), std::sin(0.1 * i)});
  EXPECT_FALSE(canonical_curve(arc, even(21), {}).reversed);
  std::ranges::reverse(arc);
  EXPECT_TRUE(canonical_curve(arc, even(21), {}).reversed);
}

TEST(CanonicalFunction, IsTheSameHoweverTheDataLie) {
  std::vector<double> x, y;
  for (int i = 0; i <= 30; ++i)
    x.push_back(2 + 0.1 * i + 0.003 * i * i), y.push_back(std::exp(0.1 * i));
  const CanonicalData plain = canonical_function(x, y, {});
  EXPECT_FALSE(plain.reversed);  // its values lie farther from the mean at the end
  double mean = 0, largest = 0;
  for (const double v : y) mean += v / 31;
  for (const double v : y) largest = std::max(largest, std::abs(v - mean));
  EXPECT_NEAR(plain.scale, 1 / largest, 1e-15 / largest);
  for (std::size_t i = 0; i < 31; ++i) {
    EXPECT_NEAR(plain.data.parameters[i], (x[i] - x[0]) / (x[30] - x[0]), 0x1p-34);
    EXPECT_NEAR(plain.data.columns[0][i], (y[i] - mean) / largest, 0x1p-34);
  }
  std::vector<double> backward, values;
  for (std::size_t i = 31; i-- > 0;)
    backward.push_back(-7 * x[i] + 100), values.push_back(5 * y[i] - 3);
  const CanonicalData turned = canonical_function(backward, values, {});
  EXPECT_TRUE(turned.reversed);
  expect_same(turned.data, plain.data);
}

TEST(CanonicalFunction, OfAConstantHasNoScale) {
  const CanonicalData c = canonical_function({0, 1, 2}, {4, 4, 4}, {});
  EXPECT_EQ(c.scale, 1);
  EXPECT_EQ(c.data.columns[0], (std::vector<double>{0, 0, 0}));
}

/// Random data, more in the middle than at the ends.
SplineData scattered(bool weighted) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(0, 1);
  SplineData data;
  data.columns.resize(2);
  for (int i = 0; i < 200; ++i) data.parameters.push_back(2 + 3 * any(random) * any(random));
  std::ranges::sort(data.parameters);
  for (int i = 0; i < 200; ++i) {
    data.columns[0].push_back(any(random));
    data.columns[1].push_back(data.parameters[i] + any(random));
    if (weighted) data.weights.push_back(0.2 + any(random));
  }
  return data;
}

/// Weighted squares about the best line: normal equations in two unknowns.
double about_a_line(const std::vector<double>& w, const std::vector<double>& t,
                    const std::vector<double>& v) {
  long double s = 0, st = 0, stt = 0, sv = 0, stv = 0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    s += w[i], st += w[i] * t[i], sv += w[i] * v[i];
    stt += w[i] * t[i] * t[i], stv += w[i] * t[i] * v[i];
  }
  const long double det = s * stt - st * st;
  const long double slope = det > 1e-12L ? (s * stv - st * sv) / det : 0;
  const long double level = (sv - slope * st) / s;
  long double sum = 0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const long double d = v[i] - level - slope * t[i];
    sum += w[i] * d * d;
  }
  return static_cast<double>(sum);
}

TEST(Condense, HasTheMeansOfEachBinAndKnowsWhatTheyHide) {
  for (const bool weighted : {false, true}) {
    const SplineData data = scattered(weighted);
    const CondensedData c = condense(data, 16);
    const double low = data.parameters.front();
    const double width = (data.parameters.back() - low) / 16;
    double scatter = 0;
    std::size_t at = 0;
    for (int b = 0; b < 16; ++b) {
      std::vector<double> w, t;
      std::array<std::vector<double>, 2> v;
      for (std::size_t i = 0; i < 200; ++i) {
        const int bin = std::min(15, static_cast<int>((data.parameters[i] - low) / width));
        if (bin != b) continue;
        w.push_back(weighted ? data.weights[i] : 1);
        t.push_back(data.parameters[i]);
        for (std::size_t k = 0; k < 2; ++k) v[k].push_back(data.columns[k][i]);
      }
      if (t.empty()) continue;
      ASSERT_LT(at, c.data.parameters.size());
      double weight = 0, place = 0;
      for (std::size_t i = 0; i < t.size(); ++i) weight += w[i], place += w[i] * t[i];
      EXPECT_NEAR(c.data.weights[at], weight, 1e-13);
      EXPECT_NEAR(c.data.parameters[at], place / weight, 1e-14 * 5);
      for (std::size_t k = 0; k < 2; ++k) {
        double value = 0;
        for (std::size_t i = 0; i < t.size(); ++i) value += w[i] * v[k][i];
        EXPECT_NEAR(c.data.columns[k][at], value / weight, 1e-13);
        scatter += about_a_line(w, t, v[k]);
      }
      ++at;
    }
    EXPECT_EQ(at, c.data.parameters.size());
    EXPECT_EQ(at, c.data.weights.size());
    EXPECT_NEAR(c.scatter, scatter, 1e-10);
  }
}

TEST(Condense, OfRepeatedParametersHidesTheirScatter) {
  const CondensedData c = condense({{0, 0, 1}, {{1, 3, 7}}, {}}, 4);
  EXPECT_EQ(c.data.parameters, (std::vector<double>{0, 1}));
  EXPECT_EQ(c.data.columns[0], (std::vector<double>{2, 7}));
  EXPECT_EQ(c.scatter, 2);
}

}  // namespace
}  // namespace keyline::fit::detail
