#pragma once

#include <cmath>

#include "keyline/fairing/calm_run.h"
#include "keyline/fairing/turns.h"

namespace keyline::fairing::detail {

/// The pieces chosen among those that were solved for. Of good ones the first that shows fewest
/// waves; before any is good the one that exceeds least what it should keep, within the tolerance
/// or, where none is, nearest to it.
class PieceChoice {
 public:
  /// waves: that the calm curve shows.
  PieceChoice(CalmRun& run, int waves) : run_(run), waves_(waves) {}

  /// excess: the largest share of what a trial within the tolerance should keep; good are those up
  /// to 1.
  void offer(const DenseCurve& trial, const BandReport& found, double excess) {
    const bool good = found.within && excess <= 1;
    const bool nearer = found.within ? !run_.band.within || excess < excess_
                                     : !run_.band.within && found.max_offset < run_.band.max_offset;
    const int seen = good ? seen_waves(trial) : 0;
    if (first_ || (good_ ? good && seen < seen_ : good || nearer)) {
      run_.curve = trial;
      run_.band = found;
      seen_ = seen;
      excess_ = excess;
    }
    first_ = false;
    good_ = good_ || good;
  }

  /// Nothing better is to be had: more pieces need not be tried.
  bool done() const { return good_ && seen_ <= waves_; }

 private:
  CalmRun& run_;
  int waves_;
  int seen_ = 0;
  double excess_ = HUGE_VAL;
  bool good_ = false;
  bool first_ = true;
};

}  // namespace keyline::fairing::detail
