#include "keyline/sketch/branch.h"

#include <cmath>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/numeric/random.h"

namespace keyline::sketch {
namespace {

using Costs = std::vector<std::vector<double>>;

double cost_of(const std::vector<int>& mates, const Costs& costs, double alone) {
  double sum = 0;
  for (std::size_t i = 0; i < mates.size(); ++i) {
    if (mates[i] < 0) sum += alone;
    if (mates[i] > static_cast<int>(i)) sum += costs[i][static_cast<std::size_t>(mates[i])];
  }
  return sum;
}

/// The least cost there is, by trying everything.
double least_of(const Costs& costs, double alone) {
  std::function<double(std::vector<bool>)> rest = [&](std::vector<bool> settled) {
    std::size_t first = 0;
    while (first < settled.size() && settled[first]) ++first;
    if (first == settled.size()) return 0.0;
    settled[first] = true;
    double least = alone + rest(settled);
    for (std::size_t k = first + 1; k < settled.size(); ++k) {
      if (settled[k] || !std::isfinite(costs[first][k])) continue;
      settled[k] = true;
      least = std::min(least, costs[first][k] + rest(settled));
      settled[k] = false;
    }
    return least;
  };
  return rest(std::vector<bool>(costs.size(), false));
}

TEST(Branch, PairingsAreTheCheapestThereAre) {
  numeric::Random random(5, 8);
  for (std::size_t n = 1; n <= 8; ++n)
    for (int round = 0; round < 20; ++round) {
      Costs costs(n, std::vector<double>(n, HUGE_VAL));
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t k = 0; k < i; ++k)
          if (random.chance(0.8)) costs[i][k] = costs[k][i] = random.uniform(0, 1);
      const std::vector<int> mates = pair_up(costs, 0.3);
      for (std::size_t i = 0; i < n; ++i)
        if (mates[i] >= 0) {
          EXPECT_EQ(mates[static_cast<std::size_t>(mates[i])], static_cast<int>(i));
        }
      EXPECT_NEAR(cost_of(mates, costs, 0.3), least_of(costs, 0.3), 1e-12);
    }
}

TEST(Branch, SixteenBranchesArePairedAndMoreThanAreAskedForStayAlone) {
  const auto wheel = [](std::size_t n) {  // each costs 0 with the one opposite
    Costs costs(n, std::vector<double>(n, 1));
    for (std::size_t i = 0; i < n / 2; ++i) costs[i][i + n / 2] = costs[i + n / 2][i] = 0;
    return costs;
  };
  const std::vector<int> mates = pair_up(wheel(16), 10);
  for (std::size_t i = 0; i < 16; ++i) EXPECT_EQ(mates[i], static_cast<int>((i + 8) % 16));
  const std::vector<int> many = pair_up(wheel(2 * kMostBranches), 10);
  ASSERT_EQ(many.size(), 2 * kMostBranches);
  EXPECT_EQ(many.back(), -1);
}

}  // namespace
}  // namespace keyline::sketch
