#include "keyline/numeric/genetic.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace keyline::numeric {
namespace {

/// 24 switches; the cost counts those that are off.
struct Switches {
  using Genome = std::array<bool, 24>;
  static Genome create(Random& random, std::size_t) {
    Genome g{};
    for (bool& on : g) on = random.chance(0.5);
    return g;
  }
  static void crossover(Genome& a, Genome& b, Random& random) {
    for (std::size_t i = random.index(a.size()); i < a.size(); ++i) std::swap(a[i], b[i]);
  }
  static void mutate(Genome& g, Random& random) {
    bool& on = g[random.index(g.size())];
    on = !on;
  }
  static double cost(const Genome& g, int) {
    double off = 0;
    for (const bool on : g) off += !on;
    return off;
  }
};

GeneticOptions small(int trials, int threads) {
  GeneticOptions options;
  options.population = 30;
  options.generations = 40;
  options.trials = trials;
  options.threads = threads;
  return options;
}

TEST(Genetic, FindsTheOptimum) {
  Switches problem;
  GeneticOptions options = small(8, 2);
  options.population = 60;
  options.generations = 200;
  double best = 24;
  for (const auto& trial : evolve_trials(problem, options)) {
    best = std::min(best, trial.best.cost);
  }
  EXPECT_EQ(best, 0);
}

TEST(Genetic, DoesNotDependOnThreads) {
  Switches problem;
  for (const int trials : {1, 3, 8}) {
    GeneticOptions options = small(trials, 1);
    options.generations = 5;
    const auto one = evolve_trials(problem, options);
    for (const int threads : {2, 4}) {
      options.threads = threads;
      const auto many = evolve_trials(problem, options);
      ASSERT_EQ(one.size(), many.size());
      for (std::size_t i = 0; i < one.size(); ++i) {
        EXPECT_EQ(one[i].best.genome, many[i].best.genome);
        EXPECT_EQ(one[i].evaluations, many[i].evaluations);
      }
    }
  }
}

// An odd population is made even; without generations each of it is made and looked at once.
TEST(Genetic, EveryMemberIsMadeAndLookedAt) {
  struct Counted : Switches {
    std::vector<std::size_t> made;
    Genome create(Random& random, std::size_t i) {
      made.push_back(i);
      return Switches::create(random, i);
    }
  } problem;
  GeneticOptions options = small(1, 1);
  options.population = 7;
  options.generations = 0;
  const auto result = evolve_trials(problem, options);
  EXPECT_EQ(problem.made, (std::vector<std::size_t>{0, 1, 2, 3, 4, 5, 6, 7}));
  EXPECT_EQ(result[0].evaluations, 8U);
  problem.made.clear();
  options.population = 1;
  EXPECT_EQ(evolve_trials(problem, options)[0].evaluations, 2U);
  EXPECT_EQ(problem.made, (std::vector<std::size_t>{0, 1}));
}

TEST(Genetic, BestNeverGetsWorseAndTheObserverStops) {
  Switches problem;
  double last = std::numeric_limits<double>::infinity();
  const auto result = evolve_trials(problem, small(1, 1), [&](int, int generation, double best) {
    EXPECT_LE(best, last);
    last = best;
    return generation < 7;
  });
  EXPECT_EQ(result[0].generations, 7);
  EXPECT_FALSE(result[0].complete);
  EXPECT_EQ(result[0].best.cost, last);
}

TEST(Genetic, RatesFollowSrinivasAndPatnaik) {
  const detail::PopulationCosts costs{10, 20};
  EXPECT_DOUBLE_EQ(detail::adaptive_rate(15, costs, 1, 1, 0.01), 0.5);
  EXPECT_DOUBLE_EQ(detail::adaptive_rate(15, costs, 0.5, 0.5, 0.01), 0.25);
  EXPECT_DOUBLE_EQ(detail::adaptive_rate(10, costs, 1, 1, 0.01), 0.01);  // the best is protected
  EXPECT_DOUBLE_EQ(detail::adaptive_rate(30, costs, 1, 1, 0.01), 1);
  EXPECT_DOUBLE_EQ(
      detail::adaptive_rate(std::numeric_limits<double>::infinity(), costs, 0.5, 0.5, 0.01), 0.5);
  EXPECT_DOUBLE_EQ(detail::adaptive_rate(10, {10, 10}, 1, 1, 0.01), 0.01);
}

}  // namespace
}  // namespace keyline::numeric
