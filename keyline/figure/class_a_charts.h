#pragma once

#include <optional>
#include <string>
#include <vector>

#include "keyline/core/interval.h"
#include "keyline/figure/contour.h"
#include "keyline/figure/curve_charts.h"
#include "keyline/figure/drawing.h"

namespace keyline::figure {

/// A curve in the plane of [Oya]: rotation angle alpha and scaling s of its control matrix.
struct AlphaSPoint {
  std::string name = {};
  double alpha = 0;
  double s = 1;
  Marker marker = Marker::dot;
};

/// The alpha-s plane: the Class A region s >= 1/cos(alpha) or s <= cos(alpha), shaded, energy
/// contours, curves as points, and the way from one point to another.
struct AlphaSPlane {
  std::string title = "\u03B1\u2013s plane";
  std::string subtitle = {};
  double alpha_max = 1.0982;      ///< radians, in (0, pi/2)
  core::Interval s = {0.4, 2.4};  ///< shown; 0 < low < high
  std::vector<AlphaSPoint> points = {};
  std::vector<core::Point2> path = {};   ///< (alpha, s): for example from given to minimum
  std::vector<core::Point2> reach = {};  ///< (alpha, s) that keep both ends and the start tangent
  std::optional<Grid> energy = {};       ///< over (alpha, s)
  std::vector<double> levels = {};       ///< of the energy; empty: eight even ones
  double width = 560;
  double height = 460;
};

/// Throws InvalidInput for an alpha_max or range of s outside the bounds above.
Drawing alpha_s_chart(const AlphaSPlane& plane);

/// A curve before and after editing, with control polygons; the lists of the curves as in
/// curve_charts.h (points alone are used), any control list may be empty.
struct BeforeAfter {
  SampledCurve before = {};
  SampledCurve after = {};
  std::vector<core::Point2> before_control = {};
  std::vector<core::Point2> after_control = {};
};

/// Both curves at one scale: before dashed and dark, after in colour. Throws InvalidInput where
/// both are empty.
Drawing before_after_chart(const BeforeAfter& pair, const ChartOptions& options = {});

/// What a colour scale beside a picture says.
struct ColorScale {
  std::string title = {};
  double low = 0;
  double high = 1;
};

/// A picture of pixels (zebra, curvature, shaded surface) with heading and, where given, a scale
/// bar in the colours of sequential().
struct RasterFigure {
  std::string title = {};
  std::string subtitle = {};
  int columns = 0;
  int rows = 0;
  std::vector<std::uint8_t> rgb = {};  ///< 3 * columns * rows bytes, top row first
  std::optional<ColorScale> scale = {};
  double width = 720;  ///< of the figure, px
};

/// Throws InvalidInput where the counts do not agree or columns or rows are not in 1 ... 8192.
Drawing raster_figure(const RasterFigure& figure);

}  // namespace keyline::figure
