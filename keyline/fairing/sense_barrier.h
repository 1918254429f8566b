#pragma once

#include "keyline/fairing/band.h"
#include "keyline/fairing/dense_curve.h"

namespace keyline::fairing::detail {

/// Which way curvature may run (see DenseCurve::sense) as what it is: a limit on the rise of every
/// piece, met by a primal-dual interior point beside the band's. Rises are linear in what is solved
/// for, so a curve that keeps them strictly at the start (see `keep_senses`) keeps them.
class SenseBarrier {
 public:
  /// Starts at the curve's rises, which are strictly of their senses.
  SenseBarrier(const DenseCurve& curve, double barrier);

  /// Of a piece's rise from its start's to its end's curvature, as it runs.
  Pull pull(std::size_t piece) const;
  /// Largest share of Newton's step, one at most; rises as it means them.
  double longest(const std::vector<double>& meant) const;
  /// -barrier * sum of the rises' logarithms, in shares of the first ones.
  double merit(const DenseCurve& curve) const;
  /// Moves on to the curve; multipliers go as far as none loses its sign.
  void move(const DenseCurve& curve, const std::vector<double>& meant);
  void set_barrier(double barrier) { barrier_ = barrier; }
  void rescale(double by);
  int count() const { return count_; }

 private:
  double rise(const DenseCurve& curve, std::size_t piece) const;

  std::vector<signed char> sense_;  ///< 0 where nothing is asked for
  std::vector<double> first_;       ///< rises at the start
  std::vector<double> rise_;        ///< along the sense
  std::vector<double> multiplier_;
  double barrier_;
  int count_ = 0;
};

/// Curvatures moved to the nearest ones that keep the senses strictly: means of what runs against
/// them, tilted by a small share of the range. The gaps between the cells that this leaves are the
/// solver's to close.
void keep_senses(DenseCurve& curve);

}  // namespace keyline::fairing::detail
