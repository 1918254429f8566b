#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/fairing/rise_barrier.h"

#include "rise_limits.h"

/// Curvatures that keep to their side of zero while a curve is solved for.
namespace keyline::fairing::detail {
namespace {

// A side is a limit on the curvature itself: of a piece's start, and of where an open curve ends.
TEST(RiseBarrier, SidesLimitCurvatures) {
  DenseCurve curve = of({1, -2, 0.5, 4}, {});
  curve.side = {1, -1, 0, 1};
  RiseBarrier barrier(curve, 0.2);
  EXPECT_EQ(barrier.count(), 3);
  std::vector<std::array<double, 5>> found;
  for (std::size_t p = 0; p < 3; ++p)
    barrier.each_pull(p, [&](double start, double end, const Pull& pull) {
      found.push_back({double(p), start, end, pull.weight, pull.slope});
    });
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[0], (std::array<double, 5>{0, 1, 0, 0.2, -0.2}));
  EXPECT_EQ(found[1], (std::array<double, 5>{1, -1, 0, 0.2 / 2 / 2, -0.2 / 2}));
  EXPECT_EQ(found[2], (std::array<double, 5>{2, 0, 1, 0.2 / 4 / 4, -0.2 / 4}));
  EXPECT_NEAR(barrier.longest({{-2, 0}, {0, 0}, {0, 0}}), 0.995 / 2, 1e-14);
  EXPECT_NEAR(barrier.longest({{0, 9}, {8, 9}, {9, 0}}), 0.995 * 2 / 8, 1e-14);
  EXPECT_NEAR(barrier.longest({{0, 0}, {0, 0}, {0, -16}}), 0.995 * 4 / 16, 1e-14);
  EXPECT_NEAR(barrier.merit([&] {
    DenseCurve moved = curve;
    moved.value = {3, -1, -7, 2};
    return moved;
  }()),
              -0.2 * std::log(3 * 0.5 * 0.5), 1e-14);
}

// An arc's end bends as its start: one limit, with the side of either.
TEST(RiseBarrier, AnArcHasOneCurvature) {
  DenseCurve curve = of({1, 2, 2}, {});
  curve.kind = {PieceKind::curve, PieceKind::arc};
  curve.side = {0, 0, 1};
  const RiseBarrier barrier(curve, 0.1);
  EXPECT_EQ(barrier.count(), 1);
  barrier.each_pull(1, [](double start, double end, const Pull&) {
    EXPECT_EQ(start, 1);
    EXPECT_EQ(end, 0);
  });
}

// Of a closed curve the last curvature is the first: one limit for both.
TEST(RiseBarrier, WhereAClosedCurveBeginsOneSideCounts) {
  DenseCurve curve = of({1, 2, 1}, {});
  curve.closed = true;
  curve.side = {1, 0, 1};
  EXPECT_EQ(RiseBarrier(curve, 0.1).count(), 1);
}

TEST(KeepRises, MovesCurvaturesToTheirSideInTheirOrder) {
  DenseCurve curve = of({10, 2, -1, -3, -2, 0, 5}, {});
  curve.side = {1, 1, 1, 1, 1, 1, 1};
  const DenseCurve before = curve;
  keep_rises(curve);
  for (std::size_t i = 0; i < curve.value.size(); ++i) {
    EXPECT_GT(curve.value[i], 0);
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_EQ(curve.value[i] < curve.value[j], before.value[i] < before.value[j]);
  }
  for (const std::size_t i : {0, 1, 6}) EXPECT_EQ(curve.value[i], before.value[i]);
  EXPECT_EQ(RiseBarrier(curve, 0.1).count(), 7);
  DenseCurve below = before;
  below.side = {-1, 0, 0, 0, 0, 0, 0};
  keep_rises(below);
  EXPECT_LT(below.value[0], 0);
  EXPECT_EQ(below.value[1], 2);
}

}  // namespace
}  // namespace keyline::fairing::detail
