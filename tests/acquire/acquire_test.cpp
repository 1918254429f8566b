#include "keyline/acquire/acquire.h"

#include <cmath>
#include <complex>
#include <limits>

#include <gtest/gtest.h>

#include "keyline/acquire/noise.h"
#include "keyline/core/angle.h"
#include "keyline/numeric/random.h"

namespace keyline::acquire {
namespace {

RawCurve curve_of(std::vector<core::Point3> points) {
  RawCurve raw;
  raw.points = std::move(points);
  return raw;
}

struct Degenerate {
  const char* name;
  std::vector<core::Point3> points;
};

TEST(AcquireKeyLine, TooLittleIsBadInput) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Degenerate cases[] = {
      {"none", {}},
      {"one", {{1, 2, 0}}},
      {"all equal", {{1, 2, 0}, {1, 2, 0}, {1, 2, 0}, {1, 2, 0}}},
      {"not finite", {{nan, 0, 0}, {0, nan, 0}}},
      {"one finite", {{nan, 0, 0}, {0, 1, 0}}},
      {"huge", {{0, 0, 0}, {1e300, 0, 0}, {2, 0, 0}}},
  };
  for (const Degenerate& c : cases) {
    SCOPED_TRACE(c.name);
    const auto line = acquire_key_line(curve_of(c.points));
    ASSERT_FALSE(line);
    EXPECT_EQ(line.error().code, core::ErrorCode::bad_input);
    EXPECT_FALSE(line.error().message.empty());
  }
}

/// Points along a closed outline of a length of about four, each off by the noise.
template <class Place>
RawCurve noisy_outline(const Place& place, int count, double noise, std::uint64_t seed) {
  numeric::Random random(seed);
  std::vector<core::Point3> points;
  for (int i = 0; i < count; ++i) {
    const core::Point2 p = place(static_cast<double>(i) / count);
    points.push_back({p.x + noise * random.normal(), p.y + noise * random.normal(), 0});
  }
  return curve_of(std::move(points));
}

/// Between two arcs over one chord of 2, each of half a radian, from one tip round to it.
core::Point2 lens(double share) {
  const double radius = 1 / std::sin(0.25);
  const bool upper = share < 0.5;
  const double angle = (upper ? 1 - 4 * share : 4 * share - 3) * 0.25;
  const double height = radius * (std::cos(angle) - std::cos(0.25));
  return {radius * std::sin(angle), upper ? height : -height};
}

/// A Joukowski aerofoil from its cusp round to it, chord 4, closest to each other where it ends:
/// the steps there shrink as if they were squares.
core::Point2 joukowski(double share) {
  const std::complex<double> middle{-0.08, 0.05};
  const double from = std::arg(1.0 - middle);
  const auto at = middle + std::polar(std::abs(1.0 - middle), from + 2 * core::kPi * share);
  const auto place = at + 1.0 / at;
  return {place.real(), place.imag()};
}

// A point that was written twice, with a stray in between.
TEST(AcquireKeyLine, StraysBetweenTheCopiesOfAPointGo) {
  std::vector<core::Point3> points;
  for (int i = 0; i < 60; ++i) {
    const double t = 2 * core::kPi * i / 60;
    points.push_back({3 * std::cos(t), std::sin(t), 0});
    if (i != 20) continue;
    points.push_back({9, 8, 0});
    points.push_back(points[20]);
  }
  const KeyLine line = acquire_key_line(curve_of(std::move(points))).value();
  EXPECT_EQ(line.points.size(), 60U);
  EXPECT_EQ(line.report.outliers, 1U);
  EXPECT_EQ(line.report.outlier_sources, std::vector<std::size_t>{21});
  EXPECT_TRUE(line.closed);
}

// However far off a stray is, it is no measure of what points are repeated.
TEST(AcquireKeyLine, AFarStrayMergesNoPoints) {
  for (const double far : {1e5, 1e10, 1e20, 1e90}) {
    std::vector<core::Point3> points;
    for (int i = 0; i < 80; ++i) {
      points.push_back({0.1 * i, std::cosh(0.1 * i - 4) / 30, 0});
    }
    points[33].x = far;
    const KeyLine line = acquire_key_line(curve_of(std::move(points))).value();
    EXPECT_EQ(line.report.duplicates, 0U) << far;
    EXPECT_EQ(line.report.outlier_sources, std::vector<std::size_t>{33}) << far;
    EXPECT_EQ(line.points.size(), 79U) << far;
  }
}

// Of few points each turns much: what lies dozens of steps off is none of them all the same.
TEST(AcquireKeyLine, AFarStrayOfFewPointsGoes) {
  for (const bool open : {false, true}) {
    for (std::size_t stray = 1; stray < 11; ++stray) {
      std::vector<core::Point3> points;
      for (int i = 0; i < 12; ++i) {
        const double t = (open ? 0.6 : 1) * 2 * core::kPi * i / 12;
        points.push_back({3 * std::cos(t), 2 * std::sin(t), 0});
      }
      points[stray] = {80, 120, 0};
      const KeyLine line = acquire_key_line(curve_of(std::move(points))).value();
      EXPECT_EQ(line.report.outlier_sources, std::vector<std::size_t>{stray}) << open;
    }
  }
}

// A sector of a disc, its arc measured finely: its point is as far off as a stray, and none.
TEST(AcquireKeyLine, ThePointOfASectorIsNoStray) {
  std::vector<core::Point3> points;
  const auto arc = [](int i) {
    return core::Point3{std::cos(core::kPi / 200 * i), std::sin(core::kPi / 200 * i), 0};
  };
  for (int i = 20; i <= 40; ++i) points.push_back(arc(i));
  points.push_back({0, 0, 0});
  for (int i = 0; i < 20; ++i) points.push_back(arc(i));
  const KeyLine line = acquire_key_line(curve_of(std::move(points))).value();
  EXPECT_EQ(line.report.outliers, 0U);
}

// What errors make of steps smaller than they are is no way round the trailing edge.
TEST(AcquireKeyLine, NoiseClosesNoAerofoilRoundItsTrailingEdge) {
  int wrong = 0;
  for (const int count : {60, 120, 240}) {
    for (const double noise : {2e-4, 8e-4, 2e-3}) {
      for (std::uint64_t seed = 0; seed < 10; ++seed) {
        numeric::Random random(seed);
        std::vector<core::Point3> points;
        for (int i = 0; i <= count; ++i) {
          const core::Point2 p = joukowski(static_cast<double>(i) / count);
          points.push_back({p.x + noise * random.normal(), p.y + noise * random.normal(), 0});
        }
        const KeyLine line = acquire_key_line(curve_of(std::move(points))).value();
        if (line.closed || !line.corners.empty()) ++wrong;
      }
    }
  }
  EXPECT_LE(wrong, 2) << "of 90";
}

// Steps of five errors: what two of them turn is noise, half a radian often, the tip of three not.
TEST(AcquireKeyLine, NoiseHidesNoCornerAtTheSeamAndMakesNone) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(seed);
    const auto tipped = acquire_key_line(noisy_outline(lens, 10'000, 8e-5, seed));
    ASSERT_TRUE(tipped);
    EXPECT_FALSE(tipped->closed);
    const auto circle = [](double share) {
      const double angle = 2 * core::kPi * share;
      return core::Point2{0.64 * std::cos(angle), 0.64 * std::sin(angle)};
    };
    const auto round = acquire_key_line(noisy_outline(circle, 10'000, 8e-5, seed));
    ASSERT_TRUE(round);
    EXPECT_TRUE(round->closed);
  }
}

TEST(AcquireKeyLine, FewPointsAreALine) {
  const auto two = acquire_key_line(curve_of({{0, 0, 0}, {1, 0, 0}}));
  ASSERT_TRUE(two);
  EXPECT_EQ(two->points.size(), 2u);
  EXPECT_FALSE(two->closed);
  EXPECT_EQ(two->noise, 0);
  const auto three = acquire_key_line(curve_of({{0, 0, 0}, {1, 0, 0}, {2, 1, 0}}));
  ASSERT_TRUE(three);
  EXPECT_EQ(three->points.size(), 3u);
}

TEST(AcquireKeyLine, AClosedPolylineOfTwoPointsIsTheLineBetweenThem) {
  AcquireOptions options;
  options.ordered = true;
  options.closed = true;
  for (const bool repeated : {false, true}) {
    RawCurve raw = curve_of({{0, 0, 0}, {3, 1, 0}});
    if (repeated) raw.points.push_back(raw.points.front());
    const auto line = acquire_key_line(raw, options);
    ASSERT_TRUE(line);
    EXPECT_FALSE(line->closed);
    EXPECT_EQ(line->points, (std::vector<core::Point2>{{0, 0}, {3, 1}}));
    EXPECT_EQ(line->report.notes.size(), 1u);
  }
  const auto triangle = acquire_key_line(curve_of({{0, 0, 0}, {3, 1, 0}, {1, 2, 0}}), options);
  ASSERT_TRUE(triangle);
  EXPECT_TRUE(triangle->closed);
}

TEST(AcquireKeyLine, CollinearIsAStraightKeyLine) {
  RawCurve raw;
  for (int i = 0; i < 20; ++i) raw.points.push_back({i * 0.1, i * 0.2, 0});
  const auto line = acquire_key_line(raw);
  ASSERT_TRUE(line);
  EXPECT_EQ(line->points.size(), 20u);
  EXPECT_FALSE(line->closed);
  EXPECT_TRUE(line->corners.empty());
}

TEST(AcquireKeyLine, CountsWhatItDrops) {
  RawCurve raw;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (int i = 0; i < 60; ++i) {
    const double t = i / 59.0;
    raw.points.push_back({t, t * t, 0});
    if (i == 10) raw.points.push_back({nan, 0, 0});
    if (i == 20) raw.points.push_back(raw.points.back());
    if (i == 30) raw.points.push_back({t, t * t + 0.2, 0});
  }
  const auto line = acquire_key_line(raw);
  ASSERT_TRUE(line);
  EXPECT_EQ(line->report.points_read, 63u);
  EXPECT_EQ(line->report.non_finite, 1u);
  EXPECT_EQ(line->report.duplicates, 1u);
  EXPECT_EQ(line->report.outliers, 1u);
  EXPECT_EQ(line->report.outlier_sources, (std::vector<std::size_t>{33}));
  EXPECT_EQ(line->points.size(), 60u);
  EXPECT_LT(line->noise, 1e-8);
}

TEST(AcquireKeyLine, MergesManyPointsAtFewPlaces) {
  RawCurve raw;
  for (int i = 0; i < 60000; ++i) {
    const double x = 0.1 * (i * 31 % 70);
    raw.points.push_back({x, 0.05 * x * x, 0});
  }
  const auto line = acquire_key_line(raw);
  ASSERT_TRUE(line);
  EXPECT_EQ(line->points.size(), 70u);
  EXPECT_EQ(line->report.duplicates, 60000u - 70u);
}

TEST(AcquireKeyLine, RecognisesClosedOutlines) {
  RawCurve raw;
  for (int i = 0; i < 40; ++i) {
    const double a = 2 * core::kPi * i / 40;
    raw.points.push_back({std::cos(a), std::sin(a), 0});
  }
  const auto open = acquire_key_line(raw);
  ASSERT_TRUE(open);
  EXPECT_TRUE(open->closed);
  EXPECT_EQ(open->points.size(), 40u);
  raw.points.push_back(raw.points.front());
  const auto repeated = acquire_key_line(raw);
  ASSERT_TRUE(repeated);
  EXPECT_TRUE(repeated->closed);
  EXPECT_EQ(repeated->points.size(), 40u);
}

TEST(AcquireKeyLine, AxisPlanesKeepCoordinates) {
  RawCurve raw;
  raw.has_z = true;
  for (int i = 0; i < 30; ++i) raw.points.push_back({i * 0.1, 0.5, std::sin(i * 0.1)});
  const auto line = acquire_key_line(raw);
  ASSERT_TRUE(line);
  EXPECT_EQ(line->plane.axis_x, (core::Vector3{1, 0, 0}));
  EXPECT_EQ(line->plane.axis_y, (core::Vector3{0, 0, 1}));
  EXPECT_EQ(line->points[7], (core::Point2{0.7000000000000001, std::sin(7 * 0.1)}));
}

/// Half an ellipse: what the windows leave of so few exact points is shape, not noise.
TEST(AcquireKeyLine, FewPointsBendWithoutNoise) {
  for (int n = 5; n < 16; ++n) {
    RawCurve raw;
    for (int i = 0; i < n; ++i) {
      const double t = 3.14159265358979 * i / (n - 1);
      raw.points.push_back({3 * std::cos(t), 2 * std::sin(t), 0});
    }
    const auto line = acquire_key_line(raw, {});
    ASSERT_TRUE(line);
    EXPECT_LE(line->noise, 3.1e-4 * line->length) << n;
  }
}

/// An even grid of abscissae has few decimals, but was not rounded: the ordinates tell.
TEST(AcquireKeyLine, EvenGridIsNoRounding) {
  RawCurve raw;
  for (int i = 0; i < 60; ++i) {
    const double x = i / 20.0;
    raw.points.push_back({x, std::sin(x), 0});
  }
  EXPECT_EQ(estimate_rounding(raw), 0);
  for (core::Point3& p : raw.points) p.y = std::round(1000 * p.y) / 1000;
  EXPECT_EQ(estimate_rounding(raw), 0.001);
}

/// Where an outline is flat, whole pixels leave no residuals for many points; their errors are
/// there all the same. Exact whole numbers leave none anywhere.
TEST(AcquireKeyLine, WholePixelsErrByTheirRoundingHoweverSmallTheOutline) {
  RawCurve raw;
  for (int x = -120; x <= 120; ++x)
    raw.points.push_back({double(x), std::round(60 * std::sqrt(1 - x * x / 14641.0)), 0});
  const auto outline = acquire_key_line(raw, {});
  ASSERT_TRUE(outline);
  EXPECT_GE(outline->noise, 1 / std::sqrt(12.0));
  raw.points.clear();
  for (int x = -20; x <= 20; ++x) raw.points.push_back({double(x), double(x * x), 0});
  const auto exact = acquire_key_line(raw, {});
  ASSERT_TRUE(exact);
  EXPECT_LE(exact->noise, 3.1e-4 * exact->length);
}

/// A parabola's points with normal errors, many times: neither too high nor too low, little
/// scatter.
TEST(EstimateNoise, IsUnbiased) {
  numeric::Random random(3);
  double sum = 0;
  double least = 2;
  double most = 0;
  constexpr int kTimes = 40;
  for (int k = 0; k < kTimes; ++k) {
    std::vector<core::Point2> points;
    for (int i = 0; i < 300; ++i) {
      const double x = i / 300.0;
      points.push_back({x + 1e-3 * random.normal(), 0.3 * x * x + 1e-3 * random.normal()});
    }
    const double found = estimate_noise(points, false) / 1e-3;
    sum += found;
    least = std::min(least, found);
    most = std::max(most, found);
  }
  EXPECT_NEAR(sum / kTimes, 1, 0.04);
  EXPECT_GT(least, 0.75);
  EXPECT_LT(most, 1.25);
}

// A zigzag of known noise: a third and more of the windows hold a corner, so that the mean of what
// is left is theirs, and the median that of the noise.
TEST(EstimateNoise, CornersThatSpoilTheMeanDoNotSpoilTheEstimate) {
  constexpr double kNoise = 0.01;
  numeric::Random random(11);
  std::vector<core::Point2> points;
  core::Point2 at{0, 0};
  for (int side = 0; side < 60; ++side) {
    const core::Vector2 step = core::unit_vector(side % 2 == 0 ? 0.5 : -0.5);
    for (int i = 0; i < 8 + side % 2; ++i) {
      at = at + step;
      const double off = kNoise * random.normal();
      points.push_back(at + off * core::perpendicular_left(step));
    }
  }
  const double found = estimate_noise(points, false);
  EXPECT_GT(found, 0.6 * kNoise);
  EXPECT_LT(found, 2 * kNoise);
}

}  // namespace
}  // namespace keyline::acquire
