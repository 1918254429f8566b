#include "keyline/numeric/roots.h"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace keyline::numeric {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Curvature beside a cusp: infinite at an end or on a whole stretch.
TEST(BracketedRoot, InfiniteValuesCountAsLarge) {
  std::vector<double> asked;
  const auto cliff = [&](double x) {
    asked.push_back(x);
    return x < 0.1 ? -kInfinity : x - 0.7;
  };
  const auto root = bracketed_root(cliff, 0, 1, 1e-14);
  ASSERT_TRUE(root);
  EXPECT_NEAR(*root, 0.7, 1e-13);
  const auto pole = bracketed_root([](double x) { return std::log(x) + 1; }, 0, 2, 1e-14);
  ASSERT_TRUE(pole);
  EXPECT_NEAR(*pole, std::exp(-1.0), 1e-13);
  for (const double x : asked) EXPECT_TRUE(x >= 0 && x <= 1) << x;
}

TEST(BracketedRoot, SignsAreTheirOwnHoweverSmallOrLarge) {
  for (const double size : {1e-250, 1e-12, 0.4, 1.0, 1e12, 1e99})
    for (const double sign : {-1.0, 1.0}) {
      const auto root =
          bracketed_root([&](double x) { return sign * size * (x - 0.3); }, 0, 1, 1e-15);
      ASSERT_TRUE(root) << sign * size;
      EXPECT_NEAR(*root, 0.3, 2e-15);
      EXPECT_FALSE(bracketed_root([&](double x) { return sign * size * (x + 0.3); }, 0, 1, 1e-15));
    }
  EXPECT_FALSE(bracketed_root([](double x) { return x; }, 1, -1, 1e-15));
}

TEST(BracketedRoot, ZerosAtTheEndsAreFoundAtOnce) {
  int asked = 0;
  const auto line = [&](double x) { return ++asked, x - 1; };
  EXPECT_EQ(bracketed_root(line, 1, 3, 1e-12), 1);
  EXPECT_EQ(bracketed_root(line, -3, 1, 1e-12), 1);
  EXPECT_EQ(asked, 4);
  EXPECT_FALSE(bracketed_root([](double x) { return std::sqrt(x); }, -1, 1, 1e-12));
}

/// As near as is asked for, and no nearer: a bracket of twice the tolerance is enough.
TEST(BracketedRoot, ToleranceSparesWork) {
  int asked = 0;
  const auto f = [&](double x) { return ++asked, std::atan(50 * (x - 0.3)); };
  const auto rough = bracketed_root(f, 0, 1, 1e-2);
  const int few = asked;
  ASSERT_TRUE(rough);
  EXPECT_NEAR(*rough, 0.3, 2e-2);
  asked = 0;
  ASSERT_TRUE(bracketed_root(f, 0, 1, 1e-15));
  EXPECT_LT(few, asked);
}

TEST(BracketedRoot, UndefinedInsideIsNoRoot) {
  const auto hole = [](double x) { return x > 0.2 && x < 0.8 ? std::nan("") : x - 0.5; };
  EXPECT_FALSE(bracketed_root(hole, 0, 1, 1e-14));
}

}  // namespace
}  // namespace keyline::numeric
