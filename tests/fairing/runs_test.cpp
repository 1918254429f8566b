#include "keyline/fairing/runs.h"

#include <string>

#include <gtest/gtest.h>

/// Key-lines cut at their corners.
namespace keyline::fairing::detail {
namespace {

/// An L of unit steps: (0,0) … (3,0), (3,1), (3,2).
acquire::KeyLine ell() {
  acquire::KeyLine line;
  line.points = {{0, 0}, {1, 0}, {2, 0}, {3, 0}, {3, 1}, {3, 2}};
  line.weights = {1, 2, 3, 4, 5, 6};
  line.corners = {3};
  return line;
}

TEST(Runs, EndAtCornersAndShareThem) {
  FairOptions options;
  options.must_pass = {1, 3, 5};
  options.clamp = {Clamp::g1, Clamp::g2};
  const auto runs = runs_of(ell(), options);
  ASSERT_EQ(runs.size(), 2U);
  EXPECT_EQ(runs[0].index, (std::vector<std::size_t>{0, 1, 2, 3}));
  EXPECT_EQ(runs[1].index, (std::vector<std::size_t>{3, 4, 5}));
  EXPECT_EQ(runs[1].points[0], (core::Point2{3, 0}));
  EXPECT_EQ(runs[0].weights, (std::vector<double>{1, 2, 3, 4}));
  EXPECT_EQ(runs[0].must_pass, (std::vector<std::size_t>{1, 3}));
  EXPECT_EQ(runs[1].must_pass, (std::vector<std::size_t>{0, 2}));
  EXPECT_EQ(runs[0].length, 3);
  EXPECT_EQ(runs[1].length, 2);
  EXPECT_EQ(runs[0].clamp_start, Clamp::g1);
  EXPECT_EQ(runs[0].clamp_end, Clamp::none);
  EXPECT_EQ(runs[1].clamp_start, Clamp::none);
  EXPECT_EQ(runs[1].clamp_end, Clamp::g2);
  EXPECT_FALSE(runs[0].closed);
}

TEST(Runs, CornersAreKeptWhereAskedAndNotAtEnds) {
  FairOptions options;
  options.keep_corners = false;
  EXPECT_EQ(runs_of(ell(), options).size(), 1U);
  options.keep_corners = true;
  acquire::KeyLine line = ell();
  line.corners = {0, 5};
  EXPECT_EQ(runs_of(line, options).size(), 1U);
  line.corners = {1, 4};
  EXPECT_EQ(runs_of(line, options).size(), 3U);
}

acquire::KeyLine square() {
  acquire::KeyLine line;
  line.points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  line.closed = true;
  return line;
}

TEST(Runs, AClosedLineWithoutCornersIsOne) {
  const auto runs = runs_of(square(), {});
  ASSERT_EQ(runs.size(), 1U);
  EXPECT_TRUE(runs[0].closed);
  EXPECT_EQ(runs[0].points.size(), 4U);
  EXPECT_EQ(runs[0].length, 4);
}

TEST(Runs, AClosedLineIsCutOpenAtItsFirstCorner) {
  acquire::KeyLine line = square();
  line.corners = {1, 2};
  const auto runs = runs_of(line, {});
  ASSERT_EQ(runs.size(), 2U);
  EXPECT_EQ(runs[0].index, (std::vector<std::size_t>{1, 2}));
  EXPECT_EQ(runs[1].index, (std::vector<std::size_t>{2, 3, 0, 1}));
  EXPECT_EQ(runs[1].length, 3);
  line.corners = {0};  // the first point of a closed line may be one
  const auto one = runs_of(line, {});
  ASSERT_EQ(one.size(), 1U);
  EXPECT_EQ(one[0].index, (std::vector<std::size_t>{0, 1, 2, 3, 0}));
  EXPECT_FALSE(one[0].closed);
}

// The polygon of dense noisy points is too long: all runs are shorter by the share that the
// key-line knows.
TEST(Runs, LengthsAreTheKeyLinesOwn) {
  acquire::KeyLine line = ell();
  line.length = 4;
  const auto runs = runs_of(line, {});
  EXPECT_NEAR(runs[0].length, 3 * 4 / 5.0, 1e-15);
  EXPECT_NEAR(runs[1].length, 2 * 4 / 5.0, 1e-15);
  line.length = 6;  // longer than the polygon it cannot be
  EXPECT_EQ(runs_of(line, {})[0].length, 3);
  acquire::KeyLine round = square();
  round.length = 3;
  EXPECT_NEAR(runs_of(round, {})[0].length, 3, 1e-15);
}

TEST(Runs, BetweenTwoPointsIsThatPart) {
  const detail::Run run = run_between(ell(), 1, 4);
  EXPECT_EQ(run.index, (std::vector<std::size_t>{1, 2, 3, 4}));
  EXPECT_EQ(run.length, 3);
  EXPECT_TRUE(run.must_pass.empty());
}

// Ends on a border, or beyond it by less than the tolerance, stand on it; of several on all.
TEST(BoundRuns, EndsOnABorderStayThere) {
  acquire::KeyLine line = ell();
  line.corners.clear();
  line.points.front().y = -0.01;
  FairOptions options;
  options.keep_inside = {{Axis::y, 0.0, {}}, {Axis::x, {}, 3.0}};
  auto runs = runs_of(line, options);
  ASSERT_TRUE(bound_runs(runs, line, options, 0.02));
  EXPECT_EQ(runs[0].inside.size(), 2U);
  ASSERT_TRUE(runs[0].tie_start);
  EXPECT_NEAR(core::distance(*runs[0].tie_start, {0, 0}), 0, 1e-15);
  ASSERT_TRUE(runs[0].tie_end);  // (3, 2) stands on x = 3
  EXPECT_NEAR(core::distance(*runs[0].tie_end, {3, 2}), 0, 1e-15);
  // Farther out than the tolerance it is refused by name.
  const auto refused = bound_runs(runs, line, options, 0.009);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().path, "keep_inside");
  EXPECT_NE(refused.error().message.find("(0, -0.01) lies 0.01 outside"), std::string::npos)
      << refused.error().message;
}

TEST(BoundRuns, OnlyOuterEndsThatAreFreeAreTied) {
  acquire::KeyLine line = ell();  // its corner (3, 0) stands on both borders
  FairOptions options;
  options.keep_inside = {{Axis::y, 0.0, {}}};
  auto runs = runs_of(line, options);
  ASSERT_TRUE(bound_runs(runs, line, options, 0.01));
  EXPECT_EQ(runs[1].inside.size(), 1U);
  EXPECT_TRUE(runs[0].tie_start);
  EXPECT_FALSE(runs[0].tie_end);
  EXPECT_FALSE(runs[1].tie_start);
  EXPECT_FALSE(runs[1].tie_end);  // (3, 2) is inside
  options.clamp.start = Clamp::g0;
  runs = runs_of(line, options);
  ASSERT_TRUE(bound_runs(runs, line, options, 0.01));
  EXPECT_FALSE(runs[0].tie_start);
  acquire::KeyLine round = square();
  auto closed = runs_of(round, options);
  ASSERT_TRUE(bound_runs(closed, round, options, 0.01));
  EXPECT_EQ(closed[0].inside.size(), 1U);
  EXPECT_FALSE(closed[0].tie_start);
  EXPECT_FALSE(closed[0].tie_end);
  round.corners = {0, 2};
  auto parts = runs_of(round, options);
  ASSERT_TRUE(bound_runs(parts, round, options, 0.01));
  EXPECT_FALSE(parts[0].tie_start);
}

}  // namespace
}  // namespace keyline::fairing::detail
