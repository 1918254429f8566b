#include "keyline/surface/edit_patches.h"

#include <algorithm>
#include <utility>

#include "keyline/surface/edit_as_one.h"
#include "keyline/surface/turn_over.h"

namespace keyline::surface {

using core::ErrorCode;
using core::fail;

namespace {

double sum_of(const std::vector<PatchEdit>& patches, SurfaceValue EditResult::* which) {
  double sum = 0;
  for (const PatchEdit& p : patches)
    if (p.result) sum += ((*p.result).*which).sav;
  return sum;
}

std::size_t count_folded(std::span<const BezierSurface> given,
                         const std::vector<BezierSurface>& edited) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < given.size(); ++i) count += turns_over(given[i], edited[i]) ? 1 : 0;
  return count;
}

}  // namespace

int order_of(HoldJoints hold) {
  switch (hold) {
    case HoldJoints::free:
      return 0;
    case HoldJoints::g1:
      return 1;
    case HoldJoints::g2:
    case HoldJoints::zebra:
      break;
  }
  return 2;
}

core::Result<PatchesEdit> edit_patches(std::span<const BezierSurface> patches,
                                       const EditOptions& options, int threads,
                                       const EdgeTolerance& asked, HoldJoints hold) {
  if (patches.empty())
    return fail(ErrorCode::bad_input, "there is no patch to edit", "give one or more", "surface");
  const EdgeTolerance tolerance = with_gap(asked, patches);
  PatchesEdit all;
  all.joints = joints_of(patches, tolerance);
  const bool held = hold != HoldJoints::free && !all.joints.empty();
  EditOptions own = options;
  own.part_of_the_way |= held;  // all go together then, and only where it pays
  all.patches = detail::edit_each(patches, own, threads);
  if (options.progress.stop_requested()) return fail(ErrorCode::cancelled, "cancelled");
  if (std::none_of(all.patches.begin(), all.patches.end(),
                   [](const PatchEdit& p) { return p.result.has_value(); }))
    return std::unexpected(all.patches.front().why);
  for (std::size_t i = 0; i < patches.size(); ++i)
    all.surfaces.push_back(all.patches[i].result ? all.patches[i].result->surface : patches[i]);
  all.before = measure_joints(all.joints, patches, tolerance);
  all.sav_before = sum_of(all.patches, &EditResult::before);
  all.sav_apart = sum_of(all.patches, &EditResult::after);
  if (held) detail::edit_as_one({patches, own, threads, tolerance, hold}, all);
  all.lost = lost_orders(all.joints, patches, all.surfaces, order_of(hold), tolerance);
  if (options.progress.stop_requested()) return fail(ErrorCode::cancelled, "cancelled");
  all.sav_after = sum_of(all.patches, &EditResult::after);
  for (const PatchEdit& p : all.patches)
    if (p.result) all.departure = std::max(all.departure, p.result->departure);
  all.after = measure_joints(all.joints, all.surfaces, tolerance);
  all.folded = count_folded(patches, all.surfaces);
  all.turned = turned_farther(all.joints, patches, all.surfaces, tolerance);
  all.fold_growth = fold_growth(all.joints, patches, all.surfaces, tolerance);
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
                         std::size_t first, const EdgeTolerance& tolerance, HoldJoints hold) {
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
  part.lost = lost_orders(part.joints, given, part.surfaces, order_of(hold), tolerance);
  part.folded = count_folded(given, part.surfaces);
  part.turned = turned_farther(part.joints, given, part.surfaces, tolerance);
  part.fold_growth = fold_growth(part.joints, given, part.surfaces, tolerance);
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
                                                     const EdgeTolerance& asked, HoldJoints hold,
                                                     PatchesEdit* together) {
  std::vector<BezierSurface> patches;
  std::vector<SurfaceEdit> edits;
  for (const Surface& s : surfaces) {
    edits.push_back({patches_of(s), {}, {}});
    const auto& own = edits.back().grid.patches;
    patches.insert(patches.end(), own.begin(), own.end());
  }
  const EdgeTolerance tolerance = with_gap(asked, patches);
  auto all = edit_patches(patches, options, threads, tolerance, hold);
  if (!all) return std::unexpected(all.error());
  std::size_t first = 0;
  for (std::size_t i = 0; i < edits.size(); ++i) {
    edits[i].edited = part_of_edit(*all, edits[i].grid.patches, first, tolerance, hold);
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
