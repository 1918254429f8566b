#include "keyline/figure/rhythm_charts.h"

#include <algorithm>
#include <cmath>

#include "keyline/figure/plot.h"

namespace keyline::figure {

using core::Point2;

namespace {

/// Two decimals: slopes are read as "about minus one", not to the last digit.
std::string slope_text(const char* symbol, double slope) {
  const double rounded = std::round(slope * 100) / 100 + 0.0;
  return std::string(symbol) + " = " + short_number(rounded, 4);
}

void add_lines(Plot& plot, const std::vector<FittedLine>& lines, const char* symbol) {
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const FittedLine& line = lines[i];
    const auto at = [&line](double x) { return Point2{x, line.intercept + line.slope * x}; };
    Series series;
    series.name = slope_text(symbol, line.slope);
    series.color = palette(i == 0 ? 1 : i + 2);
    series.width = 2;
    series.points = {at(line.from), at(line.to)};
    plot.series.push_back(series);
  }
}

}  // namespace

Drawing lcg_chart(const LcgPiece& piece, double width, double height) {
  Plot plot;
  plot.title = piece.name;
  plot.width = width;
  plot.height = height;
  plot.x.title = "log\u2081\u2080 \u03C1";
  plot.y.title = "log\u2081\u2080 |\u03C1 ds/d\u03C1|";
  if (!piece.measured.empty())
    plot.series.push_back(Series{.name = "before",
                                 .points = piece.measured,
                                 .kind = SeriesKind::points,
                                 .color = lighter(kRaw, 0.3),
                                 .size = 2.4,
                                 .sets_range = false});
  plot.series.push_back(Series{.points = piece.points,
                               .kind = SeriesKind::points,
                               .color = lighter(palette(0), 0.35),
                               .size = 3});
  add_lines(plot, piece.lines, "\u03B1");
  if (piece.variance) plot.subtitle = "variance " + short_number(*piece.variance, 2);
  return draw(plot);
}

namespace {

/// A and B, the ends of the C curve.
void add_ends(Plot& plot, const LddcPiece& piece) {
  Series ends{.kind = SeriesKind::points, .color = kInk, .size = 6};
  const auto add_end = [&](const std::optional<Point2>& p, const char* name) {
    if (!p) return;
    ends.points.push_back(*p);
    plot.notes.push_back({.at = *p, .text = name, .offset = {6, -5}, .bold = true});
  };
  add_end(piece.point_a, "A");
  add_end(piece.point_b, "B");
  plot.series.push_back(ends);
}

}  // namespace

Drawing lddc_chart(const LddcPiece& piece, double width, double height) {
  Plot plot;
  plot.title = piece.name;
  plot.width = width;
  plot.height = height;
  plot.x.title = "log\u2081\u2080(\u03C1 / S)";
  plot.y.title = "log\u2081\u2080(s / S)";
  plot.series.push_back(Series{.name = "bins",
                               .points = piece.bars,
                               .kind = SeriesKind::bars,
                               .color = lighter(palette(0), 0.6),
                               .bar_width = piece.bin_width});
  if (!piece.measured.empty())
    plot.series.push_back(Series{.name = "before",
                                 .points = piece.measured,
                                 .color = kRaw,
                                 .width = 1.1,
                                 .dash = {3, 2},
                                 .sets_range = false});
  plot.series.push_back(
      Series{.name = "C curve", .points = piece.c_curve, .color = palette(0), .width = 1.4});
  add_lines(plot, piece.lines, "slope");
  add_ends(plot, piece);
  std::vector<double> heights;
  for (const Series& series : plot.series) {
    if (!series.sets_range) continue;
    for (const Point2& p : series.points) heights.push_back(p.y);
  }
  const core::Interval range = axis_range(heights, Scale::linear);
  plot.y.low = range.low - 0.08 * length(range);
  plot.y.high = std::min(0.0, range.high + 0.04 * length(range));  // a share is 1 at most
  return draw(plot);
}

}  // namespace keyline::figure
