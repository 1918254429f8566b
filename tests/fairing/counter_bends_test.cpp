#include "keyline/fairing/counter_bends.h"

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "evenly_bent.h"

/// Where a curve bends to the other side.
namespace keyline::fairing::detail {
namespace {

constexpr double kPi = std::numbers::pi;

/// See evenly_bent(); free.
DenseCurve of(const std::vector<double>& curvatures, bool closed = false) {
  DenseCurve curve = evenly_bent(curvatures, closed);
  set_free(curve);
  return curve;
}

/// Open, and its ends are held: they lie between nothing.
DenseCurve held(const std::vector<double>& curvatures) {
  DenseCurve curve = of(curvatures);
  curve.hold_start = curve.hold_end = Hold::position;
  return curve;
}

DenseCurve graph(const std::function<double(double)>& k, int cells, bool closed = false) {
  std::vector<double> curvatures;
  for (int i = 0; i <= cells; ++i) curvatures.push_back(k(double(i) / cells));
  return of(curvatures, closed);
}

using Sides = std::vector<signed char>;

TEST(CounterBends, HaveBendsToTheOtherSideOnEither) {
  EXPECT_TRUE(counter_bends(held({1, 2, 3, 1})).empty());
  EXPECT_TRUE(counter_bends(held({1, 2, -3, -1})).empty());
  const auto bends = counter_bends(held({1, 3, 2, -0.5, -1, 1, 4, 2}));
  ASSERT_EQ(bends.size(), 1U);
  EXPECT_EQ(bends[0].first, 1);
  EXPECT_EQ(bends[0].last, 6);
  EXPECT_EQ(bends[0].side, 1);
}

// An end that nothing holds may lie straight: what bends there against all else may go as well.
TEST(CounterBends, AtFreeEndsHaveOneSide) {
  DenseCurve curve = of({-1, -2, -1, 1, 6, 5, 9, -1});
  auto bends = counter_bends(curve);
  ASSERT_EQ(bends.size(), 3U);  // the large one in the middle among them
  EXPECT_EQ(bends[0].first, 6);
  EXPECT_EQ(bends[0].last, 7);
  EXPECT_EQ(bends[1].first, 0);
  EXPECT_EQ(bends[1].last, 6);
  EXPECT_EQ(bends[1].side, 1);
  curve.hold_start = Hold::position;
  ASSERT_EQ(counter_bends(curve).size(), 2U);
  EXPECT_EQ(counter_bends(curve)[0].first, 6);
  curve.hold_end = Hold::curvature;
  EXPECT_EQ(counter_bends(curve).size(), 1U);
}

// What has no curvature belongs to what is before it, or where the curve begins to what follows.
TEST(CounterBends, AreNotPartedByNodesWithoutCurvature) {
  EXPECT_TRUE(counter_bends(held({0, 2, 0, 3, 0})).empty());
  const auto bends = counter_bends(held({0, -2, 0, 3, 0, 2, 0, -4, 0}));
  ASSERT_EQ(bends.size(), 1U);
  EXPECT_EQ(bends[0].first, 1);
  EXPECT_EQ(bends[0].last, 7);
  EXPECT_EQ(bends[0].side, -1);
}

// Also where a closed curve begins at one: in truth two bends, wherever it does.
TEST(CounterBends, OfClosedCurvesAreNotPartedByThemEither) {
  const std::vector<double> k{2, 0, 1, -3, -1, 3};
  for (std::size_t begin = 0; begin < 6; ++begin) {
    std::vector<double> turned;
    for (std::size_t i = 0; i <= 6; ++i) turned.push_back(k[(begin + i) % 6]);
    const auto bends = counter_bends(of(turned, true));
    ASSERT_EQ(bends.size(), 2U) << begin;
    EXPECT_EQ(bends[0].side * bends[1].side, -1) << begin;
  }
}

// A sine of curvature A over a length l departs by A (l / pi)^2 on one side: half of it either way.
TEST(CounterBends, DepartByHalfTheirHeight) {
  DenseCurve curve = graph([](double t) { return -6 * std::sin(5 * kPi * t); }, 5000);
  curve.length = 3;
  curve.hold_start = curve.hold_end = Hold::position;
  const auto bends = counter_bends(curve);
  ASSERT_EQ(bends.size(), 3U);
  for (const CounterBend& bend : bends)
    EXPECT_NEAR(bend.sideways, 3 * 6 / (5 * kPi) / (5 * kPi) / 2, 3e-3 * bend.sideways);
}

TEST(CounterBends, ComeLeastFirst) {
  const auto bends = counter_bends(held({1, -3, 1, -1, 1, -2, 1}));
  ASSERT_EQ(bends.size(), 5U);
  for (std::size_t i = 1; i < bends.size(); ++i)
    EXPECT_LE(bends[i - 1].sideways, bends[i].sideways);
}

// Wherever a closed curve begins: three lobes to either side, one of them low.
TEST(CounterBends, OfAClosedCurveAreFoundWhereverItBegins) {
  const std::vector<double> k{3, 1, -1, -2, -1, 1, 4, 1, -1, -0.5, 1, 2};
  const int n = static_cast<int>(k.size());
  for (int begin = 0; begin < n; ++begin) {
    std::vector<double> turned;
    for (int i = 0; i <= n; ++i) turned.push_back(k[(begin + i) % n]);
    const auto bends = counter_bends(of(turned, true));
    ASSERT_EQ(bends.size(), 4U) << begin;
    for (const CounterBend& bend : bends) {
      EXPECT_GE(bend.first, 0);
      EXPECT_GT(bend.last, bend.first);
      EXPECT_EQ(turned[bend.first % n] * bend.side > 0, true);
      EXPECT_EQ(turned[bend.last % n] * bend.side > 0, true);
    }
    const CounterBend& low = bends[0];
    EXPECT_EQ(low.side, 1) << begin;
    EXPECT_EQ((low.first + begin) % n, 6) << begin;
    EXPECT_EQ((low.last + begin) % n, 0) << begin;
    DenseCurve curve = of(turned, true);
    set_side(curve, low);
    for (int i = 0; i < n; ++i) {
      const int node = (begin + i) % n;
      EXPECT_EQ(curve.side[i], node >= 6 || node == 0 ? 1 : 0) << begin << ", " << node;
    }
    EXPECT_EQ(curve.side.back(), curve.side.front()) << begin;
  }
}

// A single bend inwards has the rest of the closed curve on either side of it.
TEST(CounterBends, OfOneHollowAreTwoRoundACurve) {
  const int n = 12;
  for (int begin = 0; begin < n; ++begin) {
    std::vector<double> turned;
    for (int i = 0; i <= n; ++i) {
      const int node = (begin + i) % n;
      turned.push_back(node == 4 || node == 5 ? -0.5 : node == 10 ? 3 : 1);
    }
    const auto bends = counter_bends(of(turned, true));
    ASSERT_EQ(bends.size(), 2U) << begin;
    EXPECT_EQ(bends[0].side, 1);
    DenseCurve curve = of(turned, true);
    set_side(curve, bends[0]);
    EXPECT_EQ(curve.side, Sides(n + 1, 1)) << begin;
  }
}

// Where a curve ends on its line of symmetry it runs on as its mirror image: a bend there is twice
// as long, four times as high.
TEST(CounterBends, OnALineOfSymmetryAreHalves) {
  const auto k = [](double t) { return t < 0.4 ? -6.0 : t < 0.6 ? 8.0 : -2.0; };
  DenseCurve curve = graph(k, 1000);
  curve.hold_start = Hold::direction;
  curve.hold_end = Hold::position;
  EXPECT_EQ(counter_bends(curve).size(), 1U);
  curve.slides_start = true;
  auto bends = counter_bends(curve);
  ASSERT_EQ(bends.size(), 2U);  // 8 over 0.2 is lower than 6 over 0.8
  EXPECT_NEAR(bends[1].sideways, 6 * 0.8 * 0.8 / 8 / 2, 5e-3);
  EXPECT_EQ(bends[1].side, 1);
  EXPECT_EQ(bends[1].first, 0);
  EXPECT_EQ(bends[1].last, 400);
  curve.slides_end = true;
  EXPECT_EQ(counter_bends(curve).size(), 2U);  // a corner on the line is no bend
  curve.hold_end = Hold::direction;
  bends = counter_bends(curve);
  ASSERT_EQ(bends.size(), 3U);
  EXPECT_NEAR(bends[1].sideways, 2 * 0.8 * 0.8 / 8 / 2, 5e-3);
  EXPECT_EQ(bends[1].first, 400);
  EXPECT_EQ(bends[1].last, 1000);
}

TEST(LooseSide, IsTheEndsUpToTheNext) {
  const Sides given{1, 1, 0, -1, -1, -1};
  DenseCurve curve = of({1, 1, 1, -1, -1, -1});
  curve.side = given;
  loosen_side(curve, true);
  EXPECT_EQ(curve.side, (Sides{0, 0, 0, -1, -1, -1}));
  curve.side = given;
  loosen_side(curve, false);
  EXPECT_EQ(curve.side, (Sides{1, 1, 0, 0, 0, 0}));
  curve = of({1, 2, 5, 0.1, 4, 3});
  curve.side.assign(6, 1);
  loosen_side(curve, true);  // up to its peak
  EXPECT_EQ(curve.side, (Sides{0, 0, 0, 1, 1, 1}));
  loosen_side(curve, false);
  EXPECT_EQ(curve.side, (Sides{0, 0, 0, 1, 0, 0}));
  curve.side.clear();
  loosen_side(curve, true);
  EXPECT_TRUE(curve.side.empty());
}

// Neighbours ask for other sides of the nodes between their peaks; the next but one does not.
TEST(Apart, NeighboursGoOneAfterTheOther) {
  const DenseCurve curve = held({2, -1, 3, -2, 1, -1, 2});
  const auto bends = counter_bends(curve);
  ASSERT_EQ(bends.size(), 5U);
  const auto some = apart(curve, {bends[0], bends[1], bends[2], bends[3], bends[4]});
  EXPECT_EQ(some[0].first, bends[0].first);
  for (const CounterBend& bend : some) EXPECT_EQ(bend.side, some[0].side);
  EXPECT_GT(some.size(), 1U);
  EXPECT_LT(some.size(), 5U);
}

TEST(SetSide, LeavesWhatIsKeptElsewhere) {
  DenseCurve curve = of({1, 3, -1, 2, 1, -1, -2, 1, 4});
  set_side(curve, {.first = 1, .last = 3, .side = 1});
  set_side(curve, {.first = 5, .last = 6, .side = -1});
  EXPECT_EQ(curve.side, (Sides{0, 1, 1, 1, 0, -1, -1, 0, 0}));
}

}  // namespace
}  // namespace keyline::fairing::detail
