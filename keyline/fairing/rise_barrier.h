#pragma once

#include <vector>

#include "keyline/fairing/band.h"
#include "keyline/fairing/dense_curve.h"

namespace keyline::fairing::detail {

/// Which way curvature may run (DenseCurve::sense) and how fast (DenseCurve::most_rate) as what
/// they are: limits on the rise of every piece, met by a primal-dual interior point beside the
/// band's. Rises are linear in what is solved for, so a curve that keeps them strictly at the start
/// (see `keep_rises`) keeps them.
class RiseBarrier {
 public:
  /// Starts at the curve's rises; a limit that one of them does not keep strictly is left out.
  RiseBarrier(const DenseCurve& curve, double barrier);

  /// Of a piece's rise from its start's to its end's curvature, as it runs.
  Pull pull(std::size_t piece) const;
  /// Largest share of Newton's step, one at most; rises as it means them.
  double longest(const std::vector<double>& meant) const;
  /// -barrier * sum of the logarithms of the room left, in shares of the first ones.
  double merit(const DenseCurve& curve) const;
  /// Moves on to the curve; multipliers go as far as none loses its sign.
  void move(const DenseCurve& curve, const std::vector<double>& meant);
  void set_barrier(double barrier) { barrier_ = barrier; }
  void rescale(double by);
  int count() const { return static_cast<int>(limits_.size()); }

 private:
  /// room = most + way * rise > 0.
  struct Limit {
    std::size_t piece = 0;
    double way = 1;
    double most = 0;
    double first = 0;  ///< room at the start
    double room = 0;
    double multiplier = 0;
  };
  void add(const DenseCurve& curve, std::size_t piece, double way, double most);
  static double room(const DenseCurve& curve, const Limit& limit);

  std::vector<Limit> limits_;        ///< by piece
  std::vector<std::size_t> begins_;  ///< of each piece's, and their end; empty: no limits
  double barrier_;
};

/// Curvatures moved to near ones that keep rates and senses strictly, as far as both go together:
/// means of the least and the greatest that run no faster, then of what runs against the senses,
/// tilted by a small share of the range. The gaps between the cells that this leaves are the
/// solver's to close.
void keep_rises(DenseCurve& curve);

/// Pieces that run faster than `most_rate` become clothoids, which of all that rise as far over the
/// same length have the least fastest rate.
void ease(DenseCurve& curve);

/// How many times `most_rate` the fastest change of curvature is; 0 where that is not finite.
double too_fast(const DenseCurve& curve);

}  // namespace keyline::fairing::detail
