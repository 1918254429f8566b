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
/// of least variation, for there its own first derivative vanishes; where the tolerance holds the
/// curve it does not, and what the variation rises by as the pieces stand counts too.
class GraphPieces {
 public:
  /// curve: of least variation, free but for its lines, which stay. turns: nodes where curvature
  /// turns (see extrema_of), none inside a piece. energy and tolerance: what the loss of a piece is
  /// counted in, of variation and sideways.
  GraphPieces(const DenseCurve& curve, const std::vector<int>& turns, core::Interval slopes,
              double energy, double tolerance);

  /// Numbers of pieces for every run: as few as keep the loss within this, and about so many at
  /// most. Runs cut at most of their places get more.
  std::vector<int> within(double loss, int most);

  DenseCurve cut_by(const std::vector<int>& count) const;

 private:
  /// A piece between two places: its slope and excess.
  struct Fit {
    double alpha = -1;
    double loss = 0;
  };
  /// A run's places and, for each number of pieces, the least excess and where it is cut.
  struct Run {
    std::vector<int> place;
    std::vector<std::vector<Fit>> fit;  ///< by first and last place
    std::vector<double> loss;           ///< by the number of pieces less one
    std::vector<std::vector<int>> from;
    int places = 0;  ///< that were asked for, besides its ends
    bool line = false;
  };
  void add_run(int from, int to, bool line);
  void tabulate(Run& run) const;
  /// Slopes that a piece between two places may have: fewer where an inflection is near.
  core::Interval slopes_of(int from, int to) const;
  Fit best_fit(int from, int to) const;
  Run make_run(int from, int to, int places) const;
  bool refine(const std::vector<int>& count);
  bool add_piece(std::vector<int>& count) const;
  double total(const std::vector<int>& count) const;

  DenseCurve curve_;  ///< begun at a turn where it is closed
  core::Interval slopes_;
  double energy_;
  double tolerance_;  ///< of the length
  std::vector<Run> runs_;
};

}  // namespace keyline::fairing::detail
