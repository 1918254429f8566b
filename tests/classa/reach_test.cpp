#include "keyline/classa/reach.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace keyline::classa::detail {
namespace {

Frame falling(int degree, double low, double high) {
  return {degree, 0, 0, {low, high}, {0.01, 100}, false};
}

/// Alpha at which the curve whose edges shrink as fast as turning allows (s = cos alpha) ends
/// farthest round, by looking at a hundred thousand places.
double alpha_of_top(const Frame& f) {
  double best = 0;
  for (int i = 1; i < 100000; ++i) {
    const double alpha = 1.5 * i / 100000;
    if (f.highest_angle(alpha) > f.highest_angle(best)) best = alpha;
  }
  return best;
}

// With two edges the end's angle is atan(sin cos / (1 + cos^2)), largest where tan^2 alpha = 2.
TEST(ReachTable, HoldsTheTopThatLiesBetweenTwoCells) {
  EXPECT_NEAR(alpha_of_top(falling(2, 0, 1.5)), std::atan(std::sqrt(2.0)), 2e-5);
  for (const int degree : {2, 3, 5, 8}) {
    SCOPED_TRACE(degree);
    const Frame f = falling(degree, 0, 1.5);
    const double top = f.highest_angle(alpha_of_top(f));
    const ReachTable table = tabulate(f);
    EXPECT_NEAR(*std::max_element(table.highest.begin(), table.highest.end()), top, 1e-9);
    EXPECT_TRUE(std::is_sorted(table.alpha.begin(), table.alpha.end()));
  }
}

TEST(ReachTable, StaysInItsRangeWhereTheTopLiesOutside) {
  for (const int degree : {2, 3, 5, 8}) {
    SCOPED_TRACE(degree);
    const double top = alpha_of_top(falling(degree, 0, 1.5));
    for (const core::Interval& range :
         {core::Interval{top + 0.1, top + 0.4}, {0.5 * top, 0.9 * top}}) {
      const Frame f = falling(degree, range.low, range.high);
      const ReachTable table = tabulate(f);
      EXPECT_EQ(table.alpha.front(), range.low);
      EXPECT_EQ(table.alpha.back(), range.high);
      for (std::size_t i = 1; i < table.alpha.size(); ++i)
        EXPECT_NEAR(table.alpha[i] - table.alpha[i - 1], (range.high - range.low) / 48, 1e-12);
    }
  }
}

}  // namespace
}  // namespace keyline::classa::detail
