#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/acquire/acquire.h"
#include "keyline/acquire/noise.h"
#include "keyline/numeric/random.h"

namespace keyline::acquire {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

/// An ellipse of axes 200 and 80, its first point anywhere between two of those of the axes.
RawCurve ellipse(int points, double error, numeric::Random& random) {
  RawCurve raw;
  const double start = random.uniform();
  for (int i = 0; i < points; ++i) {
    const double t = kTurn * (i + start) / points;
    raw.points.push_back({200 * std::cos(t) + error * random.normal(),
                          80 * std::sin(t) + error * random.normal(), 0});
  }
  return raw;
}

/// Exact points so far apart that windows of them bend more than polynomials can: what is left is
/// shape. Of more points than that the residuals are small by themselves.
TEST(FewPoints, BendWithoutNoiseHoweverTheyLie) {
  numeric::Random random(5);
  for (int n = 5; n < 48; ++n) {
    for (int k = 0; k < 4; ++k) {
      const auto line = acquire_key_line(ellipse(n, 0, random));
      ASSERT_TRUE(line);
      EXPECT_LE(line->noise, 3.1e-4 * line->length) << n;
    }
  }
}

/// Errors larger than the residuals of bends are told all the same: those do not grow with the
/// points' spacing. So few points tell to a quarter in the mean, not all of them being known as
/// closed.
TEST(FewPoints, ErrAsMuchAsTheyDo) {
  numeric::Random random(6);
  constexpr double kError = 9;  // 1 % of the length
  constexpr int kTimes = 100;
  for (const int n : {24, 32, 48}) {
    double sum = 0;
    for (int k = 0; k < kTimes; ++k) sum += acquire_key_line(ellipse(n, kError, random))->noise;
    EXPECT_NEAR(sum / kTimes, kError, 0.25 * kError) << n;
  }
}

/// Errors at twice the spacing are as large: all of them are errors. What exact points of a curve
/// leave is bends.
TEST(NoiseBeyondBends, KeepsWhatDoesNotGrow) {
  numeric::Random random(7);
  std::vector<core::Point2> errors, bends;
  for (int i = 0; i < 400; ++i) errors.push_back({double(i), 0.1 * random.normal()});
  EXPECT_EQ(noise_beyond_bends(errors, false, 1, 0.1), 0.1);
  for (const core::Point3& p : ellipse(24, 0, random).points) bends.push_back({p.x, p.y});
  EXPECT_EQ(noise_beyond_bends(bends, true, 1, 0.1), 0);
}

}  // namespace
}  // namespace keyline::acquire
