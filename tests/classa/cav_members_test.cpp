// The members that failures of curve aesthetic values name.
#include <vector>

#include <gtest/gtest.h>

#include "keyline/classa/cav.h"
#include "keyline/core/angle.h"

namespace keyline::classa {
namespace {

using core::ErrorCode;
using core::kPi;

const MatrixCurve kOya{{0, 0}, {1, 2}, 1, {kPi / 4, 1.05}, 3};

TEST(CavMembers, RangesAreNamedAsTheyAreAskedFor) {
  CavOptions options;
  options.alpha = core::Interval{0, 2};
  EXPECT_EQ(cav(kOya, options).error().path, "alpha_range");
  options.alpha = core::Interval{0, 0.01};
  EXPECT_EQ(cav(kOya, options).error().code, ErrorCode::undrawable);
  EXPECT_EQ(cav(kOya, options).error().path, "alpha_range");
  options = {};
  options.s = {2, 1};
  EXPECT_EQ(cav(kOya, options).error().path, "s_range");
}

/// A pentagon: one matrix, and closed.
TEST(CavMembers, PointsAreAtFaultWhereTheyAreClosed) {
  CavOptions options;
  options.alpha_max = 1.5;
  curve::Bezier2 pentagon = to_bezier(MatrixCurve{{0, 0}, {1, 0}, 1, {0.4 * kPi, 1}, 5});
  pentagon.control.back() = pentagon.control.front();
  const auto closed = cav(pentagon, options);
  ASSERT_FALSE(closed);
  EXPECT_EQ(closed.error().code, ErrorCode::undrawable);
  EXPECT_EQ(closed.error().path, "points");
}

TEST(CavMembers, EndTolerancesBelongBelowTheChordInSpaceToo) {
  const std::vector<core::Point3> twisted{{0, 0, 0}, {1, 2, 0}, {0, 4, 3}, {-2, 5, 1}};
  CavOptions options;
  options.end_tolerance = 100;
  EXPECT_EQ(cav(twisted, options).error().path, "end_tolerance");
}

}  // namespace
}  // namespace keyline::classa
