#pragma once

#include <map>
#include <vector>

#include "keyline/sketch/stroke_grid.h"

namespace keyline::sketch {

/// What makes two strokes passes of one line.
struct PassModel {
  double width = 1;     ///< of the pen, in the strokes' unit
  double apart = 4;     ///< widths that two passes of one line lie apart at most, and …
  double hand = 0.09;   ///< … the share of their length that the hand errs on top
  double angle = 0.45;  ///< radians between them
};

/// By stroke, the strokes that something speaks for or against, and how strongly. Symmetric.
using PassEvidence = std::vector<std::map<std::size_t, double>>;

/// How far apart passes of a line of that length may lie: what the pen allows and what the hand
/// adds, which errs in proportion to the way it goes ([Schmidt 1979]), as independent errors.
double pass_distance(const PassModel& model, double length);

/// How far apart passes lie in a drawing (hand_seen.h).
struct PassReach {
  PassModel seen;                 ///< as far as the drawing shows how loose the hand is
  PassModel at_most;              ///< of any hand
  std::vector<double> of_stroke;  ///< how far from it passes lie: short where others are close
};

/// Evidence that strokes are passes of one line, summed along where they run beside each other, in
/// lengths of the distance allowed, which is `seen`'s for the shorter one or the larger of_stroke
/// if that is less: 1 on top of each other, 0 at that distance or angle, negative beyond (with the
/// cosine of the angle: crossing lines say nothing), half of that where another stroke lies in
/// between, nothing where they do not lie beside each other, nor for them along a stretch that they
/// leave in two directions, none of them ending. An end that goes on where another ends
/// speaks for both, as far as `kGap` widths. Strokes are compared as far as `at_most` may matter:
/// lines that touch are kept apart by all of their way.
PassEvidence pass_evidence(const std::vector<SampledStroke>& strokes, const PassReach& reach);

/// Strokes put together, most evidence first, as long as what speaks for two groups being one
/// outweighs what speaks against (greedy additive contraction, [Keuper 2015]). Groups and
/// their strokes in the order of the strokes.
std::vector<std::vector<std::size_t>> group_by_evidence(const PassEvidence& evidence);

}  // namespace keyline::sketch
