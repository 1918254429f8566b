#include "keyline/fairing/corners.h"

#include <algorithm>
#include <array>
#include <optional>

#include "keyline/fairing/run_again.h"
#include "keyline/fairing/symmetric_run.h"
#include "keyline/numeric/parallel.h"

namespace keyline::fairing::detail {
namespace {

constexpr double kCornerRoom =
    0.9;  // of the tolerance: how far chains may meet from a corner's point

/// The place, or the nearest to it that leaves the corner's own point inside the tolerance.
core::Point2 near_corner(core::Point2 place, core::Point2 corner, double tolerance) {
  const double most = kCornerRoom * tolerance;
  const double far = core::distance(place, corner);
  return far <= most ? place : corner + (most / far) * (place - corner);
}

/// Shares of the way from one chain's end to the next one's start at which they may meet: half way
/// first, for that moves both least.
constexpr std::array kMeetings{0.5, 0.25, 0.75, 0.0, 1.0};

core::Point2 meeting(const Run& run, const RunResult& one, const RunResult& next, double share,
                     double tolerance) {
  const core::Point2 from = lac::end_pose(one.chain).position;
  const core::Point2 to = next.chain.start.position;
  core::Point2 place = near_corner(from + share * (to - from), run.points.back(), tolerance);
  for (const core::HalfPlane& half : run.inside)
    place = place - std::min(0.0, core::depth(half, place)) * half.normal;
  return place;
}

/// Chains brought together at the corners between them.
class Tying {
 public:
  Tying(std::vector<Run>& runs, std::vector<RunResult>& solved,
        const std::vector<curve::BSpline2>& splines, const OptionsOf& options, bool round)
      : runs_(runs),
        solved_(solved),
        splines_(splines),
        options_(options),
        round_(round),
        trials_(runs.size()) {
    for (std::size_t k = 0; k < runs.size(); ++k)
      held_.push_back(runs[k].tie_end && runs[next(k)].tie_start);
  }

  void run() {
    for (std::size_t k = 0; k < runs_.size(); ++k)
      if (corner_after(k)) meet(k, first_share(k));
    for_tied([&](std::size_t k) { tried(k); });
    for (std::size_t k = 0; k < runs_.size(); ++k)
      if (!reaches(k)) find_place(k);
    for_tied([&](std::size_t k) {
      RunOptions options = options_(k);
      options.progress.sink = nullptr;
      tie_ends(solved_[k], tried(k), runs_[k], spline(k), options);
    });
  }

 private:
  /// Each by itself, several at a time.
  template <class Work>
  void for_tied(Work&& work) {
    numeric::parallel_for(runs_.size(), options_(0).threads, [&](std::size_t k) {
      if (tied(k)) work(k);
    });
  }

  std::size_t next(std::size_t k) const { return (k + 1) % runs_.size(); }
  bool corner_after(std::size_t k) const {
    return (next(k) != 0 || round_) && !held_[k] && runs_[k].clamp_end == Clamp::none &&
           runs_[next(k)].clamp_start == Clamp::none;
  }
  bool tied(std::size_t k) const { return runs_[k].tie_start || runs_[k].tie_end; }
  curve::BSpline2 spline(std::size_t k) const {
    return k < splines_.size() ? splines_[k] : curve::BSpline2{};
  }

  /// A chain that reproduces its points stays where it ends.
  double first_share(std::size_t k) const {
    if (solved_[k].exact) return 0;
    return solved_[next(k)].exact ? 1 : kMeetings.front();
  }

  void meet(std::size_t k, double share) {
    runs_[k].tie_end = runs_[next(k)].tie_start =
        meeting(runs_[k], solved_[k], solved_[next(k)], share, options_(k).tolerance);
  }

  /// The run's pieces brought to where its ends are tied; only the calmest chain's are asked.
  const RunResult* tried(std::size_t k) {
    if (solved_[k].dense.joints.empty()) return nullptr;
    const Run& run = runs_[k];
    Trial& trial = trials_[k];
    if (trial.solved && trial.start == run.tie_start && trial.end == run.tie_end)
      return &*trial.solved;
    trial = {run.tie_start, run.tie_end, solved_[k]};
    trial.solved->within_tolerance = solve_again(*trial.solved, run, spline(k), 1);
    return &*trial.solved;
  }

  /// Whether they come there, with no more waves.
  bool reaches(std::size_t k) {
    if (!tied(k)) return true;
    const RunResult* trial = tried(k);
    return !trial || (trial->within_tolerance && waves_of({*trial}) <= waves_of({solved_[k]}));
  }

  /// Another place at one of the run's corners to which both its chains come; the first one where
  /// there is none.
  void find_place(std::size_t k) {
    const std::size_t before = (k + runs_.size() - 1) % runs_.size();
    for (const std::size_t corner : {k, before}) {
      if (!corner_after(corner)) continue;
      for (const double share : kMeetings) {
        if (options_(k).progress.stop_requested()) return;
        if (share == first_share(corner)) continue;
        meet(corner, share);
        if (reaches(corner) && reaches(next(corner))) return;
      }
      meet(corner, first_share(corner));
    }
  }

  /// What came of a run for its ends tied there.
  struct Trial {
    std::optional<core::Point2> start;
    std::optional<core::Point2> end;
    std::optional<RunResult> solved;
  };

  std::vector<Run>& runs_;
  std::vector<RunResult>& solved_;
  const std::vector<curve::BSpline2>& splines_;
  const OptionsOf& options_;
  bool round_;
  std::vector<Trial> trials_;
  std::vector<bool> held_;  ///< corners whose place is given
};

}  // namespace

void tie_corners(std::vector<Run>& runs, std::vector<RunResult>& solved,
                 const std::vector<curve::BSpline2>& splines, const OptionsOf& options,
                 bool round) {
  if (!runs.front().closed) Tying(runs, solved, splines, options, round).run();
}

}  // namespace keyline::fairing::detail
