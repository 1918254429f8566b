#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/core/angle.h"
#include "keyline/fairing/fair.h"
#include "keyline/numeric/random.h"

#include "truth.h"

/// Points that the curve is to pass cost it neither its calm nor its nearness to the others.
namespace keyline::fairing {
namespace {

/// A closed outline of n points with errors of 1/2000 of its length or so.
std::vector<core::Point2> outline(std::uint64_t seed, int n, double noise) {
  numeric::Random random(seed);
  const double two = random.uniform(0, 0.25), three = random.uniform(0, 0.1);
  const double turned = random.uniform(0, 6);
  std::vector<core::Point2> points;
  for (int i = 0; i < n; ++i) {
    const double t = 2 * core::kPi * i / n;
    const double r = 1 + two * std::cos(2 * t) + three * std::cos(3 * t + turned);
    points.push_back({1.3 * r * std::cos(t) + noise * random.normal(),
                      r * std::sin(t) + noise * random.normal()});
  }
  points.push_back(points.front());
  return points;
}

double rms(const FairResult& result) {
  double sum = 0;
  for (const double offset : result.offsets) sum += offset * offset;
  return std::sqrt(sum / static_cast<double>(result.offsets.size()));
}

void expect_passed(std::uint64_t seed, int n, std::size_t step) {
  const auto points = outline(seed, n, 0.003);
  FairOptions options;
  const FairResult free = fair(testing::line_through(points), options).value();
  for (std::size_t j = 3 + seed; j + 3 < points.size(); j += step) options.must_pass.push_back(j);
  const FairResult result = fair(testing::line_through(points), options).value();
  EXPECT_FALSE(result.calm_missed) << seed;
  EXPECT_TRUE(result.within_tolerance) << seed;
  for (const std::size_t j : options.must_pass)
    EXPECT_LE(std::abs(result.offsets[j]), 1e-3 * result.tolerance) << seed << ' ' << j;
  EXPECT_LE(rms(result), 1.25 * rms(free)) << seed;
}

TEST(MustPass, ThreePointsOfAnOutline) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) expect_passed(seed, 60, 20);
}

TEST(MustPass, EveryFifthPointOfAnOutline) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) expect_passed(seed, 60, 5);
}

}  // namespace
}  // namespace keyline::fairing
