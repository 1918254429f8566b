#include "keyline/fairing/free_ends.h"

#include <vector>

#include <gtest/gtest.h>

namespace keyline::fairing::detail {
namespace {

constexpr int kSteps = 200;
constexpr double kError = 0.003;

/// Points 0.01 apart along the x axis, whose first one errs inwards, and a line from that one on.
struct Line {
  Run run;
  RunResult result;
  RunOptions options;
  Line() {
    const double length = 0.01 * kSteps - kError;
    for (int i = 0; i <= kSteps; ++i) {
      run.points.push_back({i == 0 ? kError : 0.01 * i, i % 2 == 0 ? 1e-4 : -1e-4});
      result.points.push_back({.position = run.points.back()});
      result.point_of.push_back(static_cast<std::size_t>(i));
      result.fit.feet.push_back({0, (run.points.back().x - kError) / length});
    }
    result.chain = {{{kError, 0}, 0}, {{-1, length, 0, 0}}, false};
    result.accept = {.tolerance = 4 * kError, .noise = kError};
    options.noise = kError;
    options.tolerance = 4 * kError;
  }
};

// A line of least squares through n even values takes 2 (2n - 1) / (n (n + 1)) of an error of the
// first over to its own first value.
TEST(FreeEnds, StandWhereTwoDozenPointsSay) {
  Line line;
  place_free_ends(line.result, line.run, line.options);
  EXPECT_NEAR(line.result.chain.start.position.x, kError * 2 * 47 / (24 * 25.0), 1e-12);
  EXPECT_NEAR(lac::end_pose(line.result.chain).position.x, 2, 1e-12);
}

TEST(FreeEnds, StayWhereTheyAreHeld) {
  Line line;
  line.run.clamp_start = Clamp::g1;
  place_free_ends(line.result, line.run, line.options);
  EXPECT_EQ(line.result.chain.start.position.x, kError);
}

}  // namespace
}  // namespace keyline::fairing::detail
