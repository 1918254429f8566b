#include "keyline/fit/knot_search.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <limits>
#include <mutex>
#include <optional>
#include <span>
#include <utility>

#include "keyline/fit/knot_polish.h"
#include "keyline/fit/knot_rates.h"
#include "keyline/numeric/genetic.h"

namespace keyline::fit {
namespace {

using numeric::Random;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The genetic problem: real-coded interior knots, of variable number, increasing.
class KnotProblem {
 public:
  using Genome = std::vector<double>;

  KnotProblem(const SplineSolver& solver, const BayesCriterion& criterion,
              const KnotSearchOptions& options, double insertion)
      : criterion_(criterion),
        domain_(solver.domain()),
        insertion_(insertion),
        solvers_(static_cast<std::size_t>(numeric::thread_count(options.threads)), solver) {
    const auto order = static_cast<std::size_t>(solver.order());
    most_knots_ = solver.data_count() > order ? (solver.data_count() - order) / 2 : 0;
    most_initial_ = std::clamp<std::size_t>(solver.data_count() / 4, 1, 100);
    if (options.smart_start) start_ = detail::refined_knots(solvers_[0], criterion, false).knots;
    smart_ = options.smart_start;
  }

  Genome create(Random& random, std::size_t individual) const {
    if (smart_) return individual == 0 ? start_ : varied_start(random);
    Genome knots(std::min(most_knots_, 1 + random.index(most_initial_)));
    for (double& t : knots) t = inner(random);
    std::sort(knots.begin(), knots.end());
    return knots;
  }

  /// Two cuts of the interval; the knots between them change places, so that counts may change.
  void crossover(Genome& a, Genome& b, Random& random) const {
    double low = inner(random);
    double high = inner(random);
    if (low > high) std::swap(low, high);
    const auto part = [&](Genome& g) {
      return std::pair(std::lower_bound(g.begin(), g.end(), low),
                       std::upper_bound(g.begin(), g.end(), high));
    };
    const auto [a0, a1] = part(a);
    const auto [b0, b1] = part(b);
    Genome new_a(a.begin(), a0);
    new_a.insert(new_a.end(), b0, b1);
    new_a.insert(new_a.end(), a1, a.end());
    Genome new_b(b.begin(), b0);
    new_b.insert(new_b.end(), a0, a1);
    new_b.insert(new_b.end(), b1, b.end());
    a = std::move(new_a);
    b = std::move(new_b);
  }

  /// Inserts or deletes a knot.
  void mutate(Genome& knots, Random& random) const {
    const bool insert = random.chance(insertion_);
    if (insert || knots.empty()) {
      const double t = inner(random);
      knots.insert(std::upper_bound(knots.begin(), knots.end(), t), t);
    } else {
      knots.erase(knots.begin() + static_cast<std::ptrdiff_t>(random.index(knots.size())));
    }
  }

  double cost(const Genome& knots, int worker) {
    return criterion_(solvers_[static_cast<std::size_t>(worker)].sum_near_data(knots),
                      knots.size());
  }

  std::span<SplineSolver> solvers() { return solvers_; }

 private:
  double inner(Random& random) const {
    for (;;) {
      const double t = random.uniform(domain_.low, domain_.high);
      if (t > domain_.low) return t;
    }
  }

  /// The refined knots, each moved within its neighbourhood, dropped or doubled now and then.
  Genome varied_start(Random& random) const {
    Genome knots;
    for (std::size_t i = 0; i < start_.size(); ++i) {
      const double before = i > 0 ? start_[i - 1] : domain_.low;
      const double after = i + 1 < start_.size() ? start_[i + 1] : domain_.high;
      const double u = random.uniform();
      if (u < 0.1) continue;
      knots.push_back(random.uniform((before + start_[i]) / 2, (after + start_[i]) / 2));
      if (u > 0.95) knots.push_back(random.uniform(before, after));
    }
    std::erase_if(knots, [&](double t) { return !(t > domain_.low && t < domain_.high); });
    std::sort(knots.begin(), knots.end());
    return knots;
  }

  BayesCriterion criterion_;
  core::Interval domain_;
  double insertion_;
  std::vector<SplineSolver> solvers_;
  std::size_t most_knots_ = 0;
  std::size_t most_initial_ = 1;
  std::vector<double> start_;
  bool smart_ = false;
};

/// Progress of all trials together: share done and the best criterion so far.
class SearchProgress {
 public:
  SearchProgress(const core::Progress& progress, double steps)
      : progress_(progress), steps_(steps) {}

  /// False: stop.
  bool step(double best) {
    if (progress_.sink) {
      const std::scoped_lock lock(mutex_);
      best_ = std::min(best_, best);
      done_ += 1;
      char text[48];
      std::snprintf(text, sizeof text, "knots: best BIC %.2f", best_);
      progress_.report(std::min(1.0, done_ / steps_), text);
    }
    return !progress_.stop_requested();
  }

 private:
  const core::Progress& progress_;
  double steps_;
  std::mutex mutex_;
  double done_ = 0;
  double best_ = kInfinity;
};

numeric::GeneticOptions genetic_options(const KnotSearchOptions& options,
                                        const GeneticRates& rates) {
  numeric::GeneticOptions genetic;
  genetic.population = options.population;
  genetic.generations = options.generations;
  genetic.trials = options.trials;
  genetic.seed = options.seed;
  genetic.threads = options.threads;
  genetic.k1 = genetic.k3 = rates.crossover;
  genetic.k2 = genetic.k4 = rates.mutation;
  genetic.minimum_rate = rates.minimum;
  return genetic;
}

/// Steps of progress a polish counts for: a quarter of a trial's generations.
int polish_steps(const KnotSearchOptions& options) { return 1 + options.generations / 4; }

int steps_of(const KnotSearchOptions& options) {
  const bool polished = options.placement == KnotPlacement::polished;
  return options.trials * (options.generations + (polished ? polish_steps(options) : 0));
}

/// Polishes every end of a trial: trials in parallel where there are enough of them, otherwise the
/// candidates of one.
void polish(std::vector<detail::ScoredKnots>& ends, std::span<SplineSolver> solvers,
            const BayesCriterion& criterion, const KnotSearchOptions& options,
            SearchProgress& progress, bool in_pairs) {
  const bool trials_in_parallel = ends.size() >= 2 * solvers.size();
  numeric::parallel_for(
      ends.size(), trials_in_parallel ? options.threads : 1, [&](std::size_t i, int worker) {
        const auto used =
            trials_in_parallel ? solvers.subspan(static_cast<std::size_t>(worker), 1) : solvers;
        ends[i] = detail::polish_knots(used, criterion, ends[i].knots, options.polish_rounds,
                                       options.progress, in_pairs);
        for (int k = 0; k < polish_steps(options); ++k) progress.step(ends[i].bic);
      });
}

/// Where one polynomial meets the data to their rounding: knots could only cost.
std::optional<KnotSearchResult> without_knots(SplineSolver solver,
                                              const BayesCriterion& criterion) {
  const double q = solver.sum_of_squares({});
  if (!(q + criterion.hidden <= criterion.floor)) return {};
  KnotSearchResult result;
  result.bic = criterion(q, 0);
  return result;
}

/// The first of the best, or none where all are infinitely bad.
detail::ScoredKnots best_of(const std::vector<detail::ScoredKnots>& ends,
                            const SplineSolver& solver, const BayesCriterion& criterion) {
  detail::ScoredKnots best{{}, kInfinity};
  for (const detail::ScoredKnots& end : ends)
    if (end.bic < best.bic) best = end;
  if (std::isfinite(best.bic)) return best;
  SplineSolver plain = solver;
  return {{}, criterion(plain.sum_of_squares({}), 0)};
}

}  // namespace

double BayesCriterion::operator()(double sum_of_squares, std::size_t interior_knots) const {
  if (!std::isfinite(sum_of_squares)) return kInfinity;
  const double parameters = 2 * static_cast<double>(interior_knots) + order;
  if (interior_knots > 0 && parameters > count) return kInfinity;
  return value(sum_of_squares, interior_knots);
}

double BayesCriterion::value(double sum_of_squares, std::size_t interior_knots) const {
  const double parameters = 2 * static_cast<double>(interior_knots) + order;
  return count * std::log(std::max(floor, sum_of_squares + hidden)) + std::log(count) * parameters;
}

KnotSearchResult search_knots(const SplineSolver& solver, const BayesCriterion& criterion,
                              const KnotSearchOptions& options) {
  return search_knots(solver, criterion, options, {});
}

KnotSearchResult search_knots(const SplineSolver& solver, const BayesCriterion& criterion,
                              const KnotSearchOptions& options, const GeneticRates& rates) {
  if (auto none = without_knots(solver, criterion)) return std::move(*none);
  KnotProblem problem(solver, criterion, options, rates.insertion);
  SearchProgress progress(options.progress, steps_of(options));
  const auto trials =
      numeric::evolve_trials(problem, genetic_options(options, rates),
                             [&](int, int, double best) { return progress.step(best); });
  KnotSearchResult result;
  std::vector<detail::ScoredKnots> ends(trials.size());
  for (std::size_t i = 0; i < trials.size(); ++i) {
    ends[i] = {trials[i].best.genome, trials[i].best.cost};
    result.generations += trials[i].generations;
    result.evaluations += trials[i].evaluations;
  }
  if (options.placement == KnotPlacement::polished && !options.progress.stop_requested()) {
    // Knots by refinement are one more start: sharp features that random knots seldom meet.
    if (!options.smart_start) {
      ends.push_back(detail::refined_knots(problem.solvers()[0], criterion, true));
    }
    const bool thorough = options.trials > 1 && detail::is_small(solver);
    polish(ends, problem.solvers(), criterion, options, progress, thorough);
  }
  detail::ScoredKnots best = best_of(ends, solver, criterion);
  if (options.unite > 0)
    best = detail::united_knots(problem.solvers()[0], criterion, best, options.unite);
  result.knots = std::move(best.knots);
  result.bic = best.bic;
  result.cancelled = options.progress.stop_requested();
  return result;
}

}  // namespace keyline::fit
