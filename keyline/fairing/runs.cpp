#include "keyline/fairing/runs.h"

#include <algorithm>

#include <fmt/format.h>

#include "keyline/core/polygon.h"

namespace keyline::fairing::detail {
namespace {

/// The polygon's length overstates that of the curve where points are denser than their noise; the
/// key-line knows its own.
double overstated(const acquire::KeyLine& line) {
  const double polygon = core::polygon_length(line.points, line.closed);
  return line.length > 0 && line.length < polygon ? line.length / polygon : 1;
}

/// Points first … first + count of the line, wrapping around where it is closed.
Run stretch(const acquire::KeyLine& line, std::size_t first, std::size_t count) {
  Run run;
  for (std::size_t k = 0; k <= count; ++k) {
    const std::size_t index = (first + k) % line.points.size();
    run.points.push_back(line.points[index]);
    if (!line.weights.empty()) run.weights.push_back(line.weights[index]);
    run.index.push_back(index);
  }
  run.length = overstated(line) * core::polygon_length(run.points, false);
  return run;
}

/// Where the line is cut, in its order: an open one at its ends too, a closed one at its first
/// corner again after a round.
std::vector<std::size_t> cuts_of(const acquire::KeyLine& line, bool at_corners) {
  const std::size_t n = line.points.size();
  std::vector<std::size_t> cuts;
  if (!line.closed) cuts.push_back(0);
  if (at_corners)
    for (const std::size_t c : line.corners)
      if (line.closed || (c > 0 && c + 1 < n)) cuts.push_back(c);
  if (!line.closed)
    cuts.push_back(n - 1);
  else if (!cuts.empty())
    cuts.push_back(cuts.front() + n);
  return cuts;
}

}  // namespace

Run run_between(const acquire::KeyLine& line, std::size_t first, std::size_t last) {
  return stretch(line, first, last - first);
}

std::vector<Run> smooth_runs(const acquire::KeyLine& line, bool at_corners) {
  const std::vector<std::size_t> cuts = cuts_of(line, at_corners);
  if (cuts.empty()) {
    Run run = stretch(line, 0, line.points.size() - 1);
    run.closed = true;
    run.length = overstated(line) * core::polygon_length(run.points, true);
    return {run};
  }
  std::vector<Run> runs;
  for (std::size_t k = 0; k + 1 < cuts.size(); ++k)
    runs.push_back(run_between(line, cuts[k], cuts[k + 1]));
  return runs;
}

void pass_through(std::vector<Run>& runs, const std::vector<std::size_t>& must_pass) {
  for (Run& run : runs)
    for (std::size_t k = 0; k < run.index.size(); ++k)
      if (std::ranges::find(must_pass, run.index[k]) != must_pass.end()) run.must_pass.push_back(k);
}

namespace {

/// An outer end that is to be passed is where the curve ends: it is held there and needs no narrow
/// band of its own. Where the ends meet either holds both.
void tie_passed_ends(std::vector<Run>& runs, bool ends_meet) {
  Run& first = runs.front();
  Run& last = runs.back();
  const bool at_start = first.clamp_start == Clamp::none && std::erase(first.must_pass, 0) > 0;
  const bool at_end =
      last.clamp_end == Clamp::none && std::erase(last.must_pass, last.points.size() - 1) > 0;
  const bool both = ends_meet && (at_start || at_end);
  if (at_start || (both && first.clamp_start == Clamp::none))
    first.tie_start = first.points.front();
  if (at_end || (both && last.clamp_end == Clamp::none)) last.tie_end = last.points.back();
}

}  // namespace

std::vector<Run> runs_of(const acquire::KeyLine& line, const FairOptions& options) {
  std::vector<Run> runs = smooth_runs(line, options.keep_corners);
  pass_through(runs, options.must_pass);
  if (line.closed) return runs;
  runs.front().clamp_start = options.clamp.start;
  runs.back().clamp_end = options.clamp.end;
  tie_passed_ends(runs, line.ends_meet);
  return runs;
}

core::Result<void> bound_runs(std::vector<Run>& runs, const acquire::KeyLine& line,
                              const FairOptions& options, double tolerance) {
  const std::vector<core::HalfPlane> inside = half_planes(options.keep_inside);
  for (const core::HalfPlane& half : inside)
    for (const core::Point2 p : line.points)
      if (core::depth(half, p) < -tolerance)
        return core::fail(core::ErrorCode::bad_input,
                          fmt::format("the point ({:.6g}, {:.6g}) lies {:.3g} outside", p.x, p.y,
                                      -core::depth(half, p)),
                          "correct it, or give a wider bound", "keep_inside");
  const auto tie = [&](std::optional<core::Point2>& place, core::Point2 end) {
    for (const core::HalfPlane& half : inside)
      if (const double depth = core::depth(half, end); depth <= 0)
        place = end = end - depth * half.normal;
  };
  for (Run& run : runs) run.inside = inside;
  if (runs.front().closed || line.closed) return {};
  Run& first = runs.front();
  Run& last = runs.back();
  // Of a region the outer runs may begin or end at a corner.
  if (first.index.front() == 0 && first.clamp_start == Clamp::none)
    tie(first.tie_start, line.points.front());
  if (last.index.back() + 1 == line.points.size() && last.clamp_end == Clamp::none)
    tie(last.tie_end, line.points.back());
  return {};
}

}  // namespace keyline::fairing::detail
