#include "keyline/surface/network.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <optional>
#include <utility>

#include "keyline/core/angle.h"
#include "keyline/core/extent.h"
#include "keyline/numeric/parallel.h"

namespace keyline::surface {

using classa::CavOptions;
using classa::CurveValue;
using core::ErrorCode;
using core::fail;
using core::Point3;
using core::Result;

namespace {

/// No control matrix at all: a curve without a length or without a chord.
bool has_no_chord(const std::vector<Point3>& control) {
  return core::distance(control.front(), control.back()) <= 1e-12 * core::reach(control);
}

CurveValue without_matrix(const std::vector<Point3>& control, const CavOptions& options) {
  const classa::Diagonals d = classa::diagonals(options.alpha_max);
  CurveValue value;
  value.type = 5;
  value.cav = std::pow(d.boundary * d.plane, 3);
  value.degree = static_cast<int>(control.size()) - 1;
  value.no_minimum = "the curve has no length or ends where it starts";
  return value;
}

Result<CurveValue> value_of(const std::vector<Point3>& control, const CavOptions& options) {
  if (has_no_chord(control)) return without_matrix(control, options);
  return classa::cav(std::span<const Point3>(control), options);
}

Result<void> check(const BezierSurface& s) {
  if (is_rational(s))
    return fail(ErrorCode::unsupported, "a rational patch has no control matrices",
                "approximate it by a polynomial patch", "weights");
  return validate(s);
}

}  // namespace

std::vector<NetworkCurve> network_curves(const Net& net) {
  std::vector<NetworkCurve> curves;
  const auto next_name = [&] { return "A" + std::to_string(curves.size() + 1); };
  for (int i = 0; i < net.rows; ++i) curves.push_back({next_name(), true, i, row_of(net, i)});
  for (int j = 0; j < net.columns; ++j)
    curves.push_back({next_name(), false, j, column_of(net, j)});
  return curves;
}

Result<SurfaceValue> sav(const BezierSurface& s, const CavOptions& options) {
  if (!(options.alpha_max > 0 && options.alpha_max < core::kPi / 2))
    return fail(ErrorCode::bad_input, "alpha_max has to lie between 0 and pi/2",
                "give radians, for example 1.0982", "alpha_max");
  return sav(s, [&options](const NetworkCurve&) { return options; });
}

Result<SurfaceValue> sav(const BezierSurface& s, const CavOptionsOf& options) {
  if (auto sound = check(s); !sound) return std::unexpected(sound.error());
  SurfaceValue result;
  for (const NetworkCurve& curve : network_curves(s.net)) {
    auto value = value_of(curve.control, options(curve));
    if (!value) {
      core::Failure failure = value.error();
      const bool of_option = !failure.path.empty() && !failure.path.starts_with("points") &&
                             !failure.path.starts_with("weights");
      if (!of_option) failure.path = "surface";
      failure.message = curve.name + ": " + failure.message;
      return std::unexpected(std::move(failure));
    }
    result.sav += value->cav;
    result.curves.push_back({curve.name, std::move(*value)});
    if (result.curves.back().value.cav > result.curves[result.worst].value.cav)
      result.worst = result.curves.size() - 1;
  }
  return result;
}

Result<std::vector<PatchValue>> sav_by_patch(const Surface& s, const CavOptions& options,
                                             int threads, const core::Progress& progress) {
  const PatchGrid grid = patches_of(s);
  std::vector<std::optional<Result<SurfaceValue>>> found(grid.patches.size());
  std::atomic<std::size_t> done = 0;
  std::mutex reporting;
  numeric::parallel_for(grid.patches.size(), threads, [&](std::size_t i) {
    if (progress.stop_requested()) return;
    found[i] = sav(grid.patches[i], options);
    const std::size_t count = ++done;
    const std::lock_guard lock(reporting);
    progress.report(static_cast<double>(count) / found.size(), "network curves");
  });
  if (progress.stop_requested()) return fail(ErrorCode::cancelled, "cancelled");
  std::vector<PatchValue> values;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const int row = static_cast<int>(i) / grid.columns;
    const int column = static_cast<int>(i) % grid.columns;
    if (!*found[i]) {
      core::Failure failure = found[i]->error();
      if (found.size() > 1)
        failure.message = "patch [" + std::to_string(row) + "][" + std::to_string(column) +
                          "]: " + failure.message;
      return std::unexpected(std::move(failure));
    }
    values.push_back({row, column, std::move(**found[i])});
  }
  return values;
}

void add_nearest(const Surface& s, std::vector<PatchValue>& values, const CavOptions& options,
                 int threads, const core::Progress& progress) {
  const PatchGrid grid = patches_of(s);
  std::vector<std::pair<PatchValue*, std::size_t>> wanted;
  for (PatchValue& p : values)
    for (std::size_t i = 0; i < p.value.curves.size(); ++i)
      if (p.value.curves[i].value.type > 3) wanted.emplace_back(&p, i);
  std::atomic<std::size_t> done = 0;
  std::mutex reporting;
  numeric::parallel_for(wanted.size(), threads, [&](std::size_t k) {
    if (progress.stop_requested()) return;
    const auto [patch, i] = wanted[k];
    const auto at = static_cast<std::size_t>(patch->row * grid.columns + patch->column);
    const auto curves = network_curves(grid.patches[at].net);
    patch->value.curves[i].nearest = classa::nearest_value({curves[i].control, {}}, options);
    const std::size_t count = ++done;
    const std::lock_guard lock(reporting);
    progress.report(static_cast<double>(count) / wanted.size(), "nearest curves");
  });
}

}  // namespace keyline::surface
