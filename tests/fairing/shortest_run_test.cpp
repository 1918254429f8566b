#include "keyline/fairing/shortest_run.h"

#include <cmath>

#include <gtest/gtest.h>

namespace keyline::fairing::detail {
namespace {

Run bow() {
  Run run;
  for (int i = 0; i < 20; ++i) run.points.push_back({0.1 * i, std::sin(0.1 * i)});
  run.length = 2.3;
  return run;
}

RunResult of_pieces(int pieces) {
  RunResult result;
  result.start_pieces = pieces;
  return result;
}

TEST(FoundBefore, IsOfTheSameRunToleranceAndKindAlone) {
  FoundBefore before;
  EXPECT_FALSE(before.find(Sought::shortest, bow(), 0.01));
  before.keep(Sought::shortest, bow(), 0.01, of_pieces(3));
  before.keep(Sought::exact, bow(), 0.01, of_pieces(7));
  EXPECT_EQ(before.find(Sought::shortest, bow(), 0.01)->start_pieces, 3);
  EXPECT_EQ(before.find(Sought::exact, bow(), 0.01)->start_pieces, 7);
  EXPECT_FALSE(before.find(Sought::shortest, bow(), 0.02));
  detail::Run tied = bow();
  tied.tie_end = core::Point2{2, 1};
  EXPECT_FALSE(before.find(Sought::shortest, tied, 0.01));
  detail::Run moved = bow();
  moved.points[7].y += 1e-15;
  EXPECT_FALSE(before.find(Sought::shortest, moved, 0.01));
}

}  // namespace
}  // namespace keyline::fairing::detail
