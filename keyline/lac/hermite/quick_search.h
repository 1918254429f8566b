#pragma once

#include <optional>

#include "keyline/lac/hermite/chord_kernel.h"

/// Internals: the common case of the chord search, on one Gauss panel.
namespace keyline::lac::detail {

/// First guess of q for a chord angle `excess` above theta/2, a few per cent off at most where the
/// excess is not close to its limit, and there -psi''/psi' by q; slope is psi' at the circle.
struct RangeGuess {
  double range = 0;
  double bend = 0;
};
RangeGuess guess_range(const Decays& d, double theta, double excess, double slope);

/// As solve_chord_angle by unguarded Newton steps, as long as one panel of at most 32 nodes carries
/// the integral to rounding and the steps stay short of the limit. False: not solved, `solution`
/// holds in `range` where to start the guarded search.
bool quick_search(double alpha, double theta, double excess, ChordSolution& solution);

/// A curve of unit length, its radius of curvature growing.
struct UnitCurve {
  double chord_length = 1;
  double sharp = 0;  ///< curvature at the end of smaller radius
  double flat = 0;
  double lambda = 0;  ///< of the standard form
  int iterations = 1;
};
/// The clothoid turning by theta whose chord lies `excess` beyond theta/2, in one step. Empty where
/// theta is close to pi or more, or the flat end close to an inflection or beyond.
std::optional<UnitCurve> quick_clothoid(double theta, double excess);

}  // namespace keyline::lac::detail
