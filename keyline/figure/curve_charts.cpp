#include "keyline/figure/curve_charts.h"

#include <algorithm>
#include <cmath>

#include "keyline/core/angle.h"
#include "keyline/core/quantile.h"
#include "keyline/figure/model_figure.h"
#include "keyline/figure/plot.h"

namespace keyline::figure {

using core::Point2;
using core::Vector2;
using detail::LegendEntry;
using detail::ModelFigure;

namespace {

std::string bracketed(const std::string& text) { return text.empty() ? "" : " [" + text + "]"; }

double largest_curvature(const SampledCurve& curve) {
  double largest = 0;
  for (const double k : curve.curvature)
    if (std::isfinite(k)) largest = std::max(largest, std::abs(k));
  return largest;
}

Vector2 left_normal(const SampledCurve& curve, std::size_t i) {
  return perpendicular_left(core::unit_vector(curve.tangent_angle[i]));
}

/// Without the lowest and highest fiftieth: a few wild values do not count.
std::vector<double> usual_values(std::vector<double> values) {
  std::erase_if(values, [](double v) { return !std::isfinite(v); });
  std::sort(values.begin(), values.end());
  const auto cut = static_cast<std::ptrdiff_t>(values.size() / 50);
  return {values.begin() + cut, values.end() - cut};
}

/// The values as the axis places them.
std::vector<double> placed(std::vector<double> values, Scale scale) {
  if (scale == Scale::signed_root)
    for (double& v : values) v = signed_root(v);
  return values;
}

/// The range of the first curve, stretched by half at most to show the others' usual values.
core::Interval curvature_range(const std::vector<SampledCurve>& curves, Scale scale) {
  std::vector<double> first;
  if (!curves.empty()) first = placed(curves[0].curvature, scale);
  first.push_back(0);
  core::Interval range = axis_range(first, Scale::linear);
  const double slack = 0.5 * length(range);
  const core::Interval most{range.low - slack, range.high + slack};
  for (std::size_t i = 1; i < curves.size(); ++i) {
    const std::vector<double> usual = usual_values(placed(curves[i].curvature, scale));
    const core::Interval other = axis_range(usual, Scale::linear);
    range.low = std::max(most.low, std::min(range.low, other.low));
    range.high = std::min(most.high, std::max(range.high, other.high));
  }
  if (scale == Scale::signed_root)
    range = {range.low * std::abs(range.low), range.high * std::abs(range.high)};
  return range;
}

/// True where a few places are so much tighter than the rest that those would not be seen.
bool needs_root_scale(const SampledCurve& curve) {
  std::vector<double> sizes;
  for (const double k : curve.curvature)
    if (std::isfinite(k)) sizes.push_back(std::abs(k));
  if (sizes.empty()) return false;
  const double middle = core::quantile(std::move(sizes));
  return largest_curvature(curve) > 25 * middle && middle > 0;
}

std::vector<Band> piece_bands(const SampledCurve& curve) {
  std::vector<std::size_t> joints = curve.joints;
  if (joints.empty() || curve.points.empty()) return {};
  std::sort(joints.begin(), joints.end());
  joints.push_back(curve.points.size() - 1);
  std::vector<Band> bands;
  double from = curve.arc_length.front();
  for (const std::size_t joint : joints) {
    const double to = curve.arc_length[joint];
    if (!(to > from)) continue;
    const std::size_t index = bands.size();
    bands.push_back({from, to, detail::piece_name(curve, index), index % 2 == 1});
    from = to;
  }
  return bands;
}

}  // namespace

Drawing curvature_plot(const std::vector<SampledCurve>& curves, const ChartOptions& options) {
  for (const SampledCurve& curve : curves) detail::check(curve);
  Plot plot;
  plot.title = options.title.empty() ? "Curvature" : options.title;
  plot.width = options.width;
  plot.x.title = "Arc length" + bracketed(options.unit);
  plot.y.title = "Curvature" + bracketed(options.unit.empty() ? "" : "1/" + options.unit);
  if (!curves.empty() && needs_root_scale(curves[0])) {
    plot.y.scale = Scale::signed_root;
    plot.subtitle = "Square-root scale: a few places are far tighter than the rest";
  }
  const core::Interval range = curvature_range(curves, plot.y.scale);
  plot.y.low = range.low;
  plot.y.high = range.high;
  plot.rules.push_back({0, false, kFrame, {}, ""});
  if (!curves.empty()) plot.bands = piece_bands(curves[0]);
  plot.first_on_top = true;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    Series series;
    series.name = curves[i].name;
    series.color = i == 0 ? palette(0) : i == 1 ? kRaw : palette(i);
    series.width = i == 0 ? 2 : 1.2;
    for (std::size_t j = 0; j < curves[i].points.size(); ++j)
      series.points.push_back({curves[i].arc_length[j], curves[i].curvature[j]});
    if (i == 0 && !series.points.empty()) plot.x.low = series.points.front().x;
    if (i == 0 && !series.points.empty()) plot.x.high = series.points.back().x;
    plot.series.push_back(std::move(series));
  }
  if (plot.x.low && !(*plot.x.low < *plot.x.high)) plot.x.low = plot.x.high = std::nullopt;
  return draw(plot);
}

namespace {

/// Tips of the teeth; the longest tooth has the length `longest`.
std::vector<Point2> comb_tips(const SampledCurve& curve, double longest, bool root) {
  const double largest = largest_curvature(curve);
  std::vector<Point2> tips;
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    const double share = largest > 0 ? curve.curvature[i] / largest : 0;
    tips.push_back(curve.points[i] -
                   longest * (root ? signed_root(share) : share) * left_normal(curve, i));
  }
  return tips;
}

double diagonal(const Box& box) { return is_empty(box) ? 0 : std::hypot(width(box), height(box)); }

/// Teeth at about even spacing on the page, joints always among them.
void add_teeth(ModelFigure& figure, const SampledCurve& curve, const std::vector<Point2>& tips) {
  constexpr double kSpacing = 3.5;  // px
  std::vector<char> wanted(curve.points.size(), 0);
  for (const std::size_t joint : curve.joints) wanted[joint] = 1;
  Path path;
  double since = kSpacing;
  for (std::size_t i = 0; i < tips.size(); ++i) {
    if (i > 0) {
      const double foot = core::distance(curve.points[i - 1], curve.points[i]);
      const double tip = core::distance(tips[i - 1], tips[i]);
      since += figure.view.scale * (std::isfinite(tip) ? std::max(foot, 0.5 * tip) : foot);
    }
    if (since < kSpacing && !wanted[i] && i + 1 < tips.size()) continue;
    if (!core::is_finite(tips[i])) continue;
    since = 0;
    path.move_to(to_page(figure.view, curve.points[i]));
    path.line_to(to_page(figure.view, tips[i]));
  }
  figure.drawing.add(Shape{path, Stroke{lighter(palette(0), 0.55), 0.7, {}}, std::nullopt});
}

/// Rings about the tips of teeth with their letters beyond; of those on one spot the first.
void add_marks(ModelFigure& figure, const SampledCurve& curve, const std::vector<Point2>& tips) {
  Marks rings{.marker = Marker::circle, .size = 8, .color = palette(1)};
  for (const CurveMark& mark : curve.marks) {
    if (mark.sample >= tips.size() || !core::is_finite(tips[mark.sample])) continue;
    const Point2 at = to_page(figure.view, tips[mark.sample]);
    const auto near = [at](Point2 other) { return core::distance(at, other) < 9; };
    if (std::any_of(rings.points.begin(), rings.points.end(), near)) continue;
    rings.points.push_back(at);
    figure.drawing.add(Label{.at = {at.x + 6, at.y - 6},
                             .text = mark.text,
                             .size = 10.5,
                             .color = palette(1),
                             .bold = true,
                             .halo = 2});
  }
  if (!rings.points.empty()) figure.drawing.add(rings);
}

}  // namespace

Drawing curvature_comb(const SampledCurve& curve, const ChartOptions& options) {
  detail::check(curve);
  const double largest = largest_curvature(curve);
  const Box extent = box_of(curve.points);
  const bool root = needs_root_scale(curve);
  const std::vector<Point2> tips = comb_tips(curve, 0.16 * diagonal(extent), root);
  Box model = extent;
  for (const Point2& tip : tips) include(model, tip);
  std::string subtitle = largest > 0
                             ? "Longest tooth: curvature " + short_number(largest, 3) +
                                   (options.unit.empty() ? "" : " 1/" + options.unit) +
                                   ", radius " + detail::with_unit(1 / largest, options.unit)
                             : "The curve is straight: no teeth";
  if (root) subtitle += "; teeth grow with the square root of the curvature";
  ModelFigure figure = detail::start_figure(model, "Curvature comb", subtitle, {}, options);
  add_teeth(figure, curve, tips);
  detail::add_line(figure, tips, Stroke{palette(0), 1, {}});
  detail::add_curve(figure, curve, Stroke{kInk, 1.8, {}});
  add_marks(figure, curve, tips);
  detail::add_piece_numbers(figure, curve);
  detail::add_scale_bar(figure, options.unit);
  return std::move(figure.drawing);
}

namespace {

/// Centres of curvature; a gap where the curvature vanishes or changes sign. Very far ones are
/// drawn nearer on their normal: cutting a line of any length at the border would lose its digits.
std::vector<Point2> evolute_points(const SampledCurve& curve) {
  constexpr Point2 kGap{NAN, NAN};
  const double farthest = 1e5 * diagonal(box_of(curve.points));
  std::vector<Point2> centers;
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    const double k = curve.curvature[i];
    if (i > 0 && !(curve.curvature[i - 1] * k > 0)) centers.push_back(kGap);
    const double radius = std::clamp(1 / k, -farthest, farthest);
    const Point2 center = curve.points[i] + radius * left_normal(curve, i);
    centers.push_back(k != 0 && core::is_finite(center) ? center : kGap);
  }
  return centers;
}

constexpr double kFarthestEvolute = 4;  ///< from the curve, in sizes of the curve

/// Least distance of the finite points from the box along an axis; infinite without any.
double distance_outside(const Box& box, const std::vector<Point2>& points) {
  double least = HUGE_VAL;
  for (const Point2& p : points) {
    const double x = std::max({box.min.x - p.x, p.x - box.max.x, 0.0});
    const double y = std::max({box.min.y - p.y, p.y - box.max.y, 0.0});
    if (core::is_finite(p)) least = std::min(least, std::max(x, y));
  }
  return least;
}

}  // namespace

Drawing evolute_chart(const SampledCurve& curve, const ChartOptions& options) {
  detail::check(curve);
  const std::vector<Point2> centers = evolute_points(curve);
  const Box extent = box_of(curve.points);
  const double size = diagonal(extent);
  // As far out as the evolute begins and some way along it, but not so far that the curve is lost.
  const double nearest = distance_outside(extent, centers);
  const bool far = nearest > kFarthestEvolute * size;
  const double reach = far ? 0.4 * size : std::max(0.4 * size, nearest + 0.4 * size);
  const Box room = is_empty(extent) ? extent : grown(extent, reach);
  Box model = extent;
  for (const auto& run : clip_to_box(centers, room))
    for (const Point2& p : run) include(model, p);
  const std::vector<LegendEntry> legend = {
      {.name = curve.name.empty() ? "curve" : curve.name, .color = kInk, .width = 1.8},
      {.name = "evolute", .color = palette(1), .width = 1.3}};
  ChartOptions limited = options;
  limited.largest_height = std::min(options.largest_height, 0.7 * options.width);
  ModelFigure figure = detail::start_figure(
      model, "Evolute",
      far ? "All centres of curvature lie far outside the picture" : "Centres of curvature", legend,
      limited);
  detail::add_line(figure, centers, Stroke{palette(1), 1.3, {}});
  detail::add_curve(figure, curve, Stroke{kInk, 1.8, {}});
  detail::add_piece_numbers(figure, curve);
  detail::add_scale_bar(figure, options.unit);
  return std::move(figure.drawing);
}

namespace {

double largest_deviation(const Overlay& overlay) {
  double largest = 0;
  for (std::size_t i = 0; i < overlay.points.size(); ++i) {
    const double d = core::distance(overlay.points[i], overlay.feet[i]);
    if (std::isfinite(d)) largest = std::max(largest, d);
  }
  return largest;
}

double round_exaggeration(double largest, double size) {
  const double wished = 0.07 * size / largest;
  return std::isfinite(wished) && wished > 1 ? round_number_below(wished) : 1;
}

void add_deviation_comb(ModelFigure& figure, const Overlay& overlay, double exaggeration) {
  Path within;
  Path beyond;
  for (std::size_t i = 0; i < overlay.points.size(); ++i) {
    const Vector2 off = overlay.points[i] - overlay.feet[i];
    if (!core::is_finite(off)) continue;
    const bool far = overlay.tolerance > 0 && norm(off) > overlay.tolerance;
    Path& path = far ? beyond : within;
    path.move_to(to_page(figure.view, overlay.feet[i]));
    path.line_to(to_page(figure.view, overlay.feet[i] + exaggeration * off));
  }
  figure.drawing.add(Shape{within, Stroke{lighter(palette(2), 0.25), 0.8, {}}, std::nullopt});
  figure.drawing.add(Shape{beyond, Stroke{kWarning, 1.4, {}}, std::nullopt});
}

std::vector<LegendEntry> overlay_legend(const Overlay& overlay, bool beyond) {
  using Sample = LegendEntry::Sample;
  std::vector<LegendEntry> legend = {
      {.name = "given points", .sample = Sample::marker, .color = kRaw},
      {.name = overlay.curve.name.empty() ? "faired curve" : overlay.curve.name,
       .color = palette(0),
       .width = 2},
      {.name = "deviation", .color = lighter(palette(2), 0.25), .width = 1.2}};
  if (beyond) legend.push_back({.name = "beyond tolerance", .color = kWarning, .width = 1.4});
  return legend;
}

}  // namespace

Drawing overlay(const Overlay& overlay, const ChartOptions& options) {
  if (overlay.points.size() != overlay.feet.size())
    throw core::InvalidInput("overlay: needs one foot for every point");
  for (const std::size_t joint : overlay.curve.joints)
    if (joint >= overlay.curve.points.size())
      throw core::InvalidInput("overlay: a joint is no sample of the curve");
  Box model = box_of(overlay.points);
  for (const Point2& p : overlay.curve.points) include(model, p);
  const double largest = largest_deviation(overlay);
  const double exaggeration = overlay.exaggeration > 0
                                  ? overlay.exaggeration
                                  : round_exaggeration(largest, diagonal(model));
  for (std::size_t i = 0; i < overlay.points.size(); ++i)
    include(model, overlay.feet[i] + exaggeration * (overlay.points[i] - overlay.feet[i]));
  std::string subtitle = "Largest deviation " + detail::with_unit(largest, options.unit);
  if (overlay.tolerance > 0)
    subtitle += ", tolerance " + detail::with_unit(overlay.tolerance, options.unit);
  subtitle += exaggeration == 1
                  ? "; deviations drawn to scale"
                  : "; deviations drawn " + short_number(exaggeration) + " times too long";
  const bool beyond = overlay.tolerance > 0 && largest > overlay.tolerance;
  ModelFigure figure = detail::start_figure(model, "Before and after", subtitle,
                                            overlay_legend(overlay, beyond), options);
  add_deviation_comb(figure, overlay, exaggeration);
  const double dot = std::clamp(400.0 / std::max<std::size_t>(overlay.points.size(), 1), 1.8, 3.6);
  figure.drawing.add(Marks{to_page(figure.view, overlay.points), Marker::dot, dot, kRaw});
  detail::add_curve(figure, overlay.curve, Stroke{palette(0), 1.6, {}});
  detail::add_scale_bar(figure, options.unit);
  return std::move(figure.drawing);
}

}  // namespace keyline::figure
