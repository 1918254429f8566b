#include "keyline/acquire/clean.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "keyline/acquire/statistics.h"
#include "keyline/core/coordinate.h"
#include "keyline/core/text.h"

namespace keyline::acquire::detail {
namespace {

std::string place_of(const RawCurve& raw, std::size_t i) {
  return i < raw.source_lines.size() ? "line " + std::to_string(raw.source_lines[i])
                                     : "points[" + std::to_string(i) + "]";
}

}  // namespace

core::Result<void> check_input(const RawCurve& raw) {
  using core::ErrorCode;
  if (raw.points.empty()) {
    return core::fail(ErrorCode::bad_input, "there are no points", "give at least two points");
  }
  if (!raw.weights.empty() && raw.weights.size() != raw.points.size()) {
    return core::fail(ErrorCode::bad_input,
                      core::counted(raw.weights.size(), "weight") + " for " +
                          core::counted(raw.points.size(), "point"),
                      "give one weight for each point, or none", "weights");
  }
  for (std::size_t i = 0; i < raw.points.size(); ++i) {
    if (core::is_too_large(raw.points[i])) {
      return core::coordinate_too_large(place_of(raw, i));
    }
    if (i < raw.weights.size() && (raw.weights[i] < 0 || std::isinf(raw.weights[i]))) {
      return core::fail(ErrorCode::bad_input, "a weight is negative or infinite",
                        "weights are finite and at least 0", place_of(raw, i));
    }
  }
  return {};
}

std::vector<std::size_t> finite_points(const RawCurve& raw) {
  std::vector<std::size_t> kept;
  kept.reserve(raw.points.size());
  for (std::size_t i = 0; i < raw.points.size(); ++i) {
    const bool weighted = raw.weights.empty() || std::isfinite(raw.weights[i]);
    if (core::is_finite(raw.points[i]) && weighted) kept.push_back(i);
  }
  return kept;
}

std::size_t merge_repeated(Working& work) {
  const double least = 1e-9 * middle_extent_of(work.points);
  std::size_t kept = 0;
  const std::size_t n = work.points.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (kept > 0 && core::distance(work.points[kept - 1], work.points[i]) <= least) {
      if (!work.weights.empty()) work.weights[kept - 1] += work.weights[i];
      continue;
    }
    work.points[kept] = work.points[i];
    if (!work.sources.empty()) work.sources[kept] = work.sources[i];
    if (!work.weights.empty()) work.weights[kept] = work.weights[i];
    ++kept;
  }
  work.points.resize(kept);
  if (!work.sources.empty()) work.sources.resize(kept);
  if (!work.weights.empty()) work.weights.resize(kept);
  return n - kept;
}

void remove_points(Working& work, const std::vector<std::size_t>& indices) {
  const auto keep_others = [&](auto& values) {
    if (values.empty()) return;
    std::size_t kept = 0, next = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (next < indices.size() && indices[next] == i) {
        ++next;
      } else {
        values[kept++] = values[i];
      }
    }
    values.resize(kept);
  };
  keep_others(work.points);
  keep_others(work.weights);
  keep_others(work.sources);
}

}  // namespace keyline::acquire::detail
