#include "true_curves.h"

#include <cstdlib>

#include <gtest/gtest.h>

#include "judge.h"
#include "real_input.h"
#include "truth.h"

namespace keyline::fairing {
namespace {

using testing::TrueCurve;

/// All of them in the full tier and where there is no real input; else every third.
std::size_t step() { return std::getenv("KEYLINE_FULL") || !testing::real_files_present() ? 1 : 3; }

std::vector<core::Point2> places_on(const FairResult& result) {
  std::vector<core::Point2> places;
  for (const FairCurve& curve : result.curves)
    for (const core::Point2 p : lac::sample(std::get<lac::Chain>(curve), 200)) places.push_back(p);
  return places;
}

// What the judges ask of real input, and what only a known truth can tell: in the mean the answer
// is nearer to it than the points, and at its worst place within what single points may be off.
TEST(TrueCurves, CarryTheJudgesOfRealInput) {
  const auto curves = testing::true_curves();
  for (std::size_t i = 0; i < curves.size(); i += step()) {
    const TrueCurve& curve = curves[i];
    SCOPED_TRACE(curve.name);
    const auto line = testing::line_through(curve.points);
    const auto result = fair(line);
    ASSERT_TRUE(result) << result.error().message;
    EXPECT_EQ(result->closed, curve.closed);
    EXPECT_EQ(testing::judge(*result, line.points).fault, "");
    const testing::Away away = testing::away_from(curve, places_on(*result));
    if (curve.noise > 0) {
      EXPECT_LE(away.rms, curve.noise);
      // Beside the involute's cusp and at the section's nose it is 5.8 and 4.8; elsewhere below 4.
      EXPECT_LE(away.largest, 6 * curve.noise);
    } else {
      EXPECT_LE(away.largest, 1.1 * result->tolerance);  // which is kept at points, not between
    }
  }
}

}  // namespace
}  // namespace keyline::fairing
