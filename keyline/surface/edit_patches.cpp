#include "keyline/surface/edit_patches.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <utility>

#include "keyline/numeric/parallel.h"

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

}  // namespace

core::Result<PatchesEdit> edit_patches(std::span<const BezierSurface> patches,
                                       const EditOptions& options, int threads,
                                       const EdgeTolerance& tolerance) {
  if (patches.empty())
    return fail(ErrorCode::bad_input, "there is no patch to edit", "give one or more", "surface");
  PatchesEdit all;
  all.patches = edit_each(patches, options, threads);
  if (options.progress.stop_requested()) return fail(ErrorCode::cancelled, "cancelled");
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const auto& result = all.patches[i].result;
    all.surfaces.push_back(result ? result->surface : patches[i]);
    if (result) all.departure = std::max(all.departure, result->departure);
  }
  if (std::none_of(all.patches.begin(), all.patches.end(),
                   [](const PatchEdit& p) { return p.result.has_value(); }))
    return std::unexpected(all.patches.front().why);
  all.joints = joints_of(patches, 10 * tolerance.gap);
  all.before = measure_joints(all.joints, patches, tolerance);
  all.after = measure_joints(all.joints, all.surfaces, tolerance);
  return all;
}

core::Result<SurfaceEdit> edit_surface(const Surface& s, const EditOptions& options, int threads,
                                       const EdgeTolerance& tolerance) {
  SurfaceEdit result{patches_of(s), {}, {}};
  if (is_rational(s))
    return fail(ErrorCode::unsupported, "a rational patch has no control matrices",
                "approximate it by a polynomial patch", "weights");
  const bool one = result.grid.patches.size() == 1;
  auto edited = edit_patches(result.grid.patches, options, threads, tolerance);
  if (!edited) return std::unexpected(edited.error());
  result.edited = std::move(*edited);
  if (one) {
    result.whole = result.edited.surfaces.front();
    return result;
  }
  const PatchGrid after{result.grid.rows, result.grid.columns, result.edited.surfaces};
  if (auto spline = joined(after, breakpoints_u(s), breakpoints_v(s), 1e-9 * extent(net_of(s))))
    result.whole = std::move(*spline);
  return result;
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
