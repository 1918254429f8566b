#pragma once

#include <cstddef>

#include "keyline/lac/lanes/gauss_nodes.h"

/// Internals: quick_search on several problems at once, one a lane.
namespace keyline::lac::detail {

inline constexpr std::size_t kBatchSize = 64;

/// A block of problems and answers, column by column; alignment and length serve every lane width.
struct ChordBlock {
  // In; unused lanes hold alpha = -1, theta = 1, excess = 0.01.
  alignas(64) double alpha[kBatchSize];
  alignas(64) double theta[kBatchSize];   ///< in (0, pi)
  alignas(64) double excess[kBatchSize];  ///< chord angle less theta/2, > 0
  // Out, for an arm of unit length.
  alignas(64) double solved[kBatchSize];  ///< 1, or 0: not solved here
  alignas(64) double chord_length[kBatchSize];
  alignas(64) double heavy[kBatchSize];   ///< curvature at the heavy end
  alignas(64) double ratio[kBatchSize];   ///< e^-q, light curvature to heavy or the other way
  alignas(64) double lambda[kBatchSize];  ///< of the standard form
};

struct BatchKernel {
  template <class Arch>
  void operator()(Arch, ChordBlock* block, std::size_t count) const;
};

struct AngleKernel {
  template <class Arch>
  void operator()(Arch, const double* y, const double* x, double* angle, std::size_t count) const;
};

/// atan2 of a column of a block, and of the lanes that fill up its last batch.
void angles_of_block(const double* y, const double* x, double* angle, std::size_t count);

/// Solves the first `count` problems; dispatched to the best instruction set at hand.
void solve_block(ChordBlock& block, std::size_t count);

}  // namespace keyline::lac::detail
