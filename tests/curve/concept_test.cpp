#include "keyline/curve/concept.h"

#include <gtest/gtest.h>

#include "keyline/curve/bezier.h"

namespace keyline::curve {
namespace {

TEST(Sample, IsEvenFromEndToEnd) {
  const Bezier2 line{{{0, 1}, {8, 5}}, {}};
  for (const int n : {2, 3, 5, 9}) {
    const auto points = sample(line, n);
    ASSERT_EQ(points.size(), static_cast<std::size_t>(n));
    for (int i = 0; i < n; ++i) {
      const double t = i / (n - 1.0);
      EXPECT_LT(distance(points[static_cast<std::size_t>(i)], {8 * t, 1 + 4 * t}), 1e-15);
    }
  }
  EXPECT_EQ(sample(line, 1), (std::vector<core::Point2>{{0, 1}}));
  EXPECT_TRUE(sample(line, 0).empty());
}

}  // namespace
}  // namespace keyline::curve
