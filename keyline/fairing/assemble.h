#pragma once

#include <optional>
#include <vector>

#include "keyline/fairing/fair.h"
#include "keyline/fairing/run.h"

/// Putting solved runs together into the answer.
namespace keyline::fairing::detail {

/// Points of a region given in fractions of the length, with the parameters of the feet of the
/// first and the last of them on the spline through the points (which runs by chord length, nearly
/// where points are dense and noisy).
struct RegionPoints {
  std::size_t first = 0;
  std::size_t last = 0;
  double t_first = 0;
  double t_last = 1;
};
RegionPoints points_in_region(const std::vector<core::Point2>& points, bool closed,
                              core::Interval region, const curve::BSpline2& spline);

/// Adds a run's pieces, of which some read as `asked`, and its points' offsets.
void add_run(FairResult& result, const RunResult& solved, const Run& run, int curve, double start,
             const std::vector<int>& asked);

/// Largest and mean square deviation of the offsets collected, and whether they pass.
void measure_deviation(FairResult& result);

/// Curves in order, joints between and inside them.
void assemble(FairResult& result, const std::vector<RunResult>& solved,
              const std::optional<curve::BSpline2>& before,
              const std::optional<curve::BSpline2>& after);

/// Notes something of the k-th of so many runs; a lone one is the curve and is not named.
void note_of_run(FairResult& result, std::size_t k, std::size_t runs, const std::string& text);

/// How the chain of the k-th of so many runs was found.
void note_run(FairResult& result, const RunResult& run, std::size_t k, std::size_t runs);

}  // namespace keyline::fairing::detail
