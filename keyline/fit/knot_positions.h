#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "keyline/fit/least_squares_spline.h"

namespace keyline::fit::detail {

/// A distinct knot and how often it is repeated.
struct KnotGroup {
  double at = 0;
  std::size_t multiplicity = 1;
};

std::vector<KnotGroup> grouped(const std::vector<double>& knots);
std::vector<double> flattened(const std::vector<KnotGroup>& groups);

/// Moves the groups [first, last) to a local minimum of the sum of squares, multiplicities and
/// order kept: Levenberg-Marquardt on the residuals, the coefficients eliminated (variable
/// projection), derivatives by differences, one solver for each thread. Never worse than before.
std::vector<KnotGroup> optimise_positions(std::span<SplineSolver> solvers,
                                          std::vector<KnotGroup> groups, std::size_t first,
                                          std::size_t last, int iterations);

}  // namespace keyline::fit::detail
