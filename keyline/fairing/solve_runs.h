#pragma once

#include <optional>
#include <vector>

#include "keyline/core/error.h"
#include "keyline/fairing/corners.h"
#include "keyline/fairing/run.h"
#include "keyline/fit/fit_spline.h"

namespace keyline::fairing::detail {

/// How a run's spline is fitted.
fit::SplineFitOptions fit_of(const Run& run, fit::SplineFitOptions fit);

/// What there is of a run: the spline through its points, and its chain.
struct SolvedRun {
  curve::BSpline2 spline;
  double bic = 0;  ///< of the spline, where it was fitted
  RunResult chain;
};

/// Spline and chain of every run, several at a time: a chain waits for its spline only where an end
/// is held as that has it, or where the run is short. `splines`: of the runs, where they are known;
/// else empty. `fit`: threads, and what does not depend on the run. `progress`: of all together, in
/// place of the options'.
core::Result<std::vector<SolvedRun>> solve_runs(const std::vector<Run>& runs,
                                                const std::vector<curve::BSpline2>& splines,
                                                const fit::SplineFitOptions& fit,
                                                const OptionsOf& options,
                                                const core::Progress& progress);

}  // namespace keyline::fairing::detail
