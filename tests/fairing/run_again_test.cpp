#include "keyline/fairing/run_again.h"

#include <cmath>

#include <gtest/gtest.h>

#include "keyline/core/angle.h"

namespace keyline::fairing::detail {
namespace {

/// A quarter of the unit circle from the origin, to the left: it ends in (1, 1).
RunResult quarter() {
  RunResult result;
  const double half = core::kPi / 2;
  result.fit.joints = {{{0, 0}, 0, 1}, {{1, 1}, half, 1}};
  result.fit.pieces = {{half, -1, PieceKind::arc}};
  result.chain = {{{0, 0}, 0}, {{-1, half, 1, 1}}, false};
  return result;
}

TEST(RunAgain, TellsByHowMuchABorderIsPassed) {
  const RunResult result = quarter();
  detail::Run run;
  EXPECT_TRUE(stays_inside(result, run));
  EXPECT_EQ(passed_most(result, run), 0);
  run.inside = {{{0, 1}, -0.1}};  // above y = -0.1
  EXPECT_TRUE(stays_inside(result, run));
  run.inside.push_back({{-1, 0}, -0.9});  // left of x = 0.9
  EXPECT_FALSE(stays_inside(result, run));
  EXPECT_NEAR(passed_most(result, run), 0.1, 1e-12);
  run.inside = {{{0, 1}, 0.25}};  // above y = 0.25, where it does not start
  EXPECT_FALSE(stays_inside(result, run));
  EXPECT_NEAR(passed_most(result, run), 0.25, 1e-12);
}

// Points at y = 0.2, a border at 0.1 and a margin of 0.05: the curve may lie 0.05 below them, in
// whatever unit it is solved.
TEST(RunAgain, MarginsAreInTheUnitOfThePoints) {
  for (const double scale : {1.0, 4.0}) {
    RunResult result;
    result.to_canonical.scale = scale;
    for (int i = 0; i < 9; ++i)
      result.points.push_back({.position = {scale * 0.05 * i, scale * 0.2}});
    detail::Run run;
    run.inside = {{{0, 1}, 0.1}};
    run.margin = {0.05};
    watch_borders(result, run, scale * 0.01);
    for (const FitPoint& p : result.points) {
      EXPECT_NEAR(p.highest, p.share * scale * 0.05, 1e-12) << scale;
      EXPECT_EQ(p.lowest, -HUGE_VAL);
    }
  }
}

}  // namespace
}  // namespace keyline::fairing::detail
