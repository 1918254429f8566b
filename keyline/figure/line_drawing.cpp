#include "keyline/figure/line_drawing.h"

#include <algorithm>

#include "keyline/figure/model_figure.h"

namespace keyline::figure {

Drawing line_drawing(const std::vector<DrawnLine>& lines, const std::string& subtitle,
                     const ChartOptions& options) {
  Box model;
  for (const DrawnLine& line : lines)
    for (const core::Point2& p : line.points) include(model, p);
  detail::ModelFigure figure = detail::start_figure(model, "Curves", subtitle, {}, options);
  for (const DrawnLine& line : lines) {
    const double width = std::clamp(line.width * figure.view.scale, 0.8, 12.0);
    detail::add_line(figure, line.points, Stroke{line.color, line.width > 0 ? width : 1.4, {}});
  }
  detail::add_scale_bar(figure, options.unit);
  return std::move(figure.drawing);
}

}  // namespace keyline::figure
