#pragma once

#include <optional>
#include <span>
#include <vector>

#include "keyline/lac/segment/segment.h"

/// Internals of raise_joints: a run of pieces whose inner joints are all to be G3.
namespace keyline::lac::detail {

/// How pieces are cut to start from: joint j of p parts at (j / p)^skew of the length.
struct Cut {
  int parts = 3;  ///< one more where curvature is 0 at a joint of the run
  double skew = 1;
};

/// What takes the place of a piece.
using Parts = std::vector<Piece>;

/// For each piece of the run its parts: the same ends, directions and end curvatures, with one rate
/// of curvature on both sides of every joint, old or new. Empty where none was found. The run's
/// curvatures rise all along it or fall, and agree at its joints.
///
/// Two parts would not do: of two curves with the same ends whose curvatures rise, the graphs of
/// the rates cross at least three times, a line and a line broken once at most twice.
std::optional<std::vector<Parts>> solve_rate_run(std::span<const Piece> run, const Cut& cut);

/// The same without new pieces: the ends of the run stay as above, its joints move, and slopes,
/// lengths and curvatures at the joints change as little as can be. At least two pieces.
std::optional<Parts> solve_free_run(std::span<const Piece> run);

}  // namespace keyline::lac::detail
