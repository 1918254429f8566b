#include "keyline/fairing/guides.h"

#include <gtest/gtest.h>

#include "keyline/fairing/between_points.h"

namespace keyline::fairing::detail {
namespace {

// Two in a gap, at thirds of the curve between, where a tenth of the gap is more than twice the
// tolerance.
TEST(Guides, AreTwoInAGapThatIsWideForTheTolerance) {
  std::vector<FitPoint> points;
  std::vector<core::Point2> places;
  for (const core::Point2 p : {core::Point2{0, 0}, {1, 0}, {1.1, 0.2}, {1.2, 1.2}}) {
    points.push_back({.position = p});
    places.push_back(p);
  }
  const auto open = with_guides(points, false, 0.04);
  ASSERT_EQ(open.size(), 8U);  // in the first and the last gap
  for (const std::size_t i : {0U, 1U}) {
    const core::Point2 first = between_points(places, false, 0, (1.0 + double(i)) / 3);
    EXPECT_NEAR(core::distance(open[1 + i].position, first), 0, 1e-15);
    EXPECT_EQ(open[1 + i].count, 0);
    EXPECT_NEAR(open[1 + i].share, 0.04 / 0.1, 1e-14);
    const core::Point2 last = between_points(places, false, 2, (1.0 + double(i)) / 3);
    EXPECT_NEAR(core::distance(open[5 + i].position, last), 0, 1e-15);
  }
  EXPECT_EQ(open[3].position, places[1]);
  EXPECT_EQ(open[7].position, places[3]);
  EXPECT_EQ(with_guides(points, true, 0.04).size(), 10U);  // the closing gap too
  EXPECT_EQ(with_guides(points, false, 0.0499).size(), 8U);
  EXPECT_EQ(with_guides(points, false, 0.0505).size(), 4U);
}

}  // namespace
}  // namespace keyline::fairing::detail
