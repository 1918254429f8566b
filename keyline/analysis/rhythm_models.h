#pragma once

#include <vector>

#include "keyline/analysis/piece_frame.h"

namespace keyline::analysis::detail {

/// The curves fitted to a piece, all in its frame (length 1, radius growing).
///
/// One and two lines share one form around an anchor b: with x = s - b,
///   kappa = km (1 - alpha lambda x)^(-1/alpha),   alpha = alpha0 before b, alpha1 after it,
/// so that curvature and its rate (km lambda) agree at b: the power mean (docs/readings.md) with
/// a G3 joint. One line is alpha0 = alpha1.
struct LineModel {
  double curvature = 1;  ///< km
  double rate = 0;       ///< lambda, relative to km
  double anchor = 0.5;   ///< b in (0, 1)
  double slope0 = 0;
  double slope1 = 0;
};

/// lambda brought back to where the whole piece exists (no cusp, no inflection inside).
double drawable_rate(const LineModel& m);
/// Curvature at s; the model's rate must be drawable.
double curvature_at(const LineModel& m, double s);
/// Turning of every one of so many cells.
Eigen::VectorXd turning_of(const LineModel& m, int cells);

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

/// Least-squares fit of one line, slope within [low, high] (low == high: given).
LineFit fit_one_line(const PieceFrame& frame, double low, double high);

/// Least-squares fit of two lines with slopes within the bounds, starting from one line.
LineFit fit_two_lines(const PieceFrame& frame, const SlopeBounds& bounds, const LineModel& start);

struct ArcsFit {
  std::vector<double> curvatures;
  std::vector<double> breaks;  ///< in (0, 1), growing
  double deviation = 0;
};

/// Least-squares fit of n circular arcs joined with common tangents (n = 1: a single arc).
ArcsFit fit_arcs(const PieceFrame& frame, int n);

}  // namespace keyline::analysis::detail
