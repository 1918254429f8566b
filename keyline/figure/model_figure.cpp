#include "keyline/figure/model_figure.h"

#include <algorithm>
#include <cmath>

#include "keyline/core/angle.h"
#include "keyline/core/error.h"
#include "keyline/figure/ticks.h"

namespace keyline::figure::detail {

using core::Point2;

namespace {

constexpr double kScaleBarRoom = 26;
constexpr double kSidePad = 22;

}  // namespace

void check(const SampledCurve& curve) {
  const std::size_t n = curve.points.size();
  if (curve.arc_length.size() != n || curve.tangent_angle.size() != n ||
      curve.curvature.size() != n)
    throw core::InvalidInput("figure: the lists of a sampled curve differ in length");
  for (const std::size_t joint : curve.joints)
    if (joint >= n) throw core::InvalidInput("figure: a joint is no sample of the curve");
}

std::string with_unit(double value, const std::string& unit) {
  return short_number(value, 3) + (unit.empty() ? "" : "\u00A0" + unit);
}

ModelFigure start_figure(const Box& model, const std::string& title, const std::string& subtitle,
                         const std::vector<LegendEntry>& legend, const ChartOptions& options) {
  if (!(options.width >= 160 && options.largest_height >= 120))
    throw core::InvalidInput("figure: needs at least 160 x 120 px");
  ModelFigure figure;
  Drawing& drawing = figure.drawing;
  drawing.width = options.width;
  drawing.title = options.title.empty() ? title : options.title;
  drawing.description = subtitle;
  const double top = add_heading(drawing, drawing.title, subtitle, legend) + 6;
  const double across = drawing.width - 2 * kSidePad;
  const double flatness = is_empty(model) ? 0.2 : height(model) / width(model);
  const double most = std::max(60.0, options.largest_height - top - kScaleBarRoom);
  const double tall = std::isfinite(flatness) ? across * flatness : most;
  const double inner = std::clamp(tall, 60.0, most);
  figure.page = {{kSidePad, top}, {drawing.width - kSidePad, top + inner}};
  figure.view = fit_viewport(model, figure.page);
  drawing.height = std::ceil(top + inner + kScaleBarRoom);
  return figure;
}

void add_scale_bar(ModelFigure& figure, const std::string& unit) {
  const double longest = 0.22 * figure.drawing.width / figure.view.scale;
  if (!(longest > 0) || !std::isfinite(longest)) return;
  const double bar = round_number_below(longest);
  const double wide = bar * figure.view.scale;
  const double x = kPad;
  const double y = figure.drawing.height - 10;
  Path path;
  path.move_to({x, y - 4}).line_to({x, y}).line_to({x + wide, y}).line_to({x + wide, y - 4});
  figure.drawing.add(Shape{path, Stroke{kSoftInk, 1.2, {}}, std::nullopt});
  figure.drawing.add(Label{
      .at = {x + wide + 7, y}, .text = with_unit(bar, unit), .size = 10.5, .color = kSoftInk});
}

void add_line(ModelFigure& figure, const std::vector<Point2>& points, const Stroke& stroke) {
  const Box room{{0, figure.page.min.y - 4}, {figure.drawing.width, figure.page.max.y + 4}};
  Path path;
  for (const auto& run : clip_to_box(to_page(figure.view, points), room)) {
    const Path part = polyline(simplify(run, 0.04));
    path.steps.insert(path.steps.end(), part.steps.begin(), part.steps.end());
  }
  figure.drawing.add(Shape{path, stroke, std::nullopt});
}

namespace {

/// Where pieces start and end: the ends of the curve and its joints.
std::vector<std::size_t> borders_of(const SampledCurve& curve) {
  std::vector<std::size_t> borders = curve.joints;
  borders.push_back(0);
  borders.push_back(curve.points.size() - 1);
  std::sort(borders.begin(), borders.end());
  borders.erase(std::unique(borders.begin(), borders.end()), borders.end());
  return borders;
}

}  // namespace

std::string piece_name(const SampledCurve& curve, std::size_t index) {
  return index < curve.piece_names.size() ? curve.piece_names[index] : std::to_string(index + 1);
}

void add_piece_numbers(ModelFigure& figure, const SampledCurve& curve) {
  if (curve.joints.empty()) return;
  const std::vector<std::size_t> borders = borders_of(curve);
  std::vector<Point2> placed;
  for (std::size_t i = 1; i < borders.size(); ++i) {
    const std::size_t middle = (borders[i - 1] + borders[i]) / 2;
    const double side = curve.curvature[middle] < 0 ? 1 : -1;
    const core::Vector2 normal = perpendicular_left(core::unit_vector(curve.tangent_angle[middle]));
    const Point2 foot = to_page(figure.view, curve.points[middle]);
    const Point2 at{foot.x - side * 12 * normal.x, foot.y + side * 12 * normal.y};
    const bool crowded = std::any_of(placed.begin(), placed.end(),
                                     [at](Point2 other) { return core::distance(at, other) < 15; });
    if (crowded || !core::is_finite(at)) continue;
    placed.push_back(at);
    figure.drawing.add(Label{.at = at,
                             .text = piece_name(curve, i - 1),
                             .size = 10.5,
                             .color = kSoftInk,
                             .anchor = Anchor::middle,
                             .baseline = Baseline::middle,
                             .halo = 2});
  }
}

void add_curve(ModelFigure& figure, const SampledCurve& curve, const Stroke& stroke) {
  add_line(figure, curve.points, stroke);
  if (curve.joints.empty()) return;
  Marks joints{.marker = Marker::circle, .size = 5, .color = stroke.color};
  for (const std::size_t joint : curve.joints)
    joints.points.push_back(to_page(figure.view, curve.points[joint]));
  figure.drawing.add(joints);
}

}  // namespace keyline::figure::detail
