#include "keyline/surface/edit_patches.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <numeric>
#include <utility>

#include "keyline/numeric/parallel.h"
#include "keyline/surface/departure.h"
#include "keyline/surface/hold_joints.h"

namespace keyline::surface {

using core::ErrorCode;
using core::fail;

namespace {

std::vector<PatchEdit> edit_each(std::span<const BezierSurface> patches, const EditOptions& options,
                                 int threads) {
  std::vector<PatchEdit> all(patches.size());
  std::atomic<std::size_t> done = 0;
  std::mutex reporting;
  EditOptions quiet = options;
  quiet.progress.sink = nullptr;
  numeric::parallel_for(patches.size(), threads, [&](std::size_t i) {
    if (options.progress.stop_requested()) return;
    auto edited = edit(patches[i], quiet);
    if (edited)
      all[i].result = std::move(*edited);
    else
      all[i].why = std::move(edited.error());
    const std::size_t count = ++done;
    const std::lock_guard lock(reporting);
    options.progress.report(static_cast<double>(count) / patches.size(), "patches");
  });
  return all;
}

/// The edits' nets, of the degrees given; what was not edited stays.
std::vector<BezierSurface> nets_of(std::span<const BezierSurface> given,
                                   const std::vector<PatchEdit>& edits) {
  std::vector<BezierSurface> all;
  for (std::size_t i = 0; i < given.size(); ++i) {
    all.push_back(edits[i].result ? edits[i].result->surface : given[i]);
    Net& net = all.back().net;
    const Net& as = given[i].net;
    if (net.rows != as.rows || net.columns != as.columns)
      all.back() = elevate_degree(all.back(), as.rows - net.rows, as.columns - net.columns);
  }
  return all;
}

/// Control points that the edit's options or its failure leave where they are.
std::vector<std::vector<bool>> fixed_points(std::span<const BezierSurface> patches,
                                            const std::vector<PatchEdit>& edits, Keep keep) {
  std::vector<std::vector<bool>> fixed;
  for (std::size_t p = 0; p < patches.size(); ++p) {
    const Net& net = patches[p].net;
    fixed.emplace_back(net.points.size(), !edits[p].result);
    for (int i = 0; i < net.rows; ++i)
      for (int j = 0; j < net.columns; ++j) {
        const bool rim_u = i == 0 || i + 1 == net.rows;
        const bool rim_v = j == 0 || j + 1 == net.columns;
        const bool kept = keep == Keep::start      ? i == 0 && j == 0
                          : keep == Keep::boundary ? rim_u || rim_v
                                                   : rim_u && rim_v;
        if (kept) fixed[p][net.index(i, j)] = true;
      }
  }
  return fixed;
}

/// Editing of all patches with their joints held.
class Together {
 public:
  Together(std::span<const BezierSurface> given, const EditOptions& options, int threads,
           const EdgeTolerance& tolerance, HoldJoints hold, const PatchesEdit& all)
      : given_(given),
        options_(options),
        threads_(threads),
        tolerance_(tolerance),
        joints_(all.joints),
        fixed_(fixed_points(given, all.patches, options.keep)) {
    const int most = hold == HoldJoints::G2 ? 2 : 1;
    for (const int order : joint_orders(joints_, given, tolerance))
      orders_.push_back(std::min(order, most));
  }

  /// Rounds of editing and holding; `all` gets the best.
  void run(PatchesEdit& all) {
    std::vector<BezierSurface> best(given_.begin(), given_.end());
    double least = all.sav_before;
    std::vector<PatchEdit> edits = all.patches;
    for (int round = 0; round < kRounds && !options_.progress.stop_requested(); ++round) {
      const auto held = hold(nets_of(given_, edits));
      bool better = false;
      for (const double share : {1.0, 0.6, 0.3}) {
        auto moved = within_limit(held, share);
        const double sav = total(moved);
        if (sav >= least * (1 - kWorthIt)) continue;
        least = sav;
        best = std::move(moved);
        better = true;
        break;
      }
      if (!better || round + 1 == kRounds) break;
      EditOptions farther = options_;  // the limit is measured from what was given
      farther.limit.reset();
      edits = edit_each(best, farther, threads_);
    }
    take(best, all);
  }

 private:
  static constexpr int kRounds = 4;
  static constexpr double kWorthIt = 1e-3;  ///< of SAV that a round has to gain
  static constexpr int kTries = 4;
  static constexpr int kHalvings = 10;  ///< towards the limit

  /// Nets nearest to the wanted ones that hold the joints; those that fail are made stiff.
  std::vector<BezierSurface> hold(const std::vector<BezierSurface>& wanted) {
    for (int attempt = 0; attempt < kTries; ++attempt) {
      std::vector<HeldJoint> held;
      for (std::size_t i = 0; i < joints_.size(); ++i)
        if (orders_[i] >= 0)
          held.push_back({joints_[i], orders_[i], stiff_.size() > i && stiff_[i]});
      auto moved = hold_joints(given_, wanted, held, fixed_);
      stiff_.resize(joints_.size(), false);
      const auto now = joint_orders(joints_, moved, tolerance_);
      bool good = true;
      for (std::size_t i = 0; i < joints_.size(); ++i)
        if (now[i] < orders_[i] && !stiff_[i]) {
          stiff_[i] = true;
          good = false;
        }
      if (good || attempt + 1 == kTries) return moved;
    }
    return {given_.begin(), given_.end()};
  }

  /// That share of the moves, or what of it the limit allows.
  std::vector<BezierSurface> within_limit(const std::vector<BezierSurface>& held,
                                          double share) const {
    auto moved = blend(held, share);
    if (!options_.limit) return moved;
    double low = 0;
    double high = share;
    if (farthest(moved) <= *options_.limit) return moved;
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = 0.5 * (low + high);
      (farthest(blend(held, middle)) <= *options_.limit ? low : high) = middle;
    }
    return blend(held, low);
  }

  std::vector<BezierSurface> blend(const std::vector<BezierSurface>& held, double share) const {
    std::vector<BezierSurface> moved(given_.begin(), given_.end());
    for (std::size_t p = 0; p < moved.size(); ++p)
      for (std::size_t i = 0; i < moved[p].net.points.size(); ++i)
        moved[p].net.points[i] = core::mix(given_[p].net.points[i], held[p].net.points[i], share);
    return moved;
  }

  double farthest(const std::vector<BezierSurface>& moved) const {
    std::vector<double> away(moved.size());
    numeric::parallel_for(moved.size(), threads_, [&](std::size_t i) {
      away[i] = moved[i] == given_[i] ? 0 : departure_bound(given_[i], moved[i]);
    });
    return *std::max_element(away.begin(), away.end());
  }

  double total(const std::vector<BezierSurface>& moved) const {
    std::vector<double> values(moved.size(), 0);
    numeric::parallel_for(moved.size(), threads_, [&](std::size_t i) {
      const auto value = sav(moved[i], value_options(options_));
      values[i] = value ? value->sav : 0;
    });
    return std::accumulate(values.begin(), values.end(), 0.0);
  }

 public:
  static classa::CavOptions value_options(const EditOptions& options) {
    classa::CavOptions general;
    general.alpha_max = options.alpha_max;
    general.end_tolerance = options.end_tolerance;
    return general;
  }

 private:
  void take(const std::vector<BezierSurface>& best, PatchesEdit& all) const {
    numeric::parallel_for(best.size(), threads_, [&](std::size_t i) {
      auto& [result, why] = all.patches[i];
      if (!result) return;
      if (best[i] == given_[i]) {
        result->target = "as given";
        result->amount = 0;
      } else {
        result->target += ", joints held";
      }
      if (auto done = move_edit(given_[i], best[i], options_, *result); !done) {
        why = std::move(done.error());
        result.reset();
      }
    });
    all.surfaces = best;
    const auto now = joint_orders(joints_, best, tolerance_);
    all.lost = 0;
    for (std::size_t i = 0; i < now.size(); ++i) all.lost += now[i] < orders_[i];
  }

  std::span<const BezierSurface> given_;
  const EditOptions& options_;
  int threads_;
  const EdgeTolerance& tolerance_;
  const std::vector<PatchJoint>& joints_;
  std::vector<std::vector<bool>> fixed_;
  std::vector<int> orders_;  ///< to be held, by joint
  std::vector<bool> stiff_;
};

double sum_of(const std::vector<PatchEdit>& patches, SurfaceValue EditResult::* which) {
  double sum = 0;
  for (const PatchEdit& p : patches)
    if (p.result) sum += ((*p.result).*which).sav;
  return sum;
}

}  // namespace

core::Result<PatchesEdit> edit_patches(std::span<const BezierSurface> patches,
                                       const EditOptions& options, int threads,
                                       const EdgeTolerance& tolerance, HoldJoints hold) {
  if (patches.empty())
    return fail(ErrorCode::bad_input, "there is no patch to edit", "give one or more", "surface");
  PatchesEdit all;
  all.patches = edit_each(patches, options, threads);
  if (options.progress.stop_requested()) return fail(ErrorCode::cancelled, "cancelled");
  if (std::none_of(all.patches.begin(), all.patches.end(),
                   [](const PatchEdit& p) { return p.result.has_value(); }))
    return std::unexpected(all.patches.front().why);
  for (std::size_t i = 0; i < patches.size(); ++i)
    all.surfaces.push_back(all.patches[i].result ? all.patches[i].result->surface : patches[i]);
  all.joints = joints_of(patches, 10 * tolerance.gap);
  all.before = measure_joints(all.joints, patches, tolerance);
  all.sav_before = sum_of(all.patches, &EditResult::before);
  all.sav_apart = sum_of(all.patches, &EditResult::after);
  if (hold != HoldJoints::free && !all.joints.empty())
    Together(patches, options, threads, tolerance, hold, all).run(all);
  if (options.progress.stop_requested()) return fail(ErrorCode::cancelled, "cancelled");
  all.sav_after = sum_of(all.patches, &EditResult::after);
  for (const PatchEdit& p : all.patches)
    if (p.result) all.departure = std::max(all.departure, p.result->departure);
  all.after = measure_joints(all.joints, all.surfaces, tolerance);
  return all;
}

namespace {

/// The patches' edit as one of the surface they were cut from.
void make_whole(const Surface& s, SurfaceEdit& result) {
  if (result.grid.patches.size() == 1) {
    result.whole = result.edited.surfaces.front();
    return;
  }
  const PatchGrid after{result.grid.rows, result.grid.columns, result.edited.surfaces};
  if (auto spline = joined(after, breakpoints_u(s), breakpoints_v(s), 1e-9 * extent(net_of(s))))
    result.whole = std::move(*spline);
}

core::Failure rational() {
  return {ErrorCode::unsupported, "a rational patch has no control matrices",
          "approximate it by a polynomial patch", "weights"};
}

}  // namespace

core::Result<SurfaceEdit> edit_surface(const Surface& s, const EditOptions& options, int threads,
                                       const EdgeTolerance& tolerance, HoldJoints hold) {
  SurfaceEdit result{patches_of(s), {}, {}};
  if (is_rational(s)) return std::unexpected(rational());
  auto edited = edit_patches(result.grid.patches, options, threads, tolerance, hold);
  if (!edited) return std::unexpected(edited.error());
  result.edited = std::move(*edited);
  make_whole(s, result);
  return result;
}

namespace {

/// What the patches [first, first + count) of an edit are by themselves.
PatchesEdit part_of_edit(const PatchesEdit& all, std::span<const BezierSurface> given,
                         std::size_t first, const EdgeTolerance& tolerance) {
  const std::size_t count = given.size();
  PatchesEdit part;
  const auto from = static_cast<std::ptrdiff_t>(first);
  const auto to = static_cast<std::ptrdiff_t>(first + count);
  part.patches.assign(all.patches.begin() + from, all.patches.begin() + to);
  part.surfaces.assign(all.surfaces.begin() + from, all.surfaces.begin() + to);
  for (PatchJoint joint : all.joints) {
    if (joint.first < first || joint.second < first) continue;
    if (joint.first >= first + count || joint.second >= first + count) continue;
    joint.first -= first;
    joint.second -= first;
    part.joints.push_back(joint);
  }
  part.before = measure_joints(part.joints, given, tolerance);
  part.after = measure_joints(part.joints, part.surfaces, tolerance);
  part.sav_before = sum_of(part.patches, &EditResult::before);
  part.sav_after = sum_of(part.patches, &EditResult::after);
  part.sav_apart = part.sav_after;
  for (const PatchEdit& p : part.patches)
    if (p.result) part.departure = std::max(part.departure, p.result->departure);
  return part;
}

}  // namespace

core::Result<std::vector<SurfaceEdit>> edit_surfaces(std::span<const Surface> surfaces,
                                                     const EditOptions& options, int threads,
                                                     const EdgeTolerance& tolerance,
                                                     HoldJoints hold, PatchesEdit* together) {
  std::vector<BezierSurface> patches;
  std::vector<SurfaceEdit> edits;
  for (const Surface& s : surfaces) {
    edits.push_back({patches_of(s), {}, {}});
    const auto& own = edits.back().grid.patches;
    patches.insert(patches.end(), own.begin(), own.end());
  }
  auto all = edit_patches(patches, options, threads, tolerance, hold);
  if (!all) return std::unexpected(all.error());
  std::size_t first = 0;
  for (std::size_t i = 0; i < edits.size(); ++i) {
    edits[i].edited = part_of_edit(*all, edits[i].grid.patches, first, tolerance);
    first += edits[i].grid.patches.size();
    make_whole(surfaces[i], edits[i]);
  }
  if (together) *together = std::move(*all);
  return edits;
}

namespace {

std::vector<PatchValue> values_of(const SurfaceEdit& edit, SurfaceValue EditResult::* which) {
  std::vector<PatchValue> values;
  for (std::size_t i = 0; i < edit.edited.patches.size(); ++i) {
    const int row = static_cast<int>(i) / edit.grid.columns;
    const int column = static_cast<int>(i) % edit.grid.columns;
    const auto& result = edit.edited.patches[i].result;
    if (result) {
      values.push_back({row, column, (*result).*which});
    } else if (auto plain = sav(edit.grid.patches[i])) {
      values.push_back({row, column, std::move(*plain)});
    }
  }
  return values;
}

}  // namespace

std::vector<PatchValue> values_before(const SurfaceEdit& edit) {
  return values_of(edit, &EditResult::before);
}
std::vector<PatchValue> values_after(const SurfaceEdit& edit) {
  return values_of(edit, &EditResult::after);
}

}  // namespace keyline::surface
