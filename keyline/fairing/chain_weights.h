#pragma once

#include <vector>

#include "keyline/fairing/chain_fit.h"
#include "keyline/numeric/lawson.h"

namespace keyline::fairing {

/// Lawson's weights: points far off count more, until the largest offset is near its least.
/// original: the points as they were before the first round; those that must be passed keep theirs.
void weigh_up(std::vector<FitPoint>& points, const std::vector<FitPoint>& original,
              const std::vector<double>& offsets, double tolerance, numeric::Push push);

}  // namespace keyline::fairing
