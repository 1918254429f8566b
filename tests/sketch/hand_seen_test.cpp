#include "keyline/sketch/hand_seen.h"

#include <vector>

#include <gtest/gtest.h>

#include "keyline/sketch/consolidate.h"

namespace keyline::sketch {
namespace {

using core::Point2;

/// Straight passes of lines 500 long, so far apart, at these heights.
std::vector<DrawnStroke> drawn(const std::vector<double>& heights, double apart) {
  std::vector<DrawnStroke> strokes;
  for (const double y : heights)
    for (int pass = 0; pass < 3; ++pass) {
      DrawnStroke stroke;
      for (int x = 0; x <= 500; x += 5) stroke.points.push_back({1.0 * x, y + apart * pass});
      strokes.push_back(stroke);
    }
  return strokes;
}

std::vector<SampledStroke> sampled(const std::vector<DrawnStroke>& strokes) {
  std::vector<SampledStroke> all;
  for (const DrawnStroke& s : strokes) all.push_back(sample_stroke(s.points, s.closed, 4));
  return all;
}

TEST(HandSeen, IsFiveTimesWhatPassesLieApartAndTenTimesAsAShare) {
  const PassModel model{.width = 4};
  const PassReach reach = hand_seen(sampled(drawn({0, 200}, 2)), model);
  EXPECT_NEAR(reach.seen.hand, 10 * 2 / 500.0, 1e-9);
  EXPECT_NEAR(reach.seen.apart, 5 * 2 / 4.0, 1e-9);
  ASSERT_EQ(reach.of_stroke.size(), 6U);
  for (const double far : reach.of_stroke) EXPECT_NEAR(far, 10 * 2, 1e-9);
  EXPECT_EQ(reach.at_most.apart, model.apart);
  // in any unit
  std::vector<DrawnStroke> small = drawn({0, 200}, 2);
  for (DrawnStroke& s : small)
    for (Point2& p : s.points) p = {p.x / 1000, p.y / 1000};
  std::vector<SampledStroke> strokes;
  for (const DrawnStroke& s : small) strokes.push_back(sample_stroke(s.points, false, 0.004));
  const PassModel seen = hand_seen(strokes, {.width = 0.004}).seen;
  EXPECT_NEAR(seen.hand, 10 * 2 / 500.0, 1e-9);
  EXPECT_NEAR(seen.apart, 5 * 2 / 4.0, 1e-9);
}

TEST(HandSeen, IsTheModelsAtMostAndWhereNothingRunsBesideAnything) {
  const PassModel model{.width = 4};
  const PassModel loose = hand_seen(sampled(drawn({0}, 10)), model).seen;
  EXPECT_EQ(loose.hand, model.hand);
  EXPECT_EQ(loose.apart, model.apart);
  EXPECT_EQ(hand_seen(sampled(drawn({0, 100, 200}, 0)), {.width = 4, .hand = 0}).seen.hand, 0);
  const DrawnStroke alone{{{0, 0}, {100, 0}}, false};
  const PassReach reach = hand_seen(sampled({alone}), model);
  EXPECT_EQ(reach.seen.hand, model.hand);
  EXPECT_EQ(reach.seen.apart, model.apart);
  EXPECT_GT(reach.of_stroke.at(0), 1e300);
}

// Strokes of a file saved twice lie on each other: lines whose ink touches are still passes.
TEST(HandSeen, IsAWidthAtLeast) {
  EXPECT_EQ(hand_seen(sampled(drawn({0, 100}, 0)), {.width = 4}).seen.apart, 1);
  EXPECT_EQ(consolidate(drawn({0, 100}, 0), {.width = 4}).size(), 2U);
}

TEST(HandSeen, KeepsACarefulHandsLinesApartAndALooseOnesTogether) {
  // two lines 30 apart of length 500: as passes of a loose hand may lie
  EXPECT_EQ(consolidate(drawn({0, 30}, 1.5), {.width = 4}).size(), 2U);
  EXPECT_EQ(consolidate(drawn({0}, 15), {.width = 4}).size(), 1U);
}

std::vector<DrawnStroke> joined(std::vector<DrawnStroke> a, const std::vector<DrawnStroke>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// Hatches two and a half widths apart beside lines whose passes lie a quarter of a width apart.
TEST(HandSeen, KeepsHatchesOfACarefulHandApart) {
  std::vector<DrawnStroke> drawing = drawn({0, 200}, 1);
  for (int i = 0; i < 6; ++i)
    drawing.push_back({{{100.0 + 10 * i, 40}, {80.0 + 10 * i, 90}}, false});
  EXPECT_EQ(consolidate(drawing, {.width = 4}).size(), 2U + 6U);
}

// The same double line is one line of a drawing in which all is as loose as that, and two where
// each of both has passes of its own close by.
TEST(HandSeen, KeepsLinesApartThatHavePassesOfTheirOwn) {
  const std::vector<DrawnStroke> loose = drawn({300, 600, 900, 1200}, 12);
  EXPECT_EQ(count_lines(joined(drawn({0}, 12), loose), {.width = 4}), 5U);
  EXPECT_EQ(count_lines(joined(drawn({0, 25}, 1), loose), {.width = 4}), 6U);
}

}  // namespace
}  // namespace keyline::sketch
