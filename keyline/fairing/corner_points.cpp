#include "keyline/fairing/corner_points.h"

#include <algorithm>
#include <optional>

#include "keyline/acquire/going_on.h"
#include "keyline/core/polygon.h"

namespace keyline::fairing::detail {
namespace {

/// The run's points in order towards one of its ends.
std::vector<core::Point2> towards(const Run& run, bool start) {
  std::vector<core::Point2> points = run.points;
  if (start) std::ranges::reverse(points);
  return points;
}

bool must_pass(const Run& run, std::size_t point) {
  return std::ranges::find(run.must_pass, point) != run.must_pass.end();
}

/// Puts the place at an end of the run, in place of the point that is there or beyond it.
void end_at(Run& run, bool start, core::Point2 place, bool beyond) {
  const std::size_t at = start ? 0 : run.points.size() - (beyond ? 0 : 1);
  const double before = core::polygon_length(run.points, false);
  if (beyond) {
    const auto offset = static_cast<std::ptrdiff_t>(at);
    run.points.insert(run.points.begin() + offset, place);
    run.index.insert(run.index.begin() + offset, Run::none);
    if (!run.weights.empty())
      run.weights.insert(run.weights.begin() + offset,
                         start ? run.weights.front() : run.weights.back());
    for (std::size_t& point : run.must_pass) point += start ? 1 : 0;
  } else {
    run.points[at] = place;
    run.index[at] = Run::none;
  }
  run.length *= core::polygon_length(run.points, false) / before;
}

}  // namespace

void meet_between_points(std::vector<Run>& runs, double tolerance, bool round) {
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const std::size_t next = (k + 1) % runs.size();
    if (runs[k].closed || (next == 0 && !round)) continue;
    Run& before = runs[k];
    Run& after = runs[next];
    if (must_pass(before, before.points.size() - 1) || must_pass(after, 0)) continue;
    auto one = towards(before, false);
    auto other = towards(after, true);
    const auto off_one = acquire::distance_of_last(one);
    const auto off_other = acquire::distance_of_last(other);
    if (!off_one || !off_other) continue;
    const bool of_one = *off_one <= tolerance;
    if (of_one == (*off_other <= tolerance)) continue;  // both sides' point, or neither's
    (of_one ? other : one).pop_back();
    const auto place = acquire::corner_beyond(one, other);
    if (!place) continue;
    end_at(before, false, *place, of_one);
    end_at(after, true, *place, !of_one);
  }
}

}  // namespace keyline::fairing::detail
