#include "keyline/figure/class_a_charts.h"

#include <algorithm>
#include <cmath>

#include "keyline/core/angle.h"
#include "keyline/core/error.h"
#include "keyline/figure/frame.h"
#include "keyline/figure/model_figure.h"
#include "keyline/figure/plot.h"

namespace keyline::figure {

using core::Point2;

namespace {

constexpr int kBoundarySteps = 200;

/// s = 1/cos(alpha) (upper) or s = cos(alpha) (lower) from 0 to alpha_max.
std::vector<Point2> boundary(double alpha_max, bool upper) {
  std::vector<Point2> line;
  for (int i = 0; i <= kBoundarySteps; ++i) {
    const double alpha = alpha_max * i / kBoundarySteps;
    line.push_back({alpha, upper ? 1 / std::cos(alpha) : std::cos(alpha)});
  }
  return line;
}

/// The area between a boundary and the edge of the chart.
Path region(const std::vector<Point2>& line, double edge) {
  Path path = polyline(line);
  path.line_to({line.back().x, edge}).line_to({line.front().x, edge}).close();
  return path;
}

void add_contours(Plot& plot, const AlphaSPlane& plane) {
  if (!plane.energy) return;
  const std::vector<double> levels =
      plane.levels.empty() ? even_levels(*plane.energy, 8) : plane.levels;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const double u = levels.size() > 1 ? static_cast<double>(i) / (levels.size() - 1) : 0;
    Series series{.color = sequential(0.1 + 0.7 * u), .width = 1, .sets_range = false};
    if (i == 0 || i + 1 == levels.size()) series.name = "energy " + short_number(levels[i], 3);
    for (const auto& line : contour_lines(*plane.energy, levels[i])) {
      series.points.insert(series.points.end(), line.begin(), line.end());
      series.points.push_back({NAN, NAN});
    }
    plot.series.push_back(std::move(series));
  }
}

void add_points(Plot& plot, const AlphaSPlane& plane) {
  if (!plane.path.empty())
    plot.series.push_back(Series{
        .points = plane.path, .color = kInk, .width = 1.2, .dash = {4, 3}, .sets_range = false});
  constexpr std::size_t kMostNotes = 3;  // more names stand in the legend, unless they are short
  const bool notes = plane.points.size() <= kMostNotes ||
                     std::all_of(plane.points.begin(), plane.points.end(),
                                 [](const AlphaSPoint& p) { return p.name.size() <= 2; });
  for (std::size_t i = 0; i < plane.points.size(); ++i) {
    const AlphaSPoint& p = plane.points[i];
    plot.series.push_back(Series{.name = notes ? "" : p.name,
                                 .points = {{p.alpha, p.s}},
                                 .kind = SeriesKind::points,
                                 .color = palette(i == 0 ? 1 : i + 1),
                                 .marker = p.marker,
                                 .size = 8,
                                 .sets_range = false});
    if (notes) plot.notes.push_back({.at = {p.alpha, p.s}, .text = p.name, .offset = {8, -7}});
  }
}

}  // namespace

Drawing alpha_s_chart(const AlphaSPlane& plane) {
  if (!(plane.alpha_max > 0 && plane.alpha_max < core::kPi / 2))
    throw core::InvalidInput("alpha_s_chart: alpha_max has to lie between 0 and pi/2");
  if (!(plane.s.low > 0 && plane.s.low < plane.s.high && std::isfinite(plane.s.high)))
    throw core::InvalidInput("alpha_s_chart: the range of s is empty");
  Plot plot;
  plot.title = plane.title;
  plot.subtitle = plane.subtitle;
  plot.width = plane.width;
  plot.height = plane.height;
  plot.x = {"\u03B1 [rad]", Scale::linear, 0.0, plane.alpha_max};
  plot.y = {"s", Scale::linear, plane.s.low, plane.s.high};
  const std::vector<Point2> upper = boundary(plane.alpha_max, true);
  const std::vector<Point2> lower = boundary(plane.alpha_max, false);
  plot.regions = {region(upper, std::max(plane.s.high, upper.back().y)),
                  region(lower, std::min(plane.s.low, lower.back().y))};
  add_contours(plot, plane);
  plot.series.push_back(Series{.name = "s = 1/cos \u03B1", .points = upper, .color = palette(0)});
  plot.series.push_back(
      Series{.name = "s = cos \u03B1", .points = lower, .color = palette(0), .dash = {6, 3}});
  if (!plane.reach.empty())
    plot.series.push_back(Series{.name = "same ends and start tangent",
                                 .points = plane.reach,
                                 .color = kSoftInk,
                                 .width = 1.2,
                                 .dash = {1.5, 2.5},
                                 .sets_range = false});
  add_points(plot, plane);
  return draw(plot);
}

Drawing before_after_chart(const BeforeAfter& pair, const ChartOptions& options) {
  std::vector<Point2> all = pair.before.points;
  for (const auto& list : {pair.after.points, pair.before_control, pair.after_control})
    all.insert(all.end(), list.begin(), list.end());
  if (all.empty()) throw core::InvalidInput("before_after_chart: there is no curve");
  Box model{all.front(), all.front()};
  for (const Point2& p : all) include(model, p);
  using Sample = detail::LegendEntry;
  std::vector<Sample> legend;
  if (!pair.before.points.empty())
    legend.push_back(Sample{.name = "before", .color = kInk, .dash = {5, 3}});
  if (!pair.after.points.empty()) legend.push_back(Sample{.name = "after", .color = palette(0)});
  const std::string title = options.title.empty() ? "Before and after" : options.title;
  detail::ModelFigure figure = detail::start_figure(model, title, {}, legend, options);
  const auto add_control = [&](const std::vector<Point2>& control, const Color& color) {
    if (control.empty()) return;
    detail::add_line(figure, control, Stroke{color, 0.8, {2, 2}});
    std::vector<Point2> marks;
    for (const Point2& p : control) marks.push_back(to_page(figure.view, p));
    figure.drawing.add(Marks{marks, Marker::dot, 3, color});
  };
  add_control(pair.before_control, kSoftInk);
  add_control(pair.after_control, palette(0));
  if (!pair.before.points.empty())
    detail::add_line(figure, pair.before.points, Stroke{kInk, 1.6, {5, 3}});
  if (!pair.after.points.empty())
    detail::add_line(figure, pair.after.points, Stroke{palette(0), 1.8, {}});
  detail::add_scale_bar(figure, options.unit);
  return std::move(figure.drawing);
}

namespace {

void add_color_scale(Drawing& drawing, const ColorScale& scale, Point2 corner) {
  constexpr int kSteps = 128;
  constexpr double kWide = 220;
  Picture bar{.box = {corner, {corner.x + kWide, corner.y + 10}}, .columns = kSteps, .rows = 1};
  for (int i = 0; i < kSteps; ++i) {
    const Color c = sequential((i + 0.5) / kSteps);
    bar.rgb.insert(bar.rgb.end(), {c.red, c.green, c.blue});
  }
  bar.text = "colour scale";
  drawing.add(std::move(bar));
  const auto add = [&](double x, Anchor anchor, const std::string& text) {
    drawing.add(Label{.at = {corner.x + x, corner.y + 14},
                      .text = text,
                      .size = detail::kTextSize,
                      .color = kSoftInk,
                      .anchor = anchor,
                      .baseline = Baseline::top});
  };
  add(0, Anchor::start, short_number(scale.low, 3));
  add(kWide, Anchor::end, short_number(scale.high, 3));
  drawing.add(
      Label{.at = {corner.x + kWide + 12, corner.y + 5},
            .text = detail::shortened(scale.title, drawing.width - kWide - 60, detail::kTextSize),
            .size = detail::kTextSize,
            .baseline = Baseline::middle});
}

}  // namespace

Drawing raster_figure(const RasterFigure& figure) {
  constexpr int kMost = 8192;
  const bool sizes = figure.columns >= 1 && figure.rows >= 1 && figure.columns <= kMost &&
                     figure.rows <= kMost && figure.width >= 160 && std::isfinite(figure.width);
  if (!sizes || figure.rgb.size() != std::size_t{3} * static_cast<std::size_t>(figure.columns) *
                                         static_cast<std::size_t>(figure.rows))
    throw core::InvalidInput("raster_figure: the counts of the picture do not agree");
  Drawing drawing;
  drawing.width = figure.width;
  drawing.title = figure.title;
  drawing.description = figure.subtitle;
  const double top = detail::add_heading(drawing, figure.title, figure.subtitle, {}) + 4;
  const double wide = figure.width - 2 * detail::kPad;
  const double tall = wide * figure.rows / figure.columns;
  drawing.add(Picture{.box = {{detail::kPad, top}, {detail::kPad + wide, top + tall}},
                      .columns = figure.columns,
                      .rows = figure.rows,
                      .rgb = figure.rgb,
                      .text = figure.title});
  drawing.height = std::ceil(top + tall + detail::kPad);
  if (figure.scale) {
    add_color_scale(drawing, *figure.scale, {detail::kPad, drawing.height});
    drawing.height += 36;
  }
  return drawing;
}

}  // namespace keyline::figure
