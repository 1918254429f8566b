#pragma once

#include <cstddef>
#include <vector>

#include "keyline/core/error.h"
#include "keyline/curve/piecewise_bezier.h"
#include "keyline/fit/curvature_drive.h"

/// Internals of curvature_drive.cpp: targets, each at its place in a piece.
namespace keyline::fit::detail {

struct LocalTarget {
  std::size_t piece = 0;
  double u = 0;
  double curvature = 0;
};

/// Targets over the whole chain, t in order, given to the pieces they lie in. A piece with few gets
/// more, interpolated.
core::Result<std::vector<LocalTarget>> local_targets(std::vector<CurvatureTarget> targets,
                                                     std::size_t pieces);

/// The pieces split where their curvature changes sign, how often added to `splits`; targets
/// follow their place. No part is split off that is too short to keep its curvature.
curve::PiecewiseBezier split_pieces(const curve::PiecewiseBezier& chain,
                                    std::vector<LocalTarget>& targets, int& splits);

/// Targets with t over the whole chain.
std::vector<CurvatureTarget> over_all(const std::vector<LocalTarget>& targets, std::size_t pieces);

}  // namespace keyline::fit::detail
