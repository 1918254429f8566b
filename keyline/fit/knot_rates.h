#pragma once

#include <optional>

#include "keyline/core/describe.h"
#include "keyline/fit/fit_spline.h"

/// Further settings of [Fairing] 3.2 for those who repeat its experiments.
namespace keyline::fit {

/// How often the genetic search changes its individuals (adaptive after Srinivas and Patnaik): the
/// better an individual, the rarer.
struct GeneticRates {
  double crossover = 1;    ///< k1 and k3: of pairs whose better parent is worse than the mean
  double mutation = 0.5;   ///< k2 and k4: of individuals worse than the mean
  double minimum = 0.01;   ///< of either, of the best
  double insertion = 0.5;  ///< share of the mutations that insert a knot; the others delete one
  static constexpr auto describe() {
    constexpr auto kShare = core::from_to(0, 1);
    return core::fields(
        core::field<&GeneticRates::crossover>("of pairs worse than the mean: k1, k3")
            .within(kShare),
        core::field<&GeneticRates::mutation>("of individuals worse than the mean: k2, k4")
            .within(kShare),
        core::field<&GeneticRates::minimum>("of either, of the best").within(kShare),
        core::field<&GeneticRates::insertion>("share of the mutations that insert a knot")
            .within(kShare));
  }
};

struct SplineSettings {
  GeneticRates rates;
  /// Of functions: where the spline is wanted, [a, b]; holds all data, which are its range unless
  /// given. Knots lie among the data, the polynomials at the ends go on to a and b.
  std::optional<core::Interval> interval;
};

/// As search_knots, fit_spline and fit_function without settings. Errors: bad_input as well for an
/// interval that does not hold all data (path "interval").
KnotSearchResult search_knots(const SplineSolver& solver, const BayesCriterion& criterion,
                              const KnotSearchOptions& options, const GeneticRates& rates);
core::Result<SplineFit> fit_spline(std::span<const core::Point2> points,
                                   std::span<const double> weights, const SplineFitOptions& options,
                                   const GeneticRates& rates);
core::Result<FunctionFit> fit_function(std::span<const double> x, std::span<const double> y,
                                       std::span<const double> weights,
                                       const SplineFitOptions& options,
                                       const SplineSettings& settings);

}  // namespace keyline::fit
