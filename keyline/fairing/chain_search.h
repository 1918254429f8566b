#pragma once

#include <vector>

#include "keyline/core/progress.h"
#include "keyline/fairing/chain_fit.h"

namespace keyline::fairing {

/// When a chain is good enough. Lengths are fractions of the chain's.
struct Acceptance {
  double tolerance = 5e-4;  ///< no point farther off
  /// Standard deviation of a point's position. Where it is not small beside the tolerance, means
  /// of neighbouring offsets must also look like noise: no trend larger than it is let pass.
  double noise = 0;
};

/// True where the noise is what limits: trends in the offsets are looked for.
bool noisy(const Acceptance& accept);

/// An end of an open chain and as much of it as is held.
struct HeldEnd {
  Hold hold = Hold::free;
  FitJoint joint;
  bool slides = false;  ///< its x is free: the end stands on a line along the x axis
};

struct ChainSearchOptions {
  Acceptance accept;
  int start_pieces = 48;
  int most_pieces = 400;
  int wanted_pieces = 0;     ///< 0: as few as the tolerance allows; else this many
  bool spline_start = true;  ///< where no dense chain is accepted, start from spline_chain()
  HeldEnd start;
  HeldEnd end;
  int threads = 0;
  core::Progress progress;
};

struct ChainSearchResult {
  FitChain chain;
  ChainFitReport fit;
  std::vector<double> weights;  ///< of the points in the last fit
  bool within_tolerance = false;
  bool cancelled = false;
  int start_pieces = 0;
  int trials = 0;
};

/// A chain of `pieces` equal clothoid pieces along the points, joints' poses and curvatures from
/// local parabolas. Precondition: points in order, at least 3, total length about 1.
FitChain dense_chain(const std::vector<FitPoint>& points, bool closed, int pieces);

/// The clothoid spline through the measured points, a piece for each span. Empty where there is
/// none that is calm. Precondition: points in order, at least 3.
FitChain spline_chain(const std::vector<FitPoint>& points, bool closed);

/// Fewest pieces found that `accept` takes: a dense chain, doubled until it is accepted (where none
/// is, and the noise is not what limits, the spline through all points), then
/// neighbours merged, cheapest first, while it stays so; at last each joint once more with the
/// largest offsets weighted up. Always returns the best chain known, with what it reaches.
/// Precondition: points in order along a curve of length about 1, at least 3.
ChainSearchResult search_chain(const std::vector<FitPoint>& points, bool closed,
                               const ChainSearchOptions& options);

/// True where the offsets of the points pass; `fit` tells of the largest.
bool accepts(const Acceptance& accept, const ChainFitReport& fit,
             const std::vector<FitPoint>& points, const std::vector<double>& offsets);

}  // namespace keyline::fairing
