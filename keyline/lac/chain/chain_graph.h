#pragma once

#include "keyline/curve/curvature_graph.h"
#include "keyline/lac/chain/chain.h"

namespace keyline::lac {

/// Curvature along the chain, `per_piece` >= 1 steps on every piece, denser towards both its ends,
/// where the rates of steep slopes grow. Joints are there twice, once with each side's curvature.
curve::CurvatureGraph curvature_graph(const Chain& chain, int per_piece = 400);

/// Fastest that curvature changes along the chain, |dkappa/ds|: of every piece at one of its ends.
/// HUGE_VAL where a piece of slope below -1 meets an inflection.
double fastest_rate(const Chain& chain);

}  // namespace keyline::lac
