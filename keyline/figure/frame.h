#pragma once

#include <string>
#include <vector>

#include "keyline/figure/drawing.h"

namespace keyline::figure::detail {

/// The parts all figures share: title, legend, sizes of letters.

inline constexpr double kTitleSize = 14;
inline constexpr double kTextSize = 11.5;
inline constexpr double kPad = 10;

/// What stands before a legend entry.
struct LegendEntry {
  enum class Sample { line, marker, bar };
  std::string name = {};
  Sample sample = Sample::line;
  Color color = kInk;
  double width = 1.6;
  std::vector<double> dash = {};
  Marker marker = Marker::dot;
  double size = 5;
};

/// Puts title, subtitle and legend at the top of the drawing; returns the y below them.
double add_heading(Drawing& drawing, const std::string& title, const std::string& subtitle,
                   const std::vector<LegendEntry>& legend);

/// Text cut with "…" so that it fits the width.
std::string shortened(const std::string& text, double width, double size, bool bold = false);

}  // namespace keyline::figure::detail
