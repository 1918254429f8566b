#pragma once

#include <optional>
#include <string>
#include <vector>

#include "keyline/fairing/corners.h"
#include "keyline/fairing/half_line.h"
#include "keyline/fairing/run.h"
#include "keyline/fairing/symmetric.h"

/// Runs of a symmetric key-line: solved on one side of its line of symmetry, given on both.
namespace keyline::fairing::detail {

/// What in the options stands against a symmetric answer; empty: nothing.
std::string against_symmetry(const FairOptions& options);

/// The line in which the points mirror within their noise: the mirrored points lie beside the curve
/// through the points by no more than the difference of two errors explains, and nowhere by more
/// than both sides' tolerance.
std::optional<Mirror> mirror_within_noise(const acquire::KeyLine& line, double tolerance);

/// How well the points mirror in a line.
Mirror mirror_in(const core::Pose2& line, const acquire::KeyLine& points);

/// The line in words: (X, Y) at so many degrees.
std::string told(const core::Pose2& line);

/// The runs of a key-line solved as one half and its image, within the tolerance where that can be.
/// undrawable where the key-line does not fold.
core::Result<std::vector<RunResult>> solve_symmetric(const acquire::KeyLine& line,
                                                     const core::Pose2& axis,
                                                     const std::vector<Run>& runs,
                                                     const OptionsOf& options);

/// Feet of the run's points on a chain that begins near its point `first`: of places at the middles
/// of a twenty-fourth of each piece the nearest, no farther along than 0.08 of the length from
/// where the point stands on the polygon. Of a closed run the seam lies between any two.
std::vector<Foot> feet_on(const lac::Chain& chain, const Run& run, std::size_t first);

/// Of the points' offsets.
double largest_of(const std::vector<RunResult>& solved, const std::vector<Run>& runs);

/// Of the curvature of all chains, as analysis::CombFigures counts them.
int waves_of(const std::vector<RunResult>& solved);

}  // namespace keyline::fairing::detail
