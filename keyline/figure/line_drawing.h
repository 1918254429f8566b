#pragma once

#include <string>
#include <vector>

#include "keyline/core/point.h"
#include "keyline/figure/curve_charts.h"

namespace keyline::figure {

/// A line as it is drawn: points in order, dense enough to look smooth.
struct DrawnLine {
  std::vector<core::Point2> points = {};
  double width = 0;  ///< in the model's unit; 0: a hairline
  Color color = kInk;
};

/// Lines where they lie, at one scale both ways, with a scale bar. Widths are shown true to scale,
/// but never under 0.8 px or over 12 px.
Drawing line_drawing(const std::vector<DrawnLine>& lines, const std::string& subtitle = {},
                     const ChartOptions& options = {});

}  // namespace keyline::figure
