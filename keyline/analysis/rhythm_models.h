#pragma once

#include "keyline/analysis/line_turnings.h"
#include "keyline/analysis/piece_frame.h"

namespace keyline::analysis::detail {

struct SlopeBounds {
  double low0, high0, low1, high1;
};

/// A fitted model, the root mean square distance it leaves, and how uncertain its slopes are:
/// standard deviations for one observation of standard deviation 1 (infinite where undetermined).
struct LineFit {
  LineModel model;
  double deviation = 0;
  double slope_error0 = 0;
  double slope_error1 = 0;
};

/// Least-squares fit of one line, slope within [low, high] (low == high: given). `seen`: a
/// deviation so small that a smaller one would say no more; no other start is tried then.
LineFit fit_one_line(const PieceFrame& frame, double low, double high, double seen);

/// Least-squares fit of two lines with slopes within the bounds.
LineFit fit_two_lines(const PieceFrame& frame, const SlopeBounds& bounds, double seen);

}  // namespace keyline::analysis::detail
