#include "keyline/lac/g2/rate_run.h"

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/lac/chain/chain.h"

namespace keyline::lac::detail {
namespace {

void expect_one_rate(const std::vector<Parts>& made, const std::vector<Piece>& run) {
  ASSERT_EQ(made.size(), run.size());
  std::optional<Piece> before;
  for (std::size_t i = 0; i < run.size(); ++i) {
    EXPECT_EQ(made[i].front().curvature_start, run[i].curvature_start);
    EXPECT_EQ(made[i].back().curvature_end, run[i].curvature_end);
    Chain given{{}, {run[i]}, false}, parts{{}, made[i], false};
    EXPECT_LT(distance(end_pose(given).position, end_pose(parts).position), 1e-9);
    EXPECT_NEAR(end_pose(given).direction, end_pose(parts).direction, 1e-9);
    for (const Piece& p : made[i]) {
      if (before) {
        const double left = curvature_rate(*before, 1), right = curvature_rate(p, 0);
        EXPECT_NEAR(left, right, 1e-7 * std::abs(right));
      }
      before = p;
    }
  }
}

TEST(RateRun, CutsOnceMoreWhereCurvatureIsNoneAtAJoint) {
  const std::vector<Piece> plain{{-1, 1, 0.2, 0.5}, {-1, 1.2, 0.5, 0.9}};
  const std::vector<Piece> through{{-1, 1, -0.8, 0}, {-1, 1.2, 0, 0.9}};
  const std::vector<Piece> from_none{{-1, 1, 0, 0.5}, {-1, 1.2, 0.5, 0.9}};  // an end, no joint
  for (const auto& [run, parts] : {std::pair{plain, 3u}, {through, 4u}, {from_none, 3u}}) {
    const auto made = solve_rate_run(run, {3, 1});
    ASSERT_TRUE(made);
    expect_one_rate(*made, run);
    for (const Parts& p : *made) EXPECT_EQ(p.size(), parts);
  }
}

}  // namespace
}  // namespace keyline::lac::detail
