#pragma once

#include "keyline/core/interval.h"
#include "keyline/fairing/calm.h"
#include "keyline/fairing/chain_search.h"
#include "keyline/fairing/members.h"
#include "keyline/fairing/residuals.h"

namespace keyline::fairing::detail {

struct CalmRunOptions {
  double tolerance = 0;  ///< of the points' offsets, in their unit
  Residuals residuals;   ///< of the same
  core::Interval slopes{-3, 3};
  std::optional<int> most_turns = {};  ///< see CalmOptions
  double most_rate = HUGE_VAL;         ///< see DenseCurve
  HeldEnd start;
  HeldEnd end;
  Members members;   ///< empty: every fitted point is a measured one
  bool arcs = true;  ///< next to free, of pieces
  int threads = 1;   ///< see CalmOptions
  core::Progress progress;
};

struct CalmRun {
  DenseCurve curve;  ///< of log-aesthetic pieces
  BandReport band;
  WavesLeft waves;         ///< in the calm curve
  double calm_energy = 0;  ///< the same without waves that the points do not ask for
};

/// The whole way of a run: the curve of least variation of curvature in the tolerance, its waves
/// calmed, its straight stretches laid as lines, its graph of curvature cut into as few
/// log-aesthetic pieces as lose little, the pieces solved for again in the tolerance, of which the
/// calm curve leaves them a tenth, or else a fifth or a third; where they cannot keep it, the mean
/// square or a twentieth more than the energy, they are cut with half the loss.
///
/// Where fitted points are means, their spread is measured again about the calm curve.
///
/// Precondition: points in order along a curve of length about 1, at least 3; guides among them.
CalmRun solve_calm(std::vector<FitPoint>& points, bool closed, const CalmRunOptions& options);

/// The same pieces once more with their ends held elsewhere.
BandReport hold_ends(DenseCurve& curve, const std::vector<FitPoint>& points, double tolerance,
                     double spring, const HeldEnd& start, const HeldEnd& end);

/// As a chain under construction, feet and holds included.
FitChain chain_of(const DenseCurve& curve);

}  // namespace keyline::fairing::detail
