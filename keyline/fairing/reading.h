#pragma once

#include "keyline/core/error.h"
#include "keyline/fairing/fair.h"
#include "keyline/fairing/run.h"

/// From a solved run to the pieces of the answer, and from a wish for a reading to the solver.
namespace keyline::fairing::detail {

/// What a piece of a chain is, by its own numbers: one of straight, arc, minus, zero, plus.
analysis::Rhythm rhythm_of(const lac::Piece& piece);

/// The pieces of a chain as they read: own rhythm and slope, volume, and the readings that the
/// points would also allow, given their noise and number. Cancelled work leaves the readings out.
std::vector<FairPiece> read_pieces(const lac::Chain& chain, double noise,
                                   const std::vector<int>& points_per_piece,
                                   const RunOptions& options);

/// Slope range and kind that a reading asks for; bad_input for "arcs", which no G2 chain can be.
core::Result<PieceWish> wish_for(const InterpretationOverride& asked, int piece_in_chain);

}  // namespace keyline::fairing::detail
