#include "keyline/sketch/hand_share.h"

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

TEST(HandShare, IsTenTimesWhatPassesLieApart) {
  const PassModel model{.width = 4};
  EXPECT_NEAR(hand_share(sampled(drawn({0, 200}, 2)), model), 10 * 2 / 500.0, 1e-9);
  // in any unit
  std::vector<DrawnStroke> small = drawn({0, 200}, 2);
  for (DrawnStroke& s : small)
    for (Point2& p : s.points) p = {p.x / 1000, p.y / 1000};
  std::vector<SampledStroke> strokes;
  for (const DrawnStroke& s : small) strokes.push_back(sample_stroke(s.points, false, 0.004));
  EXPECT_NEAR(hand_share(strokes, {.width = 0.004}), 10 * 2 / 500.0, 1e-9);
}

TEST(HandShare, IsTheModelsAtMostAndWhereNothingRunsBesideAnything) {
  const PassModel model{.width = 4};
  EXPECT_EQ(hand_share(sampled(drawn({0}, 10)), model), model.hand);
  EXPECT_EQ(hand_share(sampled(drawn({0, 100, 200}, 0)), {.width = 4, .hand = 0}), 0);
  const DrawnStroke alone{{{0, 0}, {100, 0}}, false};
  EXPECT_EQ(hand_share(sampled({alone}), model), model.hand);
}

TEST(HandShare, KeepsACarefulHandsLinesApartAndALooseOnesTogether) {
  // two lines 30 apart of length 500: as passes of a loose hand may lie
  EXPECT_EQ(consolidate(drawn({0, 30}, 1.5), {.width = 4}).size(), 2U);
  EXPECT_EQ(consolidate(drawn({0}, 15), {.width = 4}).size(), 1U);
}

}  // namespace
}  // namespace keyline::sketch
