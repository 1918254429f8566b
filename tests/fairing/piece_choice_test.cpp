#include "keyline/fairing/piece_choice.h"

#include <gtest/gtest.h>

/// Which of several sets of pieces a calm curve gets, told by their lengths.
namespace keyline::fairing::detail {
namespace {

struct Trial {
  double length;
  bool within;
  double max_offset;
  double excess;
};

double chosen(std::initializer_list<Trial> trials) {
  CalmRun run;
  PieceChoice choice(run, 0);
  for (const Trial& t : trials) {
    DenseCurve curve;
    curve.length = t.length;
    choice.offer(curve, {.within = t.within, .max_offset = t.max_offset}, t.excess);
  }
  EXPECT_FALSE(choice.done());
  return run.curve.length;
}

TEST(PieceChoice, BeforeAnyIsGoodItIsOfLeastExcess) {
  EXPECT_EQ(chosen({{1, true, 1, 1.3}, {2, true, 1, 1.1}, {3, true, 1, 1.2}}), 2);
  EXPECT_EQ(chosen({{1, true, 1, 1.1}, {2, false, 0.5, 0.2}, {3, true, 1, 1.4}}), 1);
}

TEST(PieceChoice, OutsideTheToleranceTheNearestIsKeptUntilOneIsWithin) {
  EXPECT_EQ(chosen({{1, false, 3, 1}, {2, false, 2, 9}, {3, false, 2.5, 0.5}}), 2);
  EXPECT_EQ(chosen({{1, false, 3, 0.1}, {2, true, 4, 7}, {3, false, 1, 0.1}}), 2);
}

}  // namespace
}  // namespace keyline::fairing::detail
