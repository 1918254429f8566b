#pragma once

#include <algorithm>
#include <atomic>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "keyline/numeric/parallel.h"
#include "keyline/numeric/random.h"

/// A seeded genetic algorithm for any genome, minimising a cost.
///
/// One generation: selection (tournaments of two), crossover of pairs, mutation of individuals,
/// the best so far kept and put back in place of the worst (steps 5 to 11 of the GA spline of
/// [Fairing] 3.2.2). Rates adapt after [Srinivas 1994]: with the
/// least cost e_min and the mean e_avg of the population, a pair whose better parent costs
/// e' <= e_avg crosses with probability k1 (e' - e_min) / (e_avg - e_min), any other with k3; an
/// individual mutates likewise with k2 and k4; no rate falls below minimum_rate.
namespace keyline::numeric {

/// What the engine needs from a problem. Costs may be infinite (no such individual) but not NaN.
/// create(random, i) makes the i-th individual of a trial's first generation; trials may run at
/// once. cost(genome, worker) is called in parallel, never twice at once with the same worker.
template <class P>
concept GeneticProblem =
    requires(P& problem, typename P::Genome& genome, Random& random, int worker) {
      { problem.create(random, std::size_t{}) } -> std::same_as<typename P::Genome>;
      problem.crossover(genome, genome, random);
      problem.mutate(genome, random);
      { problem.cost(genome, worker) } -> std::convertible_to<double>;
    };

struct GeneticOptions {
  int population = 100;   ///< even, >= 2
  int generations = 200;  ///< >= 0
  int trials = 30;        ///< independent runs, >= 1
  std::uint64_t seed = 1;
  int threads = 0;  ///< <= 0: all of the machine's; results do not depend on it
  double k1 = 1.0;
  double k2 = 0.5;
  double k3 = 1.0;
  double k4 = 0.5;
  double minimum_rate = 0.01;
};

template <class Genome>
struct Individual {
  Genome genome;
  double cost = std::numeric_limits<double>::infinity();
};

/// Best of one trial. `complete` is false where the observer stopped it before its last
/// generation; `best` is then the best so far, of infinite cost in a trial that did not begin.
template <class Genome>
struct GeneticResult {
  Individual<Genome> best;
  int generations = 0;
  std::uint64_t evaluations = 0;
  bool complete = true;
};

/// Told after every generation of a trial the least cost of that trial so far; false stops the
/// trial, and none begins after it. Called from several threads at once where trials run in
/// parallel.
using GeneticObserver = std::function<bool(int trial, int generation, double best_cost)>;

namespace detail {

struct PopulationCosts {
  double least = std::numeric_limits<double>::infinity();
  double mean = std::numeric_limits<double>::infinity();
};

/// Adaptive rate: `slope` below the mean cost, `flat` above it; floored.
inline double adaptive_rate(double cost, const PopulationCosts& costs, double slope, double flat,
                            double floor) {
  const double spread = costs.mean - costs.least;
  if (!(cost <= costs.mean)) return std::max(floor, flat);
  if (!(spread > 0)) return floor;
  return std::max(floor, slope * (cost - costs.least) / spread);
}

/// One trial: a population and the steps of a generation.
template <GeneticProblem P>
class Evolution {
 public:
  using Genome = typename P::Genome;

  Evolution(P& problem, const GeneticOptions& options, std::uint64_t stream, int threads,
            int worker)
      : problem_(problem),
        options_(options),
        random_(options.seed, stream),
        threads_(threads),
        worker_(worker) {
    const auto size =
        static_cast<std::size_t>(std::max(2, options.population + options.population % 2));
    for (std::size_t i = 0; i < size; ++i) population_.push_back({problem.create(random_, i)});
    changed_.assign(size, 1);
    evaluate();
  }

  void generation() {
    select();
    cross();
    evaluate();
    mutate();
    evaluate();
    keep_best();
    ++result_.generations;
  }

  GeneticResult<Genome>& result() { return result_; }

 private:
  void select() {
    std::vector<Individual<Genome>> next;
    next.reserve(population_.size());
    while (next.size() < population_.size()) {
      const auto& a = population_[random_.index(population_.size())];
      const auto& b = population_[random_.index(population_.size())];
      next.push_back(b.cost < a.cost ? b : a);
    }
    population_ = std::move(next);
  }

  void cross() {
    const PopulationCosts costs = statistics();
    for (std::size_t i = 0; i + 1 < population_.size(); i += 2) {
      const double better = std::min(population_[i].cost, population_[i + 1].cost);
      const double rate =
          adaptive_rate(better, costs, options_.k1, options_.k3, options_.minimum_rate);
      if (!random_.chance(rate)) continue;
      problem_.crossover(population_[i].genome, population_[i + 1].genome, random_);
      changed_[i] = changed_[i + 1] = 1;
    }
  }

  void mutate() {
    const PopulationCosts costs = statistics();
    for (std::size_t i = 0; i < population_.size(); ++i) {
      const double rate = adaptive_rate(population_[i].cost, costs, options_.k2, options_.k4,
                                        options_.minimum_rate);
      if (!random_.chance(rate)) continue;
      problem_.mutate(population_[i].genome, random_);
      changed_[i] = 1;
    }
  }

  /// Costs of changed individuals; the best so far is saved.
  void evaluate() {
    parallel_for(population_.size(), threads_, [&](std::size_t i, int worker) {
      if (!changed_[i]) return;
      population_[i].cost = problem_.cost(population_[i].genome, threads_ == 1 ? worker_ : worker);
    });
    for (std::size_t i = 0; i < population_.size(); ++i) {
      result_.evaluations += changed_[i];
      changed_[i] = 0;
      if (population_[i].cost < result_.best.cost) result_.best = population_[i];
    }
    if (result_.evaluations > 0 && !std::isfinite(result_.best.cost)) {
      result_.best = population_.front();
    }
  }

  void keep_best() {
    auto worst = population_.begin();
    for (auto it = population_.begin(); it != population_.end(); ++it) {
      if (it->cost == result_.best.cost) return;
      if (it->cost > worst->cost) worst = it;
    }
    *worst = result_.best;
  }

  PopulationCosts statistics() const {
    PopulationCosts costs;
    double sum = 0;
    std::size_t finite = 0;
    for (const auto& individual : population_) {
      if (!std::isfinite(individual.cost)) continue;
      costs.least = std::min(costs.least, individual.cost);
      sum += individual.cost;
      ++finite;
    }
    if (finite > 0) costs.mean = sum / static_cast<double>(finite);
    return costs;
  }

  P& problem_;
  const GeneticOptions& options_;
  Random random_;
  int threads_;
  int worker_;
  std::vector<Individual<Genome>> population_;
  std::vector<char> changed_;
  GeneticResult<Genome> result_;
};

}  // namespace detail

/// Runs the trials and returns the best of each, in order of trial. Trial i draws from stream i
/// of the seed. With at least two trials per thread the trials run in parallel, otherwise the
/// individuals of one trial are evaluated in parallel; the results are the same.
template <GeneticProblem P>
std::vector<GeneticResult<typename P::Genome>> evolve_trials(P& problem,
                                                             const GeneticOptions& options,
                                                             const GeneticObserver& observer = {}) {
  const int threads = thread_count(options.threads);
  const bool trials_in_parallel = options.trials >= 2 * threads;
  std::vector<GeneticResult<typename P::Genome>> results(
      static_cast<std::size_t>(std::max(1, options.trials)));
  std::atomic<bool> stopped = false;
  const auto run = [&](std::size_t trial, int worker) {
    if (stopped) {
      results[trial].complete = false;
      return;
    }
    detail::Evolution<P> evolution(problem, options, trial, trials_in_parallel ? 1 : threads,
                                   worker);
    auto& result = evolution.result();
    while (result.generations < options.generations) {
      evolution.generation();
      if (observer && !observer(static_cast<int>(trial), result.generations, result.best.cost)) {
        result.complete = result.generations == options.generations;
        stopped = true;
        break;
      }
    }
    results[trial] = std::move(result);
  };
  parallel_for(results.size(), trials_in_parallel ? threads : 1, run);
  return results;
}

}  // namespace keyline::numeric
