#pragma once

#include <cstddef>

#include "keyline/fairing/fair.h"

/// Regions over the start of a closed key-line.
namespace keyline::fairing::detail {

/// A closed key-line that begins at another of its points, in the middle of what is kept, and the
/// same request for it: its region is within [0, 1].
struct TurnedStart {
  acquire::KeyLine line;
  FairOptions options;
  std::size_t first = 0;  ///< the point it begins at
};

/// Whether the region runs over the start. Precondition: check() passes.
bool runs_over_start(const FairOptions& options);

/// Precondition: runs_over_start(options).
TurnedStart turn_start(const acquire::KeyLine& line, const FairOptions& options);

/// What is told of points, in their order before it was turned, and a note where the answer begins.
void turn_back(FairResult& result, std::size_t first);

}  // namespace keyline::fairing::detail
