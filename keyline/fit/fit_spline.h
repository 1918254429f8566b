#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "keyline/core/error.h"
#include "keyline/core/point.h"
#include "keyline/core/progress.h"
#include "keyline/curve/bspline.h"
#include "keyline/fit/knot_search.h"
#include "keyline/fit/least_squares_spline.h"
#include "keyline/fit/parametrization.h"

/// Splines with knots found by themselves: step 2 of [Fairing].
namespace keyline::fit {

/// Defaults are the middle of the ranges [Fairing] recommends (population 50 to 150, generations
/// 100 to 300, trials 20 to 40).
struct SplineFitOptions {
  int order = 4;          ///< 4 to 6 (2 to 8 work)
  int population = 100;   ///< 2 … 100,000, rounded up to even
  int generations = 200;  ///< 0 … 1,000,000
  int trials = 30;        ///< 1 … 100,000
  KnotPlacement knots = KnotPlacement::polished;
  std::uint64_t seed = 1;
  int threads = 0;  ///< <= 0: all of the machine's; the result does not depend on it
  Parametrization parameter = Parametrization::chord;  ///< of plane curves
  /// Rounding of the data, in their unit: residuals are not fitted below rounding / sqrt(12).
  /// 0: found from the decimals of the data (note that turned data show none).
  double rounding = 0;
  /// Nor are they below this fraction of the size of the data (largest distance from the
  /// centroid; of a function from its mean): exact data must not invite endless knots.
  double resolution = 1e-8;
  /// More data than this are averaged into this many bins for the search (0: never); the final
  /// fit uses all of them.
  std::size_t condense_above = 4000;
  bool smart_start = false;  ///< start the population near knots found by refinement
  int polish_rounds = 200;   ///< most improvements of the polish per trial
  /// Criterion given for knots that are one where no two data lie between them: kinks are multiple
  /// knots then, and no needles of curvature. 0: none.
  double unite = 0;
  bool closed = false;  ///< plane curves: fit a periodic spline, see fit_spline
  /// Indices of points the curve must pass: their weight becomes a million times the largest, and
  /// where the knots found let it miss them all the same it gets more (must_pass.h).
  std::vector<std::size_t> must_pass;
  core::Progress progress;

  static constexpr auto describe() {
    return core::fields(
        core::field<&SplineFitOptions::order>("order of the spline, its degree + 1")
            .within(core::from_to(2, 8)),
        core::field<&SplineFitOptions::population>("individuals in the genetic search for knots")
            .within(core::from_to(2, 100'000)),
        core::field<&SplineFitOptions::generations>("generations of that search")
            .within(core::from_to(0, 1'000'000)),
        core::field<&SplineFitOptions::trials>("independent searches; the best is kept")
            .within(core::from_to(1, 100'000)),
        core::field<&SplineFitOptions::knots>(
            "polished: the search, then a local one; ga: the plain genetic search of [Fairing]"),
        core::field<&SplineFitOptions::parameter>("how parameters are assigned to points"));
  }

  /// A small budget for the fairing pipeline: smart start, population 30, generations 30, one
  /// trial, order 5 (continuous rate of curvature), smooth_chord, at most 800 data in the search.
  static SplineFitOptions for_fairing();
};

enum class SplineFitStatus {
  complete,  ///< the whole search was done
  cancelled  ///< stopped by the progress token: the best found until then
};

struct SplineFitReport {
  SplineFitStatus status = SplineFitStatus::complete;
  int generations = 0;            ///< done, over all trials
  std::uint64_t evaluations = 0;  ///< least-squares fits of the genetic search
  std::size_t data_used = 0;      ///< in the search: all, or the bins they were averaged into
  double rounding = 0;            ///< as given or found; 0: none found
  std::uint64_t seed = 0;
};

struct SplineFit {
  curve::BSpline2 curve;               ///< domain [0, 1], clamped
  std::vector<double> parameters;      ///< t of each point
  std::vector<double> interior_knots;  ///< increasing, multiple ones repeated
  double sse = 0;        ///< Q of [Fairing] Eq. 4, both coordinates, by the weights given
  double bic = 0;        ///< of Q (floored) in the data's unit
  double deviation = 0;  ///< largest distance of a point from the curve at its parameter
  double rms = 0;        ///< root of the mean squared distance, by the weights given
  SplineFitReport report;
};

struct FunctionFit {
  LeastSquaresSpline spline;           ///< over [least x, largest x]
  std::vector<double> interior_knots;  ///< in x
  double sse = 0;
  double bic = 0;
  double deviation = 0;  ///< largest |y - S(x)|
  double rms = 0;
  SplineFitReport report;
};

/// Fits a plane curve through ordered points; weights empty or one positive per point.
///
/// The knots minimise N ln Q + ln N (2n + m), Q the sum over both coordinates. They are searched
/// in a frame of the data's own (place, direction of travel, attitude, size), so that moved,
/// turned, scaled or reversed data give the same curve up to rounding.
///
/// Closed: the points are a loop (the first need not be repeated). The knots are searched on the
/// loop continued by a tenth beyond both ends, and the result is the periodic least-squares
/// spline of those knots, written as a clamped curve over [0, 1] that closes with all its
/// continuity.
///
/// Errors: bad_input for fewer points than the order, numbers not finite or so large that lengths
/// overflow, all points equal, weights not positive, options out of range; not_converged where no
/// more knots make it pass a point it must.
core::Result<SplineFit> fit_spline(std::span<const core::Point2> points,
                                   std::span<const double> weights = {},
                                   const SplineFitOptions& options = {});

/// Fits y as a function of x. x need not be sorted and may repeat. Errors as fit_spline, and where
/// fewer x than the order differ.
core::Result<FunctionFit> fit_function(std::span<const double> x, std::span<const double> y,
                                       std::span<const double> weights = {},
                                       const SplineFitOptions& options = {});

}  // namespace keyline::fit
