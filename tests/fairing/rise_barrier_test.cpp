#include "keyline/fairing/rise_barrier.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "rise_limits.h"

/// Limits on the rise of curvature.
namespace keyline::fairing::detail {
namespace {

// One limit a piece: its rise the way it is to run is above 0.
TEST(RiseBarrier, PullsAsItsMeritRises) {
  const DenseCurve curve = of({1, 2, 4, 3}, {1, 1, -1});
  const RiseBarrier barrier(curve, 0.2);
  EXPECT_EQ(barrier.count(), 3);
  const std::vector<double> room{1, 2, 1}, way{1, 1, -1};
  for (std::size_t p = 0; p < 3; ++p) {
    EXPECT_NEAR(rise_pull(barrier, p).slope, -way[p] * 0.2 / room[p], 1e-14);
    EXPECT_NEAR(rise_pull(barrier, p).weight, 0.2 / (room[p] * room[p]), 1e-14);
  }
  EXPECT_EQ(barrier.merit(curve), 0);
  EXPECT_NEAR(barrier.merit(of({1, 2.5, 4, 3}, {})), -0.2 * std::log(1.5 * 0.75), 1e-14);
}

// A piece that may run either way, and one that runs the wrong way, have no limit.
TEST(RiseBarrier, LimitsThatAreNotKeptAreLeftOut) {
  const RiseBarrier barrier(of({1, 2, 1, 3}, {0, 1, 1}), 0.1);
  EXPECT_EQ(barrier.count(), 1);
  EXPECT_EQ(rise_pull(barrier, 0).weight, 0);
  EXPECT_EQ(rise_pull(barrier, 1).weight, 0);
  EXPECT_GT(rise_pull(barrier, 2).weight, 0);
  EXPECT_EQ(RiseBarrier(of({1, 2}, {}), 0.1).count(), 0);
  EXPECT_EQ(rise_pull(RiseBarrier(of({1, 2}, {}), 0.1), 0).weight, 0);
}

// A limit of the rate is one of the rise either way: rate times width times length squared.
TEST(RiseBarrier, RatesLimitBothWays) {
  DenseCurve curve = of({1, 2, 1.5}, {});
  curve.length = 2;
  curve.most_rate = 1.5;  // most rise 1.5 * 4 / 2 = 3
  const RiseBarrier barrier(curve, 0.1);
  EXPECT_EQ(barrier.count(), 4);
  EXPECT_NEAR(rise_pull(barrier, 0).slope, -0.1 / (3 + 1) + 0.1 / (3 - 1), 1e-14);
  EXPECT_NEAR(rise_pull(barrier, 1).slope, -0.1 / (3 - 0.5) + 0.1 / (3 + 0.5), 1e-14);
}

TEST(RiseBarrier, StepsEndBeforeALimit) {
  const RiseBarrier barrier(of({1, 2, 4, 3}, {1, 1, -1}), 0.1);
  EXPECT_EQ(barrier.longest(rises({-0.5, -1, 0.5})), 1);
  EXPECT_NEAR(barrier.longest(rises({-2, 0, 0})), 0.995 / 2, 1e-14);
  EXPECT_NEAR(barrier.longest(rises({-2, -8, 0})), 0.995 * 2 / 8, 1e-14);
  EXPECT_NEAR(barrier.longest(rises({0, 0, 5})), 0.995 / 5, 1e-14);
  EXPECT_EQ(barrier.longest(rises({9, 9, -9})), 1);
}

// After a whole step multipliers are (barrier - multiplier * meant) / room, as far as all stay
// positive.
TEST(RiseBarrier, MultipliersMoveAsNewtonsMethodMeans) {
  RiseBarrier barrier(of({1, 2}, {1}), 0.1);
  barrier.move(of({1, 2.2}, {1}), rises({0.3}));
  EXPECT_NEAR(rise_pull(barrier, 0).weight, (0.1 - 0.1 * 0.3) / 1 / 1.2, 1e-14);
  EXPECT_NEAR(rise_pull(barrier, 0).slope, -0.1 / 1.2, 1e-14);
  barrier.rescale(3);
  EXPECT_NEAR(rise_pull(barrier, 0).weight, 3 * 0.07 / 1.2, 1e-14);
  barrier.set_barrier(0.5);
  EXPECT_NEAR(rise_pull(barrier, 0).slope, -0.5 / 1.2, 1e-14);
  RiseBarrier other(of({1, 2}, {1}), 0.1);
  other.move(of({1, 2}, {1}),
             rises({4}));  // would be -0.3: a loss of 0.4, of which 0.995 * 0.1 are taken
  EXPECT_NEAR(rise_pull(other, 0).weight, 0.1 - 0.995 * 0.1, 1e-14);
}

bool keeps_senses(const DenseCurve& curve) {
  for (std::size_t p = 0; p < curve.alpha.size(); ++p) {
    const double rise = curve.value[p + 1] - curve.value[p];
    if (curve.sense[p] * rise < 0 || (curve.sense[p] != 0 && rise == 0)) return false;
  }
  return true;
}

TEST(KeepRises, LeavesWhatRunsAsItShould) {
  DenseCurve curve = of({1, 2, 4, 3, 0}, {1, 1, -1, -1});
  keep_rises(curve);
  EXPECT_EQ(curve.value, (std::vector<double>{1, 2, 4, 3, 0}));
}

// Pooling adjacent violators: 1, 3, 2, 4 to rise are 1, 2.5, 2.5, 4, tilted so that they rise.
TEST(KeepRises, PoolsNeighboursThatRunTheOtherWay) {
  DenseCurve curve = of({1, 3, 2, 4}, {1, 1, 1});
  keep_rises(curve);
  EXPECT_TRUE(keeps_senses(curve));
  EXPECT_EQ(curve.value[0], 1);
  EXPECT_EQ(curve.value[3], 4);
  EXPECT_NEAR(0.5 * (curve.value[1] + curve.value[2]), 2.5, 1e-14);
  EXPECT_NEAR(curve.value[2] - curve.value[1], 2 * 1e-2 * 3, 1e-12);  // a hundredth of the range
  DenseCurve down = of({4, 2, 3, 1}, {-1, -1, -1});
  keep_rises(down);
  EXPECT_TRUE(keeps_senses(down));
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(down.value[i], curve.value[3 - i], 1e-14);
}

// More than two in one block: 3, 2, 1 between 0 and 9 all become 2 in the mean.
TEST(KeepRises, BlocksGrowWhileTheyMust) {
  DenseCurve curve = of({0, 3, 2, 1, 9}, {1, 1, 1, 1});
  keep_rises(curve);
  EXPECT_TRUE(keeps_senses(curve));
  EXPECT_NEAR(curve.value[2], 2, 1e-14);
  EXPECT_NEAR(curve.value[1] + curve.value[3], 4, 1e-14);
}

TEST(KeepRises, HeldEndsAndFlatPiecesStay) {
  DenseCurve curve = of({2, 1, 3, 4}, {1, 1, 1});
  curve.hold_start = Hold::curvature;
  keep_rises(curve);
  EXPECT_EQ(curve.value[0], 2);
  DenseCurve flat = of({2, 2, 1, 5}, {0, 1, 1});
  flat.kind = {PieceKind::arc, PieceKind::curve, PieceKind::curve};
  keep_rises(flat);
  EXPECT_EQ(flat.value[0], 2);
  EXPECT_EQ(flat.value[1], 2);
}

// Beside a line what would run the other way rises from none, or up to it: no limit is left out.
TEST(KeepRises, RunsOnFromLinesAndUpToThem) {
  const std::vector<double> bow{0, 0, -0.3, -0.1, 0.4, 1};
  DenseCurve on = of(bow, {0, 1, 1, 1, 1});
  on.kind.assign(5, PieceKind::curve);
  on.kind[0] = PieceKind::line;
  const DenseCurve given = on;
  keep_rises(on);
  EXPECT_TRUE(keeps_senses(on));
  EXPECT_EQ(RiseBarrier(given, 0.1).count(), 3);  // as it was, one rise is the wrong way
  EXPECT_EQ(RiseBarrier(on, 0.1).count(), 4);
  EXPECT_EQ(on.value[0], 0);
  EXPECT_EQ(on.value[1], 0);
  EXPECT_EQ(on.value[5], 1);
  std::vector<double> back(bow.rbegin(), bow.rend());
  DenseCurve down = of(back, {-1, -1, -1, -1, 0});
  down.kind.assign(5, PieceKind::curve);
  down.kind[4] = PieceKind::line;
  keep_rises(down);
  for (std::size_t i = 0; i < bow.size(); ++i)
    EXPECT_NEAR(down.value[i], on.value[5 - i], 1e-14) << i;
  for (double& v : back) v = -v;
  DenseCurve up = of(back, {1, 1, 1, 1, 0});
  up.kind = down.kind;
  keep_rises(up);
  for (std::size_t i = 0; i < bow.size(); ++i) EXPECT_EQ(up.value[i], -down.value[i]) << i;
}

// So it is from a held curvature, which the next would have drawn down with it.
TEST(KeepRises, RunsOnFromHeldCurvatures) {
  DenseCurve curve = of({2, 1, 1.5, 4}, {1, 1, 1});
  curve.hold_start = Hold::curvature;
  keep_rises(curve);
  EXPECT_TRUE(keeps_senses(curve));
  EXPECT_EQ(curve.value[0], 2);
  EXPECT_EQ(curve.value[3], 4);
  DenseCurve end = of({1, 5, 4.5, 4}, {1, 1, 1});
  end.hold_end = Hold::curvature;
  keep_rises(end);
  EXPECT_TRUE(keeps_senses(end));
  EXPECT_EQ(end.value[3], 4);
}

// Ends of different senses meet where the curve turns: the top stays above both sides.
TEST(KeepRises, TurnsStayTurns) {
  DenseCurve curve = of({1, 0.5, 2, 3, 2.5, 2.8, 1}, {1, 1, 1, -1, -1, -1});
  keep_rises(curve);
  EXPECT_TRUE(keeps_senses(curve));
  EXPECT_EQ(curve.value[3], 3);
}

TEST(KeepRises, OfClosedCurvesRunOnAcrossTheSeam) {
  DenseCurve curve = of({2, 3, 1, 0, 1, 2}, {1, -1, -1, 1, 1});
  curve.closed = true;
  keep_rises(curve);
  EXPECT_TRUE(keeps_senses(curve));
  EXPECT_EQ(curve.value.front(), curve.value.back());
  DenseCurve bad = of({2, 3, 1, 0, 2.5, 2}, {1, -1, -1, 1, 1});
  bad.closed = true;
  keep_rises(bad);
  EXPECT_TRUE(keeps_senses(bad));
  EXPECT_EQ(bad.value.front(), bad.value.back());
}

// Slowed down: no clothoid rises by more than nine tenths of what the rate allows.
TEST(KeepRises, RatesComeBelowTheirLimit) {
  DenseCurve curve = of({0, 0, 8, 0, 0}, {});
  curve.sense.clear();
  curve.most_rate = 8;  // a rise of 2 over a quarter
  keep_rises(curve);
  double most = 0;
  for (std::size_t p = 0; p < 4; ++p)
    most = std::max(most, std::abs(curve.value[p + 1] - curve.value[p]));
  EXPECT_NEAR(most, 0.9 * 2, 1e-12);
  EXPECT_NEAR(curve.value[2], 0.5 * (1.8 + 8), 1e-12);  // between 1.8 from below and 8 from above
  EXPECT_NEAR(too_fast(curve), 0.9, 1e-12);
}

TEST(Ease, MakesClothoidsOfWhatIsTooFast) {
  DenseCurve curve = of({1, 2, 8}, {});
  curve.alpha = {0.5, 0.5};
  curve.most_rate = 10;
  // Clothoids rise by 2 and 12 per length; of slope 0.5 the second is still faster.
  ease(curve);
  EXPECT_EQ(curve.alpha[0], 0.5);
  EXPECT_EQ(curve.alpha[1], -1);
}

// Of clothoids the rate is the rise over the width; none at all where it has no bound.
TEST(TooFast, OfClothoidsIsTheirRiseOverTheirWidth) {
  DenseCurve curve = of({1, 2, 8}, {});
  curve.most_rate = 3;
  EXPECT_NEAR(too_fast(curve), 6 / 0.5 / 3, 1e-14);
  curve.kind = {PieceKind::curve, PieceKind::arc};
  EXPECT_NEAR(too_fast(curve), 1 / 0.5 / 3, 1e-14);
  curve.kind.clear();
  curve.alpha = {0, -1};  // exponential: log(2) / 0.5 times its larger end
  curve.value = {1, 2, 2};
  EXPECT_NEAR(too_fast(curve), std::log(2) / 0.5 * 2 / 3, 1e-14);
  curve.value = {0, 2, 2};
  EXPECT_TRUE(std::isinf(too_fast(curve)));
  curve.most_rate = HUGE_VAL;
  EXPECT_EQ(too_fast(curve), 0);
}

// Moved across zero a piece gets a slope that passes an inflection; others keep theirs.
TEST(KeepRises, PiecesMovedAcrossZeroBecomeClothoids) {
  DenseCurve curve = of({4, 1, -3, 5}, {1, 1, 1});
  curve.alpha = {0.5, 0.7, -0.5};
  keep_rises(curve);
  EXPECT_TRUE(keeps_senses(curve));
  EXPECT_NEAR(curve.value[0] + curve.value[1] + curve.value[2], 2, 1e-13);
  for (std::size_t p = 0; p < 3; ++p)
    if (curve.value[p] * curve.value[p + 1] <= 0) {
      EXPECT_TRUE(curve.alpha[p] == -1 || curve.alpha[p] == -0.5) << p;
    }
  // As they are senses are kept: nothing moves, nothing is given another slope.
  DenseCurve still = of({-1, 2}, {1});
  still.alpha = {0.5};
  keep_rises(still);
  EXPECT_EQ(still.alpha[0], 0.5);
  DenseCurve crossing = of({2, -2.1, -2, 3}, {1, 1, 1});
  crossing.alpha = {0.5, 0.5, 0.5};
  keep_rises(crossing);
  // The mean is -0.7: all three lie within a hundredth of the range of it.
  EXPECT_EQ(crossing.alpha[0], 0.5);
  EXPECT_EQ(crossing.alpha[1], 0.5);
  EXPECT_EQ(crossing.alpha[2], -1);
}

// Tilted by a hundredth of the range either way, but no more than the values were apart, nor a
// quarter of the way to the next mean.
TEST(KeepRises, TiltsStayClear) {
  DenseCurve near = of({0, 5.01, 5.0, 10}, {1, 1, 1});
  keep_rises(near);
  EXPECT_NEAR(near.value[1], 5.005 - 0.01, 1e-13);
  EXPECT_NEAR(near.value[2], 5.005 + 0.01, 1e-13);
  DenseCurve equal = of({0, 5, 5, 10}, {1, 1, 1});
  keep_rises(equal);
  EXPECT_NEAR(equal.value[1], 4.9, 1e-13);
  EXPECT_NEAR(equal.value[2], 5.1, 1e-13);
  DenseCurve below = of({4.88, 5.5, 4.5, 10}, {1, 1, 1});
  keep_rises(below);
  const double tilt = std::min(1e-2 * 5.5, 0.25 * 0.12);
  EXPECT_NEAR(below.value[1], 5 - tilt, 1e-13);
  EXPECT_NEAR(below.value[2], 5 + tilt, 1e-13);
  DenseCurve above = of({0, 5.5, 4.5, 5.1}, {1, 1, 1});
  keep_rises(above);
  EXPECT_NEAR(above.value[1], 5 - 0.025, 1e-13);
  EXPECT_NEAR(above.value[2], 5 + 0.025, 1e-13);
}

// Uneven pieces are tilted as they stand along the curve.
TEST(KeepRises, TiltsAreEvenAlongTheCurve) {
  DenseCurve curve = of({0, 6, 5, 4, 9}, {1, 1, 1, 1});
  curve.at = {0, 0.3, 0.4, 0.7, 1};
  keep_rises(curve);
  const double tilt = 1e-2 * 9;
  EXPECT_NEAR(curve.value[1], 5 - tilt, 1e-13);
  EXPECT_NEAR(curve.value[2], 5 + tilt * (2 * 0.25 - 1), 1e-13);
  EXPECT_NEAR(curve.value[3], 5 + tilt, 1e-13);
}

// Across the seam of a closed curve what runs one way is pooled as anywhere: begun at another node
// the same values come out.
TEST(KeepRises, OfClosedCurvesTheBeginningDoesNotCount) {
  const std::vector<double> value{1, 4, 3, 6, 2, 0, 1.5};
  const std::vector<int> sense{1, 1, 1, -1, -1, 1, 1};  // of the pieces behind them
  const std::size_t n = value.size();
  const auto from = [&](std::size_t start) {
    std::vector<double> v;
    std::vector<int> s;
    for (std::size_t i = 0; i < n; ++i) {
      v.push_back(value[(start + i) % n]);
      s.push_back(sense[(start + i) % n]);
    }
    v.push_back(v.front());
    DenseCurve curve = of(v, s);
    curve.closed = true;
    keep_rises(curve);
    EXPECT_TRUE(keeps_senses(curve)) << start;
    std::vector<double> back;
    for (std::size_t i = 0; i < n; ++i) back.push_back(curve.value[(i + n - start) % n]);
    return back;
  };
  const std::vector<double> first = from(0);
  for (std::size_t start = 1; start < n; ++start) {
    const std::vector<double> again = from(start);
    for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(again[i], first[i], 1e-12) << start << ' ' << i;
  }
}

TEST(KeepRises, OfClosedCurvesRatesAreKeptAcrossTheSeam) {
  const std::vector<double> value{8, 0, 0, 0, 0, 0};
  for (std::size_t start = 0; start < 6; ++start) {
    std::vector<double> v;
    for (std::size_t i = 0; i <= 6; ++i) v.push_back(value[(start + i) % 6]);
    DenseCurve curve = of(v, {});
    curve.closed = true;
    curve.most_rate = 6;  // a rise of 1 over a sixth, of which 0.9 are taken
    keep_rises(curve);
    const auto at = [&](std::size_t i) { return curve.value[(i + 6 - start) % 6]; };
    EXPECT_NEAR(at(0), 0.5 * (0.9 + 8), 1e-12) << start;
    EXPECT_NEAR(at(1), 0.5 * (0 + 7.1), 1e-12) << start;
    EXPECT_NEAR(at(5), 0.5 * (0 + 7.1), 1e-12) << start;
    EXPECT_NEAR(at(3), 0.5 * (0 + 5.3), 1e-12) << start;
    EXPECT_EQ(curve.value.front(), curve.value.back());
    EXPECT_LE(too_fast(curve), 0.9 + 1e-12) << start;
  }
}

// A sense and a rate together are two limits: the rise above 0 and below the most.
TEST(RiseBarrier, SensesAndRatesLimitTogether) {
  DenseCurve curve = of({1, 2, 1.5}, {1, -1});
  curve.length = 2;
  curve.most_rate = 1.5;  // most rise 3
  const RiseBarrier barrier(curve, 0.1);
  EXPECT_EQ(barrier.count(), 4);
  EXPECT_NEAR(rise_pull(barrier, 0).slope, -0.1 / 1 + 0.1 / 2, 1e-14);
  EXPECT_NEAR(rise_pull(barrier, 1).slope, 0.1 / 0.5 - 0.1 / 2.5, 1e-14);
  EXPECT_NEAR(rise_pull(barrier, 1).weight, 0.1 / 0.25 + 0.1 / 6.25, 1e-14);
  // An arc has none.
  curve.kind = {PieceKind::arc, PieceKind::curve};
  EXPECT_EQ(RiseBarrier(curve, 0.1).count(), 2);
  EXPECT_EQ(rise_pull(RiseBarrier(curve, 0.1), 0).weight, 0);
}

// Of a slope that is no clothoid's the most rise is less: what its fastest rate is over its mean
// rate. Of slope 1 from 1 to 2 over a half the rate is 1 / (1 - t / 2)^2, 2 at its end and the rise
// 1: a fastest rate of 4 (over half of the length).
TEST(RiseBarrier, RatesAreThoseOfThePiecesFastestPlace) {
  DenseCurve curve = of({1, 2, 2}, {});
  curve.alpha = {1, -1};
  curve.most_rate = 10;
  const double most = 10 * 0.5 * 1 / (4 * 0.5);
  EXPECT_NEAR(rise_pull(RiseBarrier(curve, 0.1), 0).slope, -0.1 / (most + 1) + 0.1 / (most - 1),
              1e-13);
  EXPECT_NEAR(too_fast(curve), 4.0 / 10, 1e-14);
  std::swap(curve.value[0], curve.value[1]);  // falling: fastest at its start
  EXPECT_NEAR(too_fast(curve), 4.0 / 10, 1e-14);
}

// Products of room and multiplier stay within ten thousand times the barrier.
TEST(RiseBarrier, MultipliersStayNearTheirBarrier) {
  RiseBarrier barrier(of({1, 2}, {1}), 0.1);
  barrier.move(of({1, 1 + 1e-6}, {1}), rises({0}));
  EXPECT_NEAR(rise_pull(barrier, 0).weight, 10 / 1e-6, 1);
  barrier.set_barrier(1e-5);
  barrier.move(of({1, 2}, {1}), rises({0}));
  EXPECT_NEAR(rise_pull(barrier, 0).weight, 0.1, 1e-9);
}

}  // namespace
}  // namespace keyline::fairing::detail
