#include "keyline/fairing/straight_run.h"

#include <gtest/gtest.h>

namespace keyline::fairing::detail {
namespace {

std::vector<FitPoint> points_on_a_line() {
  std::vector<FitPoint> points;
  for (int i = 0; i <= 40; ++i) {
    const double t = i / 40.0;
    points.push_back({.position = {0.6 * t, 0.8 * t}});
  }
  return points;
}

TEST(StraightRun, IsOneLineFromTheFirstPointToTheLast) {
  const auto points = points_on_a_line();
  const auto chain = straight_chain(points);
  ASSERT_TRUE(chain);
  ASSERT_EQ(chain->pieces.size(), 1u);
  EXPECT_EQ(chain->pieces[0].kind, PieceKind::line);
  EXPECT_NEAR(chain->pieces[0].length, 1, 1e-15);
  for (const double offset : offsets(*chain, points)) EXPECT_NEAR(offset, 0, 1e-15);
}

TEST(StraightRun, IsNoneWherePointsBendOrTurnBack) {
  auto bent = points_on_a_line();
  bent[20].position.x += 1e-9;
  EXPECT_FALSE(straight_chain(bent));
  auto back = points_on_a_line();
  std::swap(back[20], back[21]);
  EXPECT_FALSE(straight_chain(back));
  EXPECT_FALSE(straight_chain({}));
}

}  // namespace
}  // namespace keyline::fairing::detail
