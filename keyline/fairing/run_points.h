#pragma once

#include "keyline/fairing/run.h"
#include "keyline/fairing/run_frame.h"

/// The points of a run as they are fitted.
namespace keyline::fairing::detail {

/// Of more points means are fitted, so that the work does not grow with them.
inline constexpr std::size_t kMostFitPoints = 1200;

/// At most so many.
void take_points(RunResult& result, const Run& run, const RunFrame& frame, std::size_t most);

/// Points for the calmest curve: so few that no three of them bend by more than the tolerance, for
/// means lie inside bends by an eighth of that.
void take_calm_points(RunResult& result, const Run& run, const RunFrame& frame, double tolerance);

/// Of every measured point in the frame's order: which of the fitted ones holds it.
std::vector<std::size_t> holders(const RunResult& result, const RunFrame& frame);

/// The measured points, where fitted ones are means of several.
Members members_of(const RunResult& result, const Run& run, const RunFrame& frame);

/// Guides where ends stand on a line of symmetry, which the points do not reach.
void reach_axis(std::vector<FitPoint>& points, const HeldEnd& start, const HeldEnd& end,
                double tolerance);

}  // namespace keyline::fairing::detail
