#pragma once

#include <vector>

#include "keyline/fairing/run.h"

namespace keyline::fairing::detail {

/// The key-line cut at its corners into smooth runs; neighbours share the corner's point. A
/// closed line with corners is cut open at the first of them.
std::vector<Run> smooth_runs(const acquire::KeyLine& line, bool at_corners = true);

/// The same, cut as `options` ask; they know what they pass and how they end.
std::vector<Run> runs_of(const acquire::KeyLine& line, const FairOptions& options);

/// Runs learn which of the key-line's points, told by their indices, they pass through.
void pass_through(std::vector<Run>& runs, const std::vector<std::size_t>& must_pass);

/// Points first … last of the key-line as one open run.
Run run_between(const acquire::KeyLine& line, std::size_t first, std::size_t last);

/// Runs learn what they stay inside; those whose outer ends stand on a border, or beyond it by
/// their noise, end on it. bad_input where a point lies farther out than the tolerance.
core::Result<void> bound_runs(std::vector<Run>& runs, const acquire::KeyLine& line,
                              const FairOptions& options, double tolerance);

}  // namespace keyline::fairing::detail
