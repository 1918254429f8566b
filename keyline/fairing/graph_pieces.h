#pragma once

#include <vector>

#include "keyline/core/interval.h"
#include "keyline/fairing/dense_curve.h"

/// Log-aesthetic pieces read off a curve's graph of curvature.
namespace keyline::fairing::detail {

/// The graph of curvature cut into pieces of least excess, by dynamic programming over places that
/// follow the bending of the graph.
///
/// To first order the excess is what the variation rises by when the pieces stand in for a curve
/// of least variation, for there its own first derivative vanishes.
class GraphPieces {
 public:
  /// curve: free, of least variation. turns: nodes where curvature turns (see extrema_of), none
  /// inside a piece.
  GraphPieces(const DenseCurve& curve, const std::vector<int>& turns, core::Interval slopes);

  /// Numbers of pieces for every run: as few as keep the excess within this.
  std::vector<int> within(double excess) const;
  /// So many pieces in all, or as many as there are runs if that is more.
  std::vector<int> of_count(int pieces) const;
  /// One piece more in every run that holds one of these places (shares of the length); false where
  /// none of them can have more.
  bool refine(std::vector<int>& count, const std::vector<double>& at) const;

  DenseCurve cut_by(const std::vector<int>& count) const;

 private:
  /// A piece between two places: its slope and excess.
  struct Fit {
    double alpha = -1;
    double excess = 0;
  };
  /// A run's places and, for each number of pieces, the least excess and where it is cut.
  struct Run {
    std::vector<int> place;
    std::vector<std::vector<Fit>> fit;  ///< by first and last place
    std::vector<double> excess;         ///< by the number of pieces less one
    std::vector<std::vector<int>> from;
  };
  void tabulate(Run& run) const;
  /// Slopes that a piece between two places may have: fewer where an inflection is near.
  core::Interval slopes_of(int from, int to) const;
  Fit best_fit(int from, int to) const;
  double excess_of(int from, int to, double alpha) const;
  Run make_run(int from, int to) const;
  bool add_piece(std::vector<int>& count) const;
  double total(const std::vector<int>& count) const;

  DenseCurve curve_;  ///< begun at a turn where it is closed
  core::Interval slopes_;
  std::vector<Run> runs_;
};

}  // namespace keyline::fairing::detail
