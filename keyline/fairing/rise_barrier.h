#pragma once

#include <array>
#include <vector>

#include "keyline/fairing/band.h"
#include "keyline/fairing/dense_curve.h"

namespace keyline::fairing::detail {

/// Which way curvature may run (DenseCurve::sense), how fast (DenseCurve::most_rate) and on which
/// side of zero it stays (DenseCurve::side) as what they are: limits on the rise of every piece and
/// on the curvatures of its ends, met by a primal-dual interior point beside the band's. All are
/// linear in what is solved for, so a curve that keeps them strictly at the start (see
/// `keep_rises`) keeps them.
class RiseBarrier {
 public:
  /// Starts at the curve's curvatures; a limit that they do not keep strictly is left out.
  RiseBarrier(const DenseCurve& curve, double barrier);

  /// Changes of the curvatures at the ends of each piece.
  using Ends = std::vector<std::array<double, 2>>;

  /// What pulls at the curvatures of a piece's ends: pull(start, end, Pull) for each combination
  /// start * curvature there + end * curvature here.
  template <class Add>
  void each_pull(std::size_t piece, Add&& pull) const {
    if (begins_.empty()) return;
    for (std::size_t i = begins_[piece]; i < begins_[piece + 1]; ++i) {
      const Limit& limit = limits_[i];
      pull(limit.start, limit.end,
           Pull{.weight = limit.multiplier / limit.room, .slope = -barrier_ / limit.room});
    }
  }
  /// Largest share of Newton's step, one at most; changes as it means them.
  double longest(const Ends& meant) const;
  /// -barrier * sum of the logarithms of the room left, in shares of the first ones.
  double merit(const DenseCurve& curve) const;
  /// Moves on to the curve; multipliers go as far as none loses its sign.
  void move(const DenseCurve& curve, const Ends& meant);
  void set_barrier(double barrier) { barrier_ = barrier; }
  void rescale(double by);
  int count() const { return static_cast<int>(limits_.size()); }

 private:
  /// room = most + start * curvature where the piece starts + end * that where it ends > 0.
  struct Limit {
    std::size_t piece = 0;
    double start = 0;
    double end = 0;
    double most = 0;
    double first = 0;  ///< room at the start
    double room = 0;
    double multiplier = 0;
  };
  void add(const DenseCurve& curve, Limit limit);
  void add_sides(const DenseCurve& curve, std::size_t piece);
  static double room(const DenseCurve& curve, const Limit& limit);
  static double change(const Ends& meant, const Limit& limit) {
    return limit.start * meant[limit.piece][0] + limit.end * meant[limit.piece][1];
  }

  std::vector<Limit> limits_;        ///< by piece
  std::vector<std::size_t> begins_;  ///< of each piece's, and their end; empty: no limits
  double barrier_;
};

/// Curvatures moved to near ones that keep rates and senses strictly, as far as both go together:
/// means of the least and the greatest that run no faster, then of what runs against the senses,
/// tilted by a small share of the range. What is on the wrong side of zero then moves over, in its
/// order. The gaps between the cells that this leaves are the solver's to close.
void keep_rises(DenseCurve& curve);

/// Pieces that run faster than `most_rate` become clothoids, which of all that rise as far over the
/// same length have the least fastest rate.
void ease(DenseCurve& curve);

/// How many times `most_rate` the fastest change of curvature is; 0 where that is not finite.
double too_fast(const DenseCurve& curve);

}  // namespace keyline::fairing::detail
