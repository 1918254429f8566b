#pragma once

#include <vector>

#include "keyline/fairing/run.h"

/// Corners that lie between two points.
namespace keyline::fairing::detail {

/// A corner's point may lie on the curve of one side alone, which goes on to a corner behind it:
/// the other side, which passes it by more than the tolerance, would have to bend to it like a
/// hook. There both runs end where their curves meet (acquire::corner_beyond), a place that is no
/// measured point (Run::none), and the point is the first side's. Not where it must be passed.
/// `round`: the last run and the first share a point.
void meet_between_points(std::vector<Run>& runs, double tolerance, bool round);

}  // namespace keyline::fairing::detail
