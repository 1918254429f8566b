#include "keyline/fairing/points_splines.h"

#include <utility>

#include "keyline/fairing/runs.h"
#include "keyline/fairing/solve_runs.h"

namespace keyline::fairing {

core::Result<std::vector<curve::BSpline2>> splines_of(const acquire::KeyLine& line,
                                                      const fit::SplineFitOptions& options) {
  const std::vector<detail::Run> runs = detail::smooth_runs(line);
  std::vector<curve::BSpline2> splines;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    fit::SplineFitOptions of_run = detail::fit_of(runs[k], options);
    const auto count = static_cast<double>(runs.size());
    of_run.progress = core::part_of(options.progress, static_cast<double>(k) / count,
                                    static_cast<double>(k + 1) / count);
    auto found = fit::fit_spline(runs[k].points, runs[k].weights, of_run);
    if (!found) return std::unexpected(found.error());
    splines.push_back(std::move(found->curve));
  }
  return splines;
}

}  // namespace keyline::fairing
