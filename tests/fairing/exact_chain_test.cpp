#include "keyline/fairing/exact_chain.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "keyline/lac/chain/chain.h"

/// Chains that reproduce their points.
namespace keyline::fairing::detail {
namespace {

TEST(Exactness, IsTwoTenMillionthsOrSixTimesTheNoise) {
  EXPECT_EQ(exactness({.tolerance = 1, .noise = 0}), 2e-7);
  EXPECT_EQ(exactness({.tolerance = 1, .noise = 1e-8}), 2e-7);
  EXPECT_NEAR(exactness({.tolerance = 1, .noise = 1e-6}), 6e-6, 1e-20);
}

// Four hundred of many, evenly, with the ends and what must be passed.
TEST(TellingPoints, AreFewAndEven) {
  std::vector<FitPoint> points(399);
  EXPECT_EQ(telling_points(points).size(), 399U);
  points.resize(799);
  EXPECT_EQ(telling_points(points).size(), 799U);
  points.resize(1000);
  points[501].must_pass = true;
  const auto taken = telling_points(points);
  ASSERT_EQ(taken.size(), 500U + 2);  // every second, 501 and the last
  EXPECT_EQ(taken[0], 0U);
  EXPECT_EQ(taken[250], 500U);
  EXPECT_EQ(taken[251], 501U);
  EXPECT_EQ(taken.back(), 999U);
}

const lac::Chain kTruth{{{0, 0}, 0.1}, {{-0.7, 0.6, 0.5, 2}, {-1.8, 0.4, 2, 5}}, false};

std::vector<FitPoint> points_of(int n) {
  std::vector<FitPoint> points;
  for (const core::Point2 p : lac::sample(kTruth, n)) points.push_back({.position = p});
  return points;
}

ChainSearchOptions options() {
  ChainSearchOptions o;
  o.accept.tolerance = 1e-3;
  o.threads = 1;
  return o;
}

// A circle of length 1 from (r, 0) on, whose points begin elsewhere: every second one tells the
// chain, and the feet of the others, over the seam too, are where their angles say.
TEST(FollowsAll, ClosedChainsGoOverTheSeam) {
  constexpr double kTurn = 2 * std::numbers::pi, kRadius = 1 / kTurn;
  ChainSearchResult found;
  found.chain.joints = {{{kRadius, 0}, kTurn / 4, kTurn},
                        {{-kRadius, 0}, 3 * kTurn / 4, kTurn},
                        {{kRadius, 0}, 5 * kTurn / 4, kTurn}};
  found.chain.pieces.assign(2, {.length = 0.5, .alpha = -1, .kind = PieceKind::arc});
  found.chain.closed = true;
  found.chain.turning = kTurn;
  std::vector<FitPoint> points;
  std::vector<std::size_t> taken;
  const auto share = [](std::size_t j) { return std::fmod(0.3 + double(j) / 41, 1.0); };
  for (std::size_t j = 0; j < 41; ++j) {
    points.push_back({.position = core::Point2{} + kRadius * core::unit_vector(kTurn * share(j))});
    if (j % 2 == 1) continue;
    taken.push_back(j);
    const int piece = share(j) < 0.5 ? 0 : 1;
    found.chain.feet.push_back({piece, 2 * share(j) - piece});
  }
  ASSERT_TRUE(follows_all(found, taken, points, 1e-9));
  ASSERT_EQ(found.chain.feet.size(), 41U);
  for (std::size_t j = 0; j < 41; ++j) {
    const Foot& foot = found.chain.feet[j];
    EXPECT_NEAR(std::remainder(0.5 * (foot.piece + foot.fraction) - share(j), 1.0), 0, 1e-6) << j;
  }
}

TEST(FindExact, ComesBackToTheChainThePointsWereTakenFrom) {
  const auto points = points_of(90);
  ChainSearchResult best = search_chain(points, false, options());
  ASSERT_TRUE(best.within_tolerance);
  ASSERT_TRUE(find_exact(best, points, false, options()));
  EXPECT_LE(best.fit.max_offset, 2e-7);
  EXPECT_LE(best.chain.pieces.size(), 2U);
  EXPECT_EQ(best.weights, std::vector<double>(90, 1));
}

// Not asked for where a number of pieces is, where points are few, where the tolerance is nearly as
// fine, where the chain is long or does not keep the tolerance.
TEST(FindExact, IsNotAskedOfEveryChain) {
  const auto points = points_of(90);
  const ChainSearchResult given = search_chain(points, false, options());
  const auto found = [&](auto change) {
    ChainSearchResult best = given;
    ChainSearchOptions search = options();
    change(best, search);
    return find_exact(best, points, false, search);
  };
  EXPECT_TRUE(found([](auto&, auto&) {}));
  EXPECT_FALSE(found([](auto&, auto& s) { s.wanted_pieces = 1; }));
  EXPECT_FALSE(found([](auto&, auto& s) { s.accept.tolerance = 3.9e-6; }));
  EXPECT_FALSE(found([](auto& b, auto&) { b.within_tolerance = false; }));
  EXPECT_FALSE(found([](auto& b, auto&) {
    b.chain.pieces.resize(9);
    b.chain.joints.resize(10);
  }));
  const auto few = points_of(29);
  ChainSearchResult best = search_chain(few, false, options());
  EXPECT_FALSE(find_exact(best, few, false, options()));
  const auto enough = points_of(30);
  best = search_chain(enough, false, options());
  EXPECT_TRUE(find_exact(best, enough, false, options()));
}

// A chain found for every third point, whose feet the others get.
TEST(FollowsAll, TheChainOfSomePointsIsThatOfAll) {
  const auto points = points_of(91);
  std::vector<std::size_t> taken;
  std::vector<FitPoint> some;
  for (std::size_t i = 0; i < 91; i += 3) {
    taken.push_back(i);
    some.push_back(points[i]);
  }
  ChainSearchResult found = search_chain(some, false, options());
  ASSERT_TRUE(find_exact(found, some, false, options()));
  ASSERT_TRUE(follows_all(found, taken, points, 2e-7));
  EXPECT_EQ(found.chain.feet.size(), 91U);
  EXPECT_LE(found.fit.max_offset, 2e-7);
  auto moved = points;
  moved[40].position.y += 1e-4;
  EXPECT_FALSE(follows_all(found, taken, moved, 2e-7));
  std::vector<std::size_t> every(91);
  EXPECT_TRUE(follows_all(found, every, moved, 2e-7));  // nothing to follow: all were taken
}

}  // namespace
}  // namespace keyline::fairing::detail
