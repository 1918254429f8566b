#pragma once

#include <string>
#include <vector>

#include "keyline/fairing/corners.h"
#include "keyline/fairing/fair.h"
#include "keyline/fairing/run.h"
#include "keyline/lac/segment/segment.h"

/// Joints of the answer by the rate at which curvature changes there.
namespace keyline::fairing::detail {

/// Where G3 joints are asked for: makes joints of solved runs such through which curvature runs one
/// way, as far as the points and the borders allow, and notes how far that went.
void make_rates_one(FairResult& result, std::vector<RunResult>& solved,
                    const std::vector<Run>& runs, const OptionsOf& options);

/// What holds answers that touch no limit from being calmer.
std::string held_from_within(const std::vector<RunResult>& solved);

/// Adds a chain's joints.
void count_rates(JointRates& count, const std::vector<lac::Segment>& segments, bool closed);

}  // namespace keyline::fairing::detail
