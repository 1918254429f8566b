#include "keyline/lac/space/space_graphs.h"

#include <utility>

#include <gtest/gtest.h>

#include "keyline/lac/space/space.h"

namespace keyline::lac {
namespace {

// The graphs of a log-aesthetic curve are lines of its slopes, whatever the curve is cut into.
TEST(SpaceGraphs, OfQuinticsAreLinesOfTheSlopes) {
  for (const auto& [alpha, beta] : {std::pair{-1.0, 0.5}, {0.5, -1.0}, {2.0, 1.0}, {-2.0, 2.0}})
    for (const double size : {1.0, 40.0}) {
      SCOPED_TRACE(alpha);
      const SpaceChain chain{
          {}, {{alpha, beta, 3 * size, 1 / size, 0.3 / size, 0.2 / size, 0.7 / size}}};
      const GraphLines lines = graph_lines(approximate_by_quintics(chain, 1e-10 * size).pieces);
      ASSERT_TRUE(lines.curvature && lines.torsion);
      EXPECT_NEAR(lines.curvature->slope, alpha, 1e-4);
      EXPECT_LT(lines.curvature->variance, 1e-6);
      EXPECT_NEAR(lines.torsion->slope, beta, 0.02);
      EXPECT_LT(lines.torsion->variance, 0.02);
    }
}

}  // namespace
}  // namespace keyline::lac
