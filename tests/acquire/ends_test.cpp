#include "keyline/acquire/ends.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/acquire/acquire.h"
#include "keyline/core/angle.h"
#include "keyline/numeric/random.h"

namespace keyline::acquire {
namespace {

KeyLine line_through(std::vector<core::Point3> points) {
  RawCurve raw;
  raw.points = std::move(points);
  return acquire_key_line(raw).value();
}

/// How often an outline is open, whatever point of it comes first and whichever way it runs.
int open_starts(std::vector<core::Point3> outline) {
  int open = 0;
  for (const bool back : {false, true}) {
    if (back) std::ranges::reverse(outline);
    for (std::size_t start = 0; start < outline.size(); ++start) {
      std::ranges::rotate(outline, outline.begin() + 1);
      open += line_through(outline).closed ? 0 : 1;
    }
  }
  return open;
}

// Round the end of an ellipse, and of a sole with a waist, few points turn much at each: from step
// to step more, which the edge of a blunt tail does not.
TEST(RecogniseEnds, OutlinesOfFewPointsAreClosedWhereverTheyStart) {
  for (const int count : {20, 24, 28, 32, 40}) {
    std::vector<core::Point3> ellipse, sole;
    for (int i = 0; i < count; ++i) {
      const double t = 2 * core::kPi * i / count;
      ellipse.push_back({2.5 * std::cos(t), std::sin(t), 0});
      const double waist = 1 - 0.3 * std::cos(2 * t);
      sole.push_back({3 * std::cos(t), waist * std::sin(t), 0});
    }
    EXPECT_EQ(open_starts(ellipse), 0) << count;
    EXPECT_EQ(open_starts(sole), 0) << count;
  }
}

/// So many places of an ellipse of that width, evenly along it, the first a share of a step on from
/// its tip.
std::vector<core::Point3> even_ellipse(double width, int count, double start) {
  constexpr int kFine = 20000;
  const auto at = [&](int i) {
    const double t = 2 * core::kPi * i / kFine;
    return core::Point3{width * std::cos(t), std::sin(t), 0};
  };
  std::vector<double> length{0};
  for (int i = 1; i <= kFine; ++i) length.push_back(length.back() + distance(at(i - 1), at(i)));
  std::vector<core::Point3> points;
  for (int k = 0; k < count; ++k) {
    const double along = (k + start) / count * length.back();
    points.push_back(
        at(static_cast<int>(std::ranges::lower_bound(length, along) - length.begin())));
  }
  return points;
}

// Evenly spaced points are few at the tips: what a vertex turns there is three times what those
// beside it do, and these three times what the next do.
TEST(RecogniseEnds, ATipThatPointsComeToMoreAndMoreTurnedIsNoCorner) {
  EXPECT_EQ(open_starts(even_ellipse(3, 16, 0)), 0);
  for (const double width : {2.0, 3.0, 4.0})
    for (const int count : {20, 24, 32, 40})
      for (const double start : {0.0, 0.2, 0.5, 0.7})
        EXPECT_EQ(open_starts(even_ellipse(width, count, start)), 0) << width << " " << count;
}

// Two thin sides and the tail between them, about as high as a step: each of its corners turns by
// itself.
TEST(RecogniseEnds, ABluntTailStaysOpen) {
  for (const int count : {12, 20}) {
    for (const double noise : {0.0, 5e-4}) {
      numeric::Random random(static_cast<std::uint64_t>(count));
      std::vector<core::Point3> tail;
      for (int i = -count; i <= count; ++i) {
        const double x = std::sin(core::kPi / 2 * std::abs(i) / count);
        const double half = 0.12 * std::sqrt(x) * (1 - 0.9 * x);
        tail.push_back(
            {x + noise * random.normal(), (i < 0 ? half : -half) + noise * random.normal(), 0});
      }
      const KeyLine line = line_through(tail);
      EXPECT_FALSE(line.closed) << count << " " << noise;
      EXPECT_NE(line.report.notes.back().find("blunt edge"), std::string::npos) << count;
    }
  }
}

}  // namespace
}  // namespace keyline::acquire
