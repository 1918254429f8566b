#include "keyline/fit/drive_targets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <utility>

#include <gtest/gtest.h>

#include "keyline/curve/bezier.h"

namespace keyline::fit::detail {
namespace {

using curve::Bezier2;
using curve::PiecewiseBezier;

/// y = f(x) with these ordinates of f as a Bézier function over [from, to].
Bezier2 graph(double from, double to, const std::array<double, 6>& ordinates) {
  Bezier2 c;
  for (int k = 0; k < 6; ++k) c.control.push_back({from + (to - from) * k / 5, ordinates[k]});
  return c;
}

TEST(SplitPieces, CutsWhereCurvatureChangesItsSign) {
  // f'' is 20 times the cubic whose ordinates are the second differences, 1, -3, 3, -1.
  const PiecewiseBezier chain{
      {graph(0, 1, {0, 0, 1, -1, 0, 0}), graph(1, 2, {0, -0.5, 0, 2, 5, 9})}};
  const auto second = [](double t) {
    const double u = 1 - t;
    return u * u * u - 9 * u * u * t + 9 * u * t * t - t * t * t;
  };
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(0, 1);
  std::vector<LocalTarget> targets{{0, 0, 1}, {0, 1, 2}, {1, 0, 3}, {1, 1, 4}};
  for (int i = 0; i < 40; ++i) targets.push_back({i % 2 == 0 ? 0u : 1u, any(random), 0.1 * i});
  const std::vector<LocalTarget> before = targets;
  int splits = 5;
  const PiecewiseBezier cut = split_pieces(chain, targets, splits);
  ASSERT_EQ(splits, 8);  // three more
  ASSERT_EQ(cut.pieces.size(), 5u);
  for (std::size_t k = 0; k < 3; ++k) {
    const double root = cut.pieces[k].control.back().x;  // x = t
    EXPECT_NEAR(second(root), 0, 1e-12);
    EXPECT_GT(root, k == 0 ? 0 : cut.pieces[k - 1].control.back().x);
  }
  EXPECT_EQ(cut.pieces[4], chain.pieces[1]);
  // Every target is where it was, with its value.
  ASSERT_EQ(targets.size(), before.size());
  for (const LocalTarget& was : before) {
    const core::Point2 place = evaluate(chain.pieces[was.piece], was.u);
    const auto same = [&](const LocalTarget& t) {
      return t.curvature == was.curvature &&
             distance(evaluate(cut.pieces[t.piece], t.u), place) < 1e-12;
    };
    EXPECT_EQ(std::count_if(targets.begin(), targets.end(), same), 1) << was.curvature;
  }
  for (const LocalTarget& t : targets) EXPECT_TRUE(t.u >= 0 && t.u <= 1);
}

TEST(SplitPieces, LeavesInflectionsInTheEnds) {
  // f'' starts and ends at 0 and has one sign between.
  const PiecewiseBezier chain{{graph(0, 1, {0, 0, 0, 1, 2, 3})}};
  std::vector<LocalTarget> targets;
  int splits = 0;
  EXPECT_EQ(split_pieces(chain, targets, splits).pieces, chain.pieces);
  EXPECT_EQ(splits, 0);
}

// f'' = t - at: an inflection a ten millionth from an end is one of the end.
TEST(SplitPieces, LeavesWhatNobodyCouldSeeOf) {
  for (const double at : {1e-7, 0.5, 1 - 1e-7}) {
    std::array<double, 6> y{};
    for (int k = 0; k < 4; ++k) y[k + 2] = 2 * y[k + 1] - y[k] + (k / 3.0 - at);
    const PiecewiseBezier chain{{graph(0, 1, y)}};
    std::vector<LocalTarget> targets;
    int splits = 0;
    const PiecewiseBezier cut = split_pieces(chain, targets, splits);
    EXPECT_EQ(splits, at == 0.5 ? 1 : 0) << at;
    EXPECT_EQ(cut.pieces.size(), at == 0.5 ? 2u : 1u);
  }
}

// Of a part of a hundred thousandth rounding of its points would say what curvature it has.
TEST(SplitPieces, LeavesNoPartWithoutACurvature) {
  const auto pieces = [](const std::array<double, 4>& second) {  // f'' / 20, as a Bézier function
    std::array<double, 6> y{1, 1};
    for (int k = 0; k < 4; ++k) y[k + 2] = 2 * y[k + 1] - y[k] + second[k];
    const PiecewiseBezier chain{{graph(0, 1, y)}};
    std::vector<LocalTarget> targets{{0, 0.25, 1}, {0, 0.75, 2}};
    int splits = 0;
    const std::size_t count = split_pieces(chain, targets, splits).pieces.size();
    EXPECT_EQ(count, static_cast<std::size_t>(splits) + 1);
    return count;
  };
  for (const auto& [at, parts] : {std::pair{2e-6, 1u}, {1e-2, 2u}}) {  // t - at
    EXPECT_EQ(pieces({-at, 1 / 3.0 - at, 2 / 3.0 - at, 1 - at}), parts) << at;
    EXPECT_EQ(pieces({1 - at, 2 / 3.0 - at, 1 / 3.0 - at, -at}), parts) << at;
  }
  for (const auto& [half, parts] : {std::pair{1e-5, 1u}, {0.1, 3u}}) {  // (t - 0.5)^2 - half^2
    const double less = half * half;
    EXPECT_EQ(pieces({0.25 - less, -1 / 12.0 - less, -1 / 12.0 - less, 0.25 - less}), parts);
  }
}

TEST(LocalTargets, ComeBackOverAll) {
  std::vector<CurvatureTarget> targets;
  for (int i = 0; i <= 40; ++i) targets.push_back({i / 40.0, std::sin(i)});
  const auto local = local_targets(targets, 4);  // ten a piece: nothing is added
  ASSERT_TRUE(local);
  ASSERT_EQ(local->size(), targets.size());
  for (const LocalTarget& t : *local) {
    EXPECT_LT(t.piece, 4u);
    EXPECT_TRUE(t.u >= 0 && t.u <= 1);
  }
  const auto again = over_all(*local, 4);
  for (std::size_t i = 0; i < targets.size(); ++i) {
    EXPECT_NEAR(again[i].t, targets[i].t, 1e-15);
    EXPECT_EQ(again[i].curvature, targets[i].curvature);
  }
}

TEST(LocalTargets, PiecesWithFewGetMore) {
  std::vector<CurvatureTarget> targets{{0.1, 1.2}, {0.9, 2.8}};  // 1 + 2 t
  for (int i = 0; i < 8; ++i)
    targets.push_back({(1 + (i + 0.5) / 8) / 3, 1 + 2 * (1 + (i + 0.5) / 8) / 3});
  std::reverse(targets.begin(), targets.end());  // any order
  const auto local = local_targets(targets, 3);
  ASSERT_TRUE(local);
  std::array<int, 3> count{};
  for (const LocalTarget& t : *local) {
    ++count[t.piece];
    const double whole = (static_cast<double>(t.piece) + t.u) / 3;
    EXPECT_NEAR(t.curvature, 1 + 2 * whole, 1e-12);  // straight data have a straight interpolant
    EXPECT_TRUE(whole > 0.1 - 1e-15 && whole < 0.9 + 1e-15);
  }
  // Of the sixteen places (i + 1/2) / 48 those within [0.1, 0.9]: from i = 5 on, up to i = 42.
  EXPECT_EQ(count[0], 1 + 11);
  EXPECT_EQ(count[1], 8);
  EXPECT_EQ(count[2], 1 + 11);
}

TEST(LocalTargets, RefuseWhatIsNone) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(local_targets({{0, 1}, {1, 2}}, 1));
  for (const CurvatureTarget& bad :
       {CurvatureTarget{-1e-9, 1}, {1 + 1e-9, 1}, {nan, 1}, {0.5, nan}, {0.5, HUGE_VAL}}) {
    const auto none = local_targets({{0, 1}, bad, {1, 2}}, 1);
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().message, "a target lies outside the curve");
    EXPECT_EQ(none.error().path, "target");
  }
  EXPECT_EQ(local_targets({{0.5, 1}, {0.2, 1}, {0.5, 2}}, 1).error().message,
            "two targets lie in one place");
  EXPECT_EQ(local_targets({{0, 1}, {1, -1e300}}, 1).error().message,
            "a curvature is larger than 1e100");  // its square would be no number
  EXPECT_EQ(local_targets({{0.5, 1}}, 1).error().message, "there are fewer than two targets");
}

}  // namespace
}  // namespace keyline::fit::detail
