#pragma once

#include <vector>

#include "keyline/fairing/chain_search.h"

namespace keyline::fairing::detail {

inline constexpr std::size_t kMostExactPieces = 8;  ///< longer chains are not drawn exactly
/// Points that tell a piece: two more than it has freedoms beside its ends'.
inline constexpr std::size_t kStretchPoints = 8;
/// Fewest points that tell a single piece: one more than the five numbers that place it across
/// them. A sixth that it meets too is an accident once in 500, for their errors are no less than
/// 1e-4 of the length as far as is known.
inline constexpr std::size_t kPiecePoints = 6;
/// Points of a chain whose shortest piece is a fiftieth of it: as many on that as a stretch has.
inline constexpr std::size_t kTellingPoints = 50 * kStretchPoints;

/// Largest distance, part of the length, of a point that counts as reproduced to rounding: 2e-7, or
/// six times the noise.
double exactness(const Acceptance& accept);

/// Of points that are dense enough to be taken for a curve as many as tell whether a chain of few
/// pieces draws them: the ends, those that must be passed, and an even choice of the others.
std::vector<std::size_t> telling_points(const std::vector<FitPoint>& points);

/// Whether the chain found for points `taken` comes to reproduce all of them; it is theirs then.
bool follows_all(ChainSearchResult& found, const std::vector<std::size_t>& taken,
                 const std::vector<FitPoint>& points, double exact);

/// Exact data deserve the chain that reproduces them, where it is about as short as the one the
/// tolerance asks for: that one itself once converged, one for a tighter tolerance, or the shortest
/// found that reproduces the points. `best` comes from a search with these options; true where it
/// was replaced by a chain that reproduces the points.
bool find_exact(ChainSearchResult& best, const std::vector<FitPoint>& points, bool closed,
                ChainSearchOptions search);

}  // namespace keyline::fairing::detail
