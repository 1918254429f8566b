#pragma once

#include <optional>
#include <string>
#include <vector>

#include "keyline/core/point.h"
#include "keyline/figure/drawing.h"

namespace keyline::figure {

/// Straight line y = intercept + slope * x, fitted over from <= x <= to.
struct FittedLine {
  double from = 0;
  double to = 0;
  double slope = 0;
  double intercept = 0;
};

/// One monotone piece in the logarithmic curvature graph: points (log10 rho, log10 |rho ds/drho|).
struct LcgPiece {
  std::string name = {};
  std::vector<core::Point2> points = {};
  std::vector<core::Point2> measured = {};  ///< of the curve before, cut where they leave the range
  std::vector<FittedLine> lines = {};
  std::optional<double> variance = {};  ///< of the points about the lines
};

/// Points, fitted lines and their slopes written beside them.
Drawing lcg_chart(const LcgPiece& piece, double width = 344, double height = 300);

/// One monotone piece in the logarithmic distribution diagram of curvature: bars of height
/// log10(s_j / S_all) over log10(rho / S_all).
struct LddcPiece {
  std::string name = {};
  std::vector<core::Point2> bars = {};  ///< middle of the bin, height; empty bins left out
  double bin_width = 0.05;
  std::vector<core::Point2> c_curve = {};   ///< line over the tops of the bars
  std::vector<core::Point2> measured = {};  ///< C curve before, cut where it leaves the range
  std::vector<FittedLine> lines = {};
  std::optional<core::Point2> point_a = {};  ///< the paper's index of volume: A …
  std::optional<core::Point2> point_b = {};  ///< … and its distance to B
};

/// Bars, C curve, lines with their gradients, and the points A and B.
Drawing lddc_chart(const LddcPiece& piece, double width = 344, double height = 300);

}  // namespace keyline::figure
