#pragma once

#include <string>
#include <vector>

#include "keyline/figure/curve_charts.h"
#include "keyline/figure/frame.h"

namespace keyline::figure::detail {

/// A figure of shapes in model coordinates at one scale both ways, with heading and scale bar.
struct ModelFigure {
  Drawing drawing;
  Viewport view;
  Box page;  ///< the part of the drawing that shows the model
};

/// Height follows from the model's shape; `model` is what has to be seen.
ModelFigure start_figure(const Box& model, const std::string& title, const std::string& subtitle,
                         const std::vector<LegendEntry>& legend, const ChartOptions& options);

/// A bar of round length with its label at the bottom of the figure; the last thing added.
void add_scale_bar(ModelFigure& figure, const std::string& unit);

/// A line through model points, simplified and cut at the figure's border.
void add_line(ModelFigure& figure, const std::vector<core::Point2>& points, const Stroke& stroke);

/// The curve's line and its joints.
void add_curve(ModelFigure& figure, const SampledCurve& curve, const Stroke& stroke);

/// What stands at the piece of that index: its name, or its number from 1.
std::string piece_name(const SampledCurve& curve, std::size_t index);

/// The name of each piece on the inner side of the curve, left out where it would crowd; none
/// for a curve of one piece.
void add_piece_numbers(ModelFigure& figure, const SampledCurve& curve);

/// InvalidInput unless the lists of the curve are equally long and the joints exist.
void check(const SampledCurve& curve);

/// "12.3 mm", or "12.3" without a unit.
std::string with_unit(double value, const std::string& unit);

}  // namespace keyline::figure::detail
