#pragma once

#include <span>
#include <vector>

#include "keyline/core/error.h"
#include "keyline/fairing/fair.h"
#include "keyline/fairing/run.h"

/// From a solved run to the pieces of the answer, and from a wish for a reading to the solver.
namespace keyline::fairing::detail {

/// What a piece of a chain is, by its own numbers: one of straight, arc, minus, zero, plus.
analysis::Rhythm rhythm_of(const lac::Piece& piece);

/// The pieces of a chain by their own numbers: rhythm, slope and volume, and what tells how they
/// read: the noise and number of their points. Those in `asked` are as somebody wants them.
std::vector<FairPiece> pieces_of(const lac::Chain& chain, double noise,
                                 const std::vector<int>& points_per_piece,
                                 const std::vector<int>& asked);

/// Adds the readings that the points of a chain's pieces would also allow; the best one is the
/// piece's, unless it was asked for. Cancelled work leaves readings out.
void read_pieces(std::span<FairPiece> pieces, const lac::Chain& chain, int threads = 0,
                 const core::Progress& progress = {});

/// The same of all pieces of an answer.
void read_pieces(FairResult& result, int threads, const core::Progress& progress);

/// Slope range and kind that a reading asks for; bad_input for "arcs", which no G2 chain can be.
core::Result<PieceWish> wish_for(const InterpretationOverride& asked, int piece_in_chain);

}  // namespace keyline::fairing::detail
