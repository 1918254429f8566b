#pragma once

#include <span>
#include <vector>

#include "keyline/lac/chain/chain.h"

namespace keyline::lac {

/// A chain made ready to be asked at many places: a few nanoseconds beside the curve's own
/// functions for each. Places are signed arc lengths from the start, in any order, clamped to
/// [0, length()]; a joint belongs to the piece after it. The spans of a call have one size.
class ChainSampler {
 public:
  /// Precondition: validate(chain) holds.
  explicit ChainSampler(const Chain& chain);

  double length() const { return ends_.back(); }
  void curvatures(std::span<const double> at, std::span<double> values) const;
  void curvature_rates(std::span<const double> at, std::span<double> values) const;
  /// Tangent angles, continuous along the chain from start.direction.
  void tangent_angles(std::span<const double> at, std::span<double> values) const;
  void points(std::span<const double> at, std::span<core::Point2> values) const;

 private:
  /// Calls run(piece, from, to) for stretches of `at` that fall into one piece.
  template <class Run>
  void for_runs(std::span<const double> at, const Run& run) const;
  std::size_t piece_at(double s) const;
  double fraction(std::size_t piece, double s) const;

  std::vector<Segment> pieces_;
  std::vector<double> ends_;  ///< arc length at the end of each piece
};

}  // namespace keyline::lac
