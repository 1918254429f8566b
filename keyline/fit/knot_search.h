#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "keyline/core/describe.h"
#include "keyline/core/progress.h"
#include "keyline/fit/least_squares_spline.h"

/// Where to put the knots of a least-squares spline: the genetic search of the GA spline
/// ([Fairing] 3.2.2, after [Yoshimoto 2003]) and a local polish.
/// docs/design/ga-knots.md tells why it is made this way and what it reaches.
namespace keyline::fit {

/// Bayes' information criterion of [Fairing] Eq. 5: N ln Q + ln N (2n + m), less is better.
struct BayesCriterion {
  double count = 0;   ///< N, data points
  int order = 4;      ///< m
  double floor = 0;   ///< least Q that counts: what the rounding of the data leaves
  double hidden = 0;  ///< part of Q no knots can remove: the scatter inside condensed bins
  /// Infinite where sum_of_squares is, and where there are more parameters than data, 2n + m > N:
  /// the criterion is meaningless near interpolation, where Q vanishes.
  double operator()(double sum_of_squares, std::size_t interior_knots) const;
  /// The criterion's number whatever there are of parameters: of knots that were not searched for.
  double value(double sum_of_squares, std::size_t interior_knots) const;
};

enum class KnotPlacement {
  ga,       ///< the best individual of the genetic search
  polished  ///< each trial's best improved by local search, then the best of them
};
constexpr auto choices(const KnotPlacement*) {
  return core::words<KnotPlacement>(
      {{KnotPlacement::polished, "polished"}, {KnotPlacement::ga, "ga"}});
}

struct KnotSearchOptions {
  int population = 100;
  int generations = 200;
  int trials = 30;
  std::uint64_t seed = 1;
  int threads = 0;  ///< <= 0: all of the machine's; the result does not depend on it
  KnotPlacement placement = KnotPlacement::polished;
  bool smart_start = false;  ///< seed the population around knots found by refinement
  int polish_rounds = 200;   ///< most improvements per trial
  double unite = 0;          ///< criterion given for fewer places of knots; 0: none
  core::Progress progress;
};

struct KnotSearchResult {
  std::vector<double> knots;  ///< interior, increasing, multiple ones repeated
  double bic = 0;
  int generations = 0;            ///< done, over all trials
  std::uint64_t evaluations = 0;  ///< least-squares fits of the genetic search
  bool cancelled = false;         ///< stopped by the progress token; the knots are the best so far
};

/// Searches interior knots of least criterion for the solver's data and domain. The solver's
/// data should be in a canonical frame (domain [0, 1], values of size about 1). Where Q is at its
/// floor without any knot there is nothing to search for.
KnotSearchResult search_knots(const SplineSolver& solver, const BayesCriterion& criterion,
                              const KnotSearchOptions& options);

}  // namespace keyline::fit
