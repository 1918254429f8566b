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

TEST(BracketedRoot, UndefinedInsideIsNoRoot) {
  const auto hole = [](double x) { return x > 0.2 && x < 0.8 ? std::nan("") : x - 0.5; };
  EXPECT_FALSE(bracketed_root(hole, 0, 1, 1e-14));
}

}  // namespace
}  // namespace keyline::numeric
