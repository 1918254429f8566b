#include "keyline/document/join.h"

#include <algorithm>
#include <array>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace keyline::document {
namespace {

using Points = std::vector<core::Point2>;

Path line(Points points) { return {{{curve::Polyline2{std::move(points)}}}, false}; }

/// Whether each member begins where the one before it ends.
bool hangs_together(const Path& path) {
  for (std::size_t i = 1; i < path.curves.size(); ++i)
    if (evaluate(path.curves[i - 1], 1) != evaluate(path.curves[i], 0)) return false;
  return true;
}

// Both begin at the origin: the path begins with the first of them, from its end.
TEST(Joined, TurnsTheFirstRoundWhereItsStartMeetsAnother) {
  const Path first = line({{0, 0}, {1, 0}});
  const Path second = line({{0, 0}, {0, 2}});
  const auto made = joined({first, second}, 1e-6);
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_EQ(made->reversed, std::vector<std::size_t>{0});
  EXPECT_EQ(evaluate(made->path, 0), (core::Point2{1, 0}));
  EXPECT_EQ(evaluate(made->path, 0.5), (core::Point2{0, 0}));
  EXPECT_EQ(evaluate(made->path, 1), (core::Point2{0, 2}));
  EXPECT_FALSE(joined({first, line({{3, 3}, {4, 4}})}, 1e-6));
}

// Two straight lines with a loop of two curves where they meet: in whatever order and direction
// they come, a path begins with either line and takes the loop on its way; none begins with the
// loop, which leaves one line over.
TEST(Joined, TakesALoopOnItsWay) {
  const std::vector<Points> all{
      {{0, 0}, {1, 0}}, {{1, 0}, {2, 0}}, {{1, 0}, {1, 1}, {0.5, 1}}, {{0.5, 1}, {1, 0}}};
  std::array<std::size_t, 4> order{0, 1, 2, 3};
  do {
    for (unsigned turned = 0; turned < 16; ++turned) {
      std::vector<Path> given;
      for (const std::size_t i : order) {
        Points points = all[i];
        if (turned >> i & 1U) std::ranges::reverse(points);
        given.push_back(line(points));
      }
      const auto made = joined(given, 1e-9);
      ASSERT_EQ(made.has_value(), order[0] < 2);
      if (!made) continue;
      EXPECT_EQ(made->path.curves.size(), 4U);
      EXPECT_TRUE(hangs_together(made->path));
      const core::Point2 begin{order[0] == 0 ? 0.0 : 2.0, 0};
      EXPECT_EQ(evaluate(made->path, 0), begin);
      EXPECT_FALSE(made->path.closed);
    }
  } while (std::ranges::next_permutation(order).found);
}

// Walks at random between five places, no step taken twice: whatever the order of the steps and
// their directions, there is a path that begins with the first.
TEST(Joined, FindsAWayThroughTheStepsOfAWalk) {
  const Points places{{0, 0}, {4, 0}, {5, 3}, {2, 5}, {-1, 3}};
  std::mt19937 random(11);
  for (int n = 0; n < 200; ++n) {
    std::vector<Path> steps;
    std::size_t at = random() % 5;
    const std::size_t count = 2 + random() % 30;
    while (steps.size() < count) {
      const std::size_t to = (at + 1 + random() % 4) % 5;
      const core::Point2 by{static_cast<double>(steps.size()), 7};  // that no two steps are one
      Points step{places[at], by, places[to]};
      if (random() % 2 == 0) std::ranges::reverse(step);
      steps.push_back(line(step));
      at = to;
    }
    std::shuffle(steps.begin() + 1, steps.end(), random);
    const auto made = joined(steps, 1e-9);
    ASSERT_TRUE(made) << n << ": " << made.error().message;
    EXPECT_EQ(made->path.curves.size(), count);
    EXPECT_TRUE(hangs_together(made->path));
    EXPECT_EQ(made->gap, 0);
    const auto& first = std::get<curve::Polyline2>(made->path.curves[0].value);
    EXPECT_EQ(first.points[1], (core::Point2{0, 7}));
  }
}

// A curve that meets the others only at one end, where they pass, is left over.
TEST(Joined, IsRefusedWhereACurveBranchesOff) {
  const auto made =
      joined({line({{0, 0}, {1, 0}}), line({{1, 0}, {3, 0}}), line({{1, 0}, {1, 1}})}, 1e-9);
  ASSERT_FALSE(made);
  EXPECT_NE(made.error().message.find("is 2 away from (3, 0)"), std::string::npos)
      << made.error().message;
}

}  // namespace
}  // namespace keyline::document
