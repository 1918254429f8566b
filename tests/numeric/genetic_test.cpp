#include "keyline/numeric/genetic.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <limits>
#include <thread>
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

/// Where no rate is above 0 nothing changes, and nothing is looked at again; where pairs always
/// cross and members always change, all of them are, twice a generation.
TEST(Genetic, OnlyWhatChangesIsLookedAtAgain) {
  struct Equal : Switches {
    static double cost(const Genome&, int) { return 3; }
  } problem;
  GeneticOptions options = small(1, 1);
  options.minimum_rate = 0;
  EXPECT_EQ(evolve_trials(problem, options)[0].evaluations, 30U);
  options.minimum_rate = 1;
  EXPECT_EQ(evolve_trials(problem, options)[0].evaluations, 30U + 2U * 30U * 40U);
}

/// Selection of twos draws the population's mean down even where nothing crosses or changes, and
/// the best stays in it.
TEST(Genetic, SelectionKeepsTheBest) {
  Switches problem;
  GeneticOptions options = small(4, 1);
  options.k1 = options.k2 = options.k3 = options.k4 = options.minimum_rate = 0;
  const auto first = [&](int generations) {
    options.generations = generations;
    return evolve_trials(problem, options);
  };
  const auto before = first(0);
  const auto after = first(30);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(before[i].best.cost, after[i].best.cost);
  EXPECT_NE(before[0].best.genome, before[1].best.genome);  // each trial draws from its own stream
}

/// Two members that always get worse: the best so far takes the place of the worse one.
TEST(Genetic, TheBestReplacesTheWorst) {
  struct Worsening {
    using Genome = int;
    std::vector<int> taken;
    std::vector<int> made;
    static Genome create(Random& random, std::size_t) { return int(random.index(1000)); }
    static void crossover(Genome&, Genome&, Random&) {}
    void mutate(Genome& g, Random& random) {
      taken.push_back(g);
      made.push_back(g += 1000 + int(random.index(500)));
    }
    static double cost(Genome g, int) { return g; }
  } problem;
  GeneticOptions options = small(200, 1);
  options.population = options.generations = 2;
  options.minimum_rate = 1;
  std::vector<int> there;
  evolve_trials(problem, options, [&](int, int generation, double best) {
    if (generation == 1) there = {int(best), std::ranges::min(problem.made)};
    for (const int g : problem.taken)
      EXPECT_TRUE(generation == 1 || g == there[0] || g == there[1]) << g;
    problem.made.clear();
    problem.taken.clear();
    return true;
  });
}

TEST(Genetic, StoppedAtTheLastGenerationIsComplete) {
  Switches problem;
  const auto all = [](int, int, double) { return false; };
  GeneticOptions options = small(1, 1);
  options.generations = 1;
  EXPECT_TRUE(evolve_trials(problem, options, all)[0].complete);
  options.generations = 2;
  EXPECT_FALSE(evolve_trials(problem, options, all)[0].complete);
}

/// A search of many trials is not to draw the first members of all of them once it is to stop.
TEST(Genetic, NoTrialBeginsAfterOneWasStopped) {
  Switches problem;
  GeneticOptions options = small(50, 1);
  const auto result = evolve_trials(problem, options, [](int, int, double) { return false; });
  EXPECT_GT(result[0].evaluations, 0U);
  for (std::size_t trial = 1; trial < result.size(); ++trial) {
    EXPECT_EQ(result[trial].evaluations, 0U);
    EXPECT_FALSE(result[trial].complete);
  }
}

/// Where no member can be, one of them comes back with its cost.
TEST(Genetic, ImpossibleMembersHaveNoCost) {
  struct Impossible : Switches {
    static double cost(const Genome&, int) { return std::numeric_limits<double>::infinity(); }
  } problem;
  const auto result = evolve_trials(problem, small(1, 1));
  EXPECT_EQ(result[0].best.cost, std::numeric_limits<double>::infinity());
  EXPECT_EQ(result[0].generations, 40);
}

/// Counts where two costs are asked for of one worker at once.
struct OneAtATime : Switches {
  std::array<std::atomic<int>, 4> busy{};
  std::atomic<int> clashes = 0, strangers = 0;
  double cost(const Genome& g, int worker) {
    if (worker < 0 || worker > 3) return ++strangers, 0;
    if (busy[static_cast<std::size_t>(worker)]++ > 0) ++clashes;
    std::this_thread::sleep_for(std::chrono::microseconds(20));
    --busy[static_cast<std::size_t>(worker)];
    return Switches::cost(g, worker);
  }
};

// A worker has scratch of its own, which two threads may not write to at once.
TEST(Genetic, AWorkerDoesOneThingAtATime) {
  for (const int trials : {1, 4}) {
    OneAtATime problem;
    GeneticOptions options = small(trials, 4);
    options.generations = 4;
    evolve_trials(problem, options);
    EXPECT_EQ(problem.clashes, 0) << trials;
    EXPECT_EQ(problem.strangers, 0) << trials;
  }
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
  const GeneticOptions theirs;
  EXPECT_EQ(theirs.k1, 1);
  EXPECT_EQ(theirs.k2, 0.5);
  EXPECT_EQ(theirs.k3, 1);
  EXPECT_EQ(theirs.k4, 0.5);
}

}  // namespace
}  // namespace keyline::numeric
