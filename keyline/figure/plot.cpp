#include "keyline/figure/plot.h"

#include <algorithm>
#include <cmath>

#include "keyline/figure/frame.h"

namespace keyline::figure {

using core::Interval;
using core::Point2;

namespace {

/// From axis values to page positions.
struct AxisMap {
  Scale scale = Scale::linear;
  Interval values;
  Interval page;

  double operator()(double value) const {
    if (scale == Scale::linear) return at(page, (value - values.low) / length(values));
    if (scale == Scale::signed_root) {
      const double low = signed_root(values.low);
      return at(page, (signed_root(value) - low) / (signed_root(values.high) - low));
    }
    if (!(value > 0)) return NAN;
    const double low = std::log(values.low);
    return at(page, (std::log(value) - low) / (std::log(values.high) - low));
  }
};

struct Frame {
  AxisMap x;
  AxisMap y;
  Box box;

  Point2 operator()(Point2 p) const { return {x(p.x), y(p.y)}; }
};

Interval range_of(const Axis& axis, const std::vector<double>& values) {
  Interval range = axis_range(values, axis.scale);
  if (axis.low) range.low = *axis.low;
  if (axis.high) range.high = *axis.high;
  const bool positive = axis.scale != Scale::log10 || range.low > 0;
  if (axis.low && axis.high && !(range.low < range.high && positive))
    throw core::InvalidInput("draw: the range given for an axis is empty");
  if (!(range.low < range.high)) {
    if (axis.low)
      range.high = range.low + std::max(1.0, std::abs(range.low));
    else
      range.low = range.high - std::max(1.0, std::abs(range.high));
  }
  if (!(std::isfinite(length(range)) && positive))
    throw core::InvalidInput("draw: the range given for an axis is not usable");
  return range;
}

std::vector<double> values_of(const Plot& plot, bool along_x) {
  std::vector<double> values;
  for (const Series& series : plot.series) {
    if (!series.sets_range) continue;
    for (const Point2& p : series.points) {
      if (!core::is_finite(p)) continue;
      values.push_back(along_x ? p.x : p.y);
      if (series.kind != SeriesKind::bars || !along_x) continue;
      values.back() -= series.bar_width / 2;
      values.push_back(p.x + series.bar_width / 2);
    }
  }
  return values;
}

Ticks ticks_for(const Axis& axis, const Interval& range, int most) {
  switch (axis.scale) {
    case Scale::log10:
      return log_ticks(range, most);
    case Scale::signed_root:
      return signed_root_ticks(range, most);
    case Scale::linear:
      break;
  }
  return linear_ticks(range, most);
}

double widest_label(const Ticks& ticks) {
  double widest = 0;
  for (const Tick& tick : ticks.ticks)
    widest = std::max(widest, text_width(tick.label, detail::kTextSize));
  return widest;
}

/// As many ticks along x as have room side by side.
Ticks ticks_along(const Axis& axis, const Interval& range, double room) {
  Ticks ticks;
  for (int most = 12; most >= 2; --most) {
    ticks = ticks_for(axis, range, most);
    int labels = 0;
    for (const Tick& tick : ticks.ticks) labels += !tick.label.empty();
    const double spacing = room / std::max(labels, 1);
    if (widest_label(ticks) + 16 <= spacing) break;
  }
  return ticks;
}

std::string axis_title(const Axis& axis, const Ticks& ticks) {
  if (ticks.exponent == 0) return axis.title;
  return axis.title + (axis.title.empty() ? "" : " ") + "\u00D710" + superscript(ticks.exponent);
}

std::vector<detail::LegendEntry> legend_of(const Plot& plot) {
  using Sample = detail::LegendEntry::Sample;
  std::vector<detail::LegendEntry> legend;
  for (const Series& s : plot.series) {
    if (s.name.empty()) continue;
    const Sample sample = s.kind == SeriesKind::line     ? Sample::line
                          : s.kind == SeriesKind::points ? Sample::marker
                                                         : Sample::bar;
    legend.push_back({s.name, sample, s.color, s.width, s.dash, s.marker, s.size});
  }
  for (const Rule& rule : plot.rules)
    if (!rule.name.empty())
      legend.push_back({rule.name, Sample::line, rule.color, 1.2, rule.dash, Marker::dot, 4});
  return legend;
}

Path straight(Point2 a, Point2 b) {
  Path path;
  path.move_to(a).line_to(b);
  return path;
}

void add_bands(Drawing& drawing, const Plot& plot, const Frame& frame) {
  double free_from = frame.box.min.x;
  for (const Band& band : plot.bands) {
    const double a = std::clamp(frame.x(band.from), frame.box.min.x, frame.box.max.x);
    const double b = std::clamp(frame.x(band.to), frame.box.min.x, frame.box.max.x);
    if (!(a < b)) continue;
    if (band.shaded)
      drawing.add(Shape{rectangle({{a, frame.box.min.y}, {b, frame.box.max.y}}), std::nullopt,
                        Color{245, 247, 249}});
    const double needed = text_width(band.name, 10);
    const double middle = (a + b) / 2;
    if (band.name.empty() || needed + 4 > b - a || middle - needed / 2 < free_from) continue;
    drawing.add(Label{.at = {middle, frame.box.min.y - 4},
                      .text = band.name,
                      .size = 10,
                      .color = kSoftInk,
                      .anchor = Anchor::middle});
    free_from = middle + needed / 2 + 3;
  }
}

void add_x_axis(Drawing& drawing, const Frame& frame, const Ticks& ticks,
                const std::string& title) {
  const Box& box = frame.box;
  Path grid;
  Path marks;
  for (const Tick& tick : ticks.ticks) {
    const double x = frame.x(tick.value);
    const bool major = !tick.label.empty();
    marks.move_to({x, box.max.y}).line_to({x, box.max.y + (major ? 5 : 3)});
    if (!major) continue;
    grid.move_to({x, box.min.y}).line_to({x, box.max.y});
    drawing.add(Label{.at = {x, box.max.y + 8},
                      .text = tick.label,
                      .size = detail::kTextSize,
                      .color = kSoftInk,
                      .anchor = Anchor::middle,
                      .baseline = Baseline::top});
  }
  drawing.add(Shape{grid, Stroke{kGrid, 1, {}}, std::nullopt});
  drawing.add(Shape{marks, Stroke{kFrame, 1, {}}, std::nullopt});
  if (title.empty()) return;
  drawing.add(Label{.at = {(box.min.x + box.max.x) / 2, box.max.y + 26},
                    .text = detail::shortened(title, drawing.width, detail::kTextSize),
                    .size = detail::kTextSize,
                    .anchor = Anchor::middle,
                    .baseline = Baseline::top});
}

void add_y_axis(Drawing& drawing, const Frame& frame, const Ticks& ticks,
                const std::string& title) {
  const Box& box = frame.box;
  Path grid;
  Path marks;
  for (const Tick& tick : ticks.ticks) {
    const double y = frame.y(tick.value);
    const bool major = !tick.label.empty();
    marks.move_to({box.min.x, y}).line_to({box.min.x - (major ? 5 : 3), y});
    if (!major) continue;
    grid.move_to({box.min.x, y}).line_to({box.max.x, y});
    drawing.add(Label{.at = {box.min.x - 8, y},
                      .text = tick.label,
                      .size = detail::kTextSize,
                      .color = kSoftInk,
                      .anchor = Anchor::end,
                      .baseline = Baseline::middle});
  }
  drawing.add(Shape{grid, Stroke{kGrid, 1, {}}, std::nullopt});
  drawing.add(Shape{marks, Stroke{kFrame, 1, {}}, std::nullopt});
  if (title.empty()) return;
  drawing.add(Label{.at = {detail::kPad + 4, (box.min.y + box.max.y) / 2},
                    .text = detail::shortened(title, height(box) + 40, detail::kTextSize),
                    .size = detail::kTextSize,
                    .anchor = Anchor::middle,
                    .baseline = Baseline::middle,
                    .rotation = M_PI / 2});
}

void add_rules(Drawing& drawing, const Plot& plot, const Frame& frame) {
  const Box& box = frame.box;
  for (const Rule& rule : plot.rules) {
    const double at = rule.vertical ? frame.x(rule.at) : frame.y(rule.at);
    const bool inside =
        rule.vertical ? box.min.x <= at && at <= box.max.x : box.min.y <= at && at <= box.max.y;
    if (!inside) continue;
    const Path path = rule.vertical ? straight({at, box.min.y}, {at, box.max.y})
                                    : straight({box.min.x, at}, {box.max.x, at});
    drawing.add(Shape{path, Stroke{rule.color, 1, rule.dash}, std::nullopt});
  }
}

void add_bars(Drawing& drawing, const Series& series, const Frame& frame) {
  const double zero = frame.y.scale == Scale::linear ? frame.y(0) : NAN;
  const double base = zero >= frame.box.min.y && zero <= frame.box.max.y ? zero : frame.box.max.y;
  const bool logs = !(frame.y.values.high > 0);  // heights that are logarithms grow from below
  Path path;
  for (const Point2& p : series.points) {
    if (!core::is_finite(p)) continue;
    const double x0 = std::max(frame.x(p.x - series.bar_width / 2), frame.box.min.x);
    const double x1 = std::min(frame.x(p.x + series.bar_width / 2), frame.box.max.x);
    const double y0 = logs ? frame.box.max.y : base;
    const double y1 = std::clamp(frame.y(p.y), frame.box.min.y, frame.box.max.y);
    if (!(x0 < x1)) continue;
    const Path bar = rectangle({{x0, std::min(y0, y1)}, {x1, std::max(y0, y1)}});
    path.steps.insert(path.steps.end(), bar.steps.begin(), bar.steps.end());
  }
  drawing.add(Shape{path, Stroke{kPaper, 0.5, {}}, series.color});
}

void add_series(Drawing& drawing, const Series& series, const Frame& frame) {
  if (series.kind == SeriesKind::bars) return add_bars(drawing, series, frame);
  std::vector<Point2> page;
  page.reserve(series.points.size());
  for (const Point2& p : series.points) page.push_back(frame(p));
  if (series.kind == SeriesKind::points) {
    const Box room = grown(frame.box, 0.5);
    std::erase_if(page, [&room](Point2 p) {
      return !(p.x >= room.min.x && p.x <= room.max.x && p.y >= room.min.y && p.y <= room.max.y);
    });
    drawing.add(Marks{page, series.marker, series.size, series.color});
    return;
  }
  Path path;
  for (const auto& run : clip_to_box(page, frame.box)) {
    const Path part = polyline(simplify(run, 0.05));
    path.steps.insert(path.steps.end(), part.steps.begin(), part.steps.end());
  }
  drawing.add(Shape{path, Stroke{series.color, series.width, series.dash}, std::nullopt});
}

void add_regions(Drawing& drawing, const Plot& plot, const Frame& frame) {
  Group group{"regions", frame.box, {}};
  for (Path path : plot.regions) {
    for (PathStep& step : path.steps)
      for (Point2& p : step.point) p = frame(p);
    group.add(Shape{path, std::nullopt, plot.region_color});
  }
  if (!group.items.empty()) drawing.add(std::move(group));
}

/// Notes stay inside the page; one that would run into an earlier one moves below it.
void add_notes(Drawing& drawing, const Plot& plot, const Frame& frame) {
  constexpr double kSize = detail::kTextSize;
  std::vector<Box> taken;
  for (const Note& note : plot.notes) {
    const Point2 point = frame(note.at);
    if (!core::is_finite(point)) continue;
    const double wide = text_width(note.text, kSize, note.bold);
    const double share = note.anchor == Anchor::end ? 1 : note.anchor == Anchor::middle ? 0.5 : 0;
    Point2 at = point + note.offset;
    at.x = std::clamp(at.x - share * wide, 2.0, std::max(2.0, drawing.width - wide - 2));
    at.y = std::clamp(at.y, frame.box.min.y + kSize,
                      std::max(frame.box.min.y + kSize, frame.box.max.y - 4));
    const auto box = [&at, wide] { return Box{{at.x, at.y - kSize}, {at.x + wide, at.y + 3}}; };
    for (const Box& other : taken) {
      const Box mine = box();
      if (mine.min.x < other.max.x && other.min.x < mine.max.x && mine.min.y < other.max.y &&
          other.min.y < mine.max.y)
        at.y = other.max.y + kSize;
    }
    taken.push_back(box());
    drawing.add(Label{.at = at,
                      .text = note.text,
                      .size = kSize,
                      .color = note.color,
                      .bold = note.bold,
                      .halo = 2});
  }
}

/// Where everything goes, once the room the labels take is known.
Frame lay_out(const Plot& plot, double top, const Interval& x, const Interval& y, Ticks& x_ticks,
              Ticks& y_ticks) {
  const double bottom = plot.height - (plot.x.title.empty() ? 28 : 46);
  const double inner = std::max(bottom - top, 20.0);
  y_ticks = ticks_for(plot.y, y, std::clamp(static_cast<int>(inner / 34), 2, 9));
  const double left = detail::kPad + widest_label(y_ticks) + 10 + (plot.y.title.empty() ? 0 : 18);
  const double right = plot.width - 16;
  x_ticks = ticks_along(plot.x, x, right - left);
  const Box box{{left, top}, {std::max(right, left + 20), top + inner}};
  return {
      {plot.x.scale, x, {box.min.x, box.max.x}}, {plot.y.scale, y, {box.max.y, box.min.y}}, box};
}

}  // namespace

Drawing draw(const Plot& plot) {
  if (!(plot.width >= 160 && plot.height >= 120))
    throw core::InvalidInput("draw: a plot needs at least 160 x 120 px");
  Drawing drawing;
  drawing.width = plot.width;
  drawing.height = plot.height;
  drawing.title = plot.title;
  drawing.description = plot.subtitle;
  double top = detail::add_heading(drawing, plot.title, plot.subtitle, legend_of(plot));
  for (const Band& band : plot.bands)
    if (!band.name.empty()) {
      top += 12;
      break;
    }
  Ticks x_ticks;
  Ticks y_ticks;
  const Frame frame = lay_out(plot, top, range_of(plot.x, values_of(plot, true)),
                              range_of(plot.y, values_of(plot, false)), x_ticks, y_ticks);
  add_bands(drawing, plot, frame);
  add_regions(drawing, plot, frame);
  add_x_axis(drawing, frame, x_ticks, axis_title(plot.x, x_ticks));
  add_y_axis(drawing, frame, y_ticks, axis_title(plot.y, y_ticks));
  add_rules(drawing, plot, frame);
  for (std::size_t i = 0; i < plot.series.size(); ++i)
    add_series(drawing, plot.series[plot.first_on_top ? plot.series.size() - 1 - i : i], frame);
  drawing.add(Shape{rectangle(frame.box), Stroke{kFrame, 1, {}}, std::nullopt});
  add_notes(drawing, plot, frame);
  return drawing;
}

}  // namespace keyline::figure
