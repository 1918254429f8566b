#include "keyline/fairing/solve_runs.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <mutex>

#include <fmt/format.h>

#include "keyline/core/quantile.h"
#include "keyline/core/text.h"
#include "keyline/numeric/parallel.h"

namespace keyline::fairing::detail {
namespace {

constexpr double kSplineShare = 0.4;       // of the progress of a run
constexpr std::size_t kWorthAThread = 50;  // points: fewer are solved sooner than handed on

/// The progress of tasks that go on at a time, told by one of them at a time, as one.
class Together {
 public:
  Together(const core::Progress& whole, std::size_t tasks) : whole_(whole), told_(tasks, 0) {}

  /// Of a task that is this share of all of them.
  core::Progress of(std::size_t task, double share) {
    core::Progress part{nullptr, whole_.cancellation};
    if (!whole_.sink) return part;
    part.sink = [this, task, share](double fraction, std::string_view doing) {
      const std::scoped_lock lock(mutex_);
      done_ += share * std::max(0.0, fraction - told_[task]);
      told_[task] = std::max(told_[task], fraction);
      whole_.report(std::min(done_, 1.0), doing);
    };
    return part;
  }

 private:
  const core::Progress& whole_;
  std::mutex mutex_;
  std::vector<double> told_;  ///< of every task
  double done_ = 0;
};

/// Why nothing follows the run's points: names the widest step between them.
core::Failure no_chain(const Run& run) {
  std::vector<double> steps;
  for (std::size_t j = 1; j < run.points.size(); ++j)
    steps.push_back(core::distance(run.points[j - 1], run.points[j]));
  const auto widest = static_cast<std::size_t>(std::ranges::max_element(steps) - steps.begin());
  const double most = steps[widest];
  const core::Point2 after = run.points[widest + 1];
  return {
      core::ErrorCode::undrawable,
      fmt::format("no chain was found that follows the points without winding between them; the "
                  "widest step, {} to the point at ({:.6g}, {:.6g}), is {} times the usual one",
                  core::number_text(most, 4), after.x, after.y,
                  core::number_text(most / core::quantile(std::move(steps)), 3)),
      "leave out points that do not belong to the line, or give points in its gaps", "points"};
}

class Solving {
 public:
  Solving(const std::vector<Run>& runs, const std::vector<curve::BSpline2>& splines,
          const fit::SplineFitOptions& fit, const OptionsOf& options,
          const core::Progress& progress)
      : runs_(runs),
        splines_(splines),
        fit_(fit),
        options_(options),
        together_(progress, 2 * runs.size()),
        solved_(runs.size()),
        failure_(runs.size()) {}

  core::Result<std::vector<SolvedRun>> run() {
    const std::size_t n = runs_.size();
    numeric::parallel_for(2 * n, fit_.threads, [&](std::size_t task) {
      const std::size_t k = task % n;
      if (task < n) find_spline(k);
      const bool found = task >= n || !failure_[k];
      if (found && alone(k) == (task >= n)) find_chain(k);
    });
    for (const auto& failure : failure_)
      if (failure) return std::unexpected(*failure);
    return std::move(solved_);
  }

 private:
  double share() const { return 1 / static_cast<double>(runs_.size()); }

  /// Whether the chain is found beside the spline, without it.
  bool alone(std::size_t k) const {
    const Run& run = runs_[k];
    return run.clamp_start == Clamp::none && run.clamp_end == Clamp::none &&
           run.points.size() >= kWorthAThread && run.length > 0 && std::isfinite(run.length);
  }

  void find_spline(std::size_t k) {
    if (!splines_.empty()) {
      solved_[k].spline = splines_[k];
      return;
    }
    const Run& run = runs_[k];
    fit::SplineFitOptions fit = fit_of(run, fit_);
    fit.progress = together_.of(k, kSplineShare * share());
    auto found = fit::fit_spline(run.points, run.weights, fit);
    if (!found) {
      failure_[k] = found.error();
      return;
    }
    solved_[k].spline = std::move(found->curve);
    solved_[k].bic = found->bic;
  }

  void find_chain(std::size_t k) {
    RunOptions options = options_(k);
    options.progress = together_.of(runs_.size() + k, (1 - kSplineShare) * share());
    solved_[k].chain =
        fair_run(runs_[k], alone(k) ? curve::BSpline2{} : solved_[k].spline, options);
    if (winds(solved_[k].chain, runs_[k])) failure_[k] = no_chain(runs_[k]);
  }

  const std::vector<Run>& runs_;
  const std::vector<curve::BSpline2>& splines_;
  const fit::SplineFitOptions& fit_;
  const OptionsOf& options_;
  Together together_;
  std::vector<SolvedRun> solved_;
  std::vector<std::optional<core::Failure>> failure_;
};

}  // namespace

fit::SplineFitOptions fit_of(const Run& run, fit::SplineFitOptions fit) {
  fit.order = std::min<int>(fit.order, static_cast<int>(run.points.size()));
  fit.closed = run.closed && run.points.size() > 8;
  fit.must_pass = run.must_pass;
  return fit;
}

core::Result<std::vector<SolvedRun>> solve_runs(const std::vector<Run>& runs,
                                                const std::vector<curve::BSpline2>& splines,
                                                const fit::SplineFitOptions& fit,
                                                const OptionsOf& options,
                                                const core::Progress& progress) {
  return Solving(runs, splines, fit, options, progress).run();
}

}  // namespace keyline::fairing::detail
