#include <algorithm>
#include <array>
#include <cmath>

#include "keyline/curve/piecewise_bezier.h"
#include "keyline/figure/drawing.h"
#include "keyline/figure/plot.h"
#include "keyline/operations/sketch_trace.h"
#include "keyline/presentation/pages.h"

namespace keyline::presentation {
namespace {

using core::Point2;
using core::Result;
using sketch::Stroke;

/// A picture of the drawing's size with lines over it.
class Sheet {
 public:
  Sheet(int width, int height) : height_(height) {
    drawing_.width = width;
    drawing_.height = height;
  }

  void picture(const sketch::Raster<std::uint8_t>& gray, double strength) {
    figure::Picture picture{
        {{0, 0}, {drawing_.width, drawing_.height}}, gray.width, gray.height, {}, {}};
    for (const std::uint8_t v : gray.data)
      picture.rgb.insert(picture.rgb.end(), 3,
                         static_cast<std::uint8_t>(255 - strength * (255 - v)));
    drawing_.add(std::move(picture));
  }

  void line(std::vector<Point2> points, figure::Color color, double width, bool closed = false) {
    for (Point2& p : points) p.y = height_ - p.y;
    drawing_.add(
        figure::Shape{figure::polyline(points, closed), figure::Stroke{color, width, {}}, {}});
  }

  void dots(std::vector<Point2> points, figure::Color color, double size) {
    for (Point2& p : points) p.y = height_ - p.y;
    drawing_.add(figure::Marks{std::move(points), figure::Marker::dot, size, color});
  }

  const figure::Drawing& drawing() const { return drawing_; }

 private:
  figure::Drawing drawing_;
  double height_;
};

std::vector<Point2> sampled(const curve::Bezier2& piece) {
  std::vector<Point2> points;
  for (int i = 0; i <= 24; ++i) points.push_back(evaluate(piece, i / 24.0));
  return points;
}

/// Pieces in one colour, joints as dots, curvature as hairs where asked for.
void draw_pieces(Sheet& sheet, const std::vector<curve::Bezier2>& pieces, figure::Color color,
                 bool comb) {
  for (const curve::Bezier2& piece : pieces) {
    if (comb) {
      std::vector<Point2> tips;
      for (int i = 0; i <= 24; ++i) {
        const auto at = jet(piece, i / 24.0);
        const double height = std::clamp(600 * curvature(at), -40.0, 40.0);
        const Point2 tip = at.point - height * core::perpendicular_left(unit_tangent(at));
        sheet.line({at.point, tip}, figure::with_alpha(color, 0.5), 0.5);
        tips.push_back(tip);
      }
      sheet.line(tips, figure::with_alpha(color, 0.8), 0.7);
    }
    sheet.line(sampled(piece), color, 1.4);
    sheet.dots({piece.control.front(), piece.control.back()}, color, 4);
  }
}

figure::Plot histogram(const sketch::Stage& log) {
  std::array<double, 256> count{};
  for (const std::uint8_t v : log.picture.data) count[v] += 1;
  figure::Series bars{.name = "pixels", .kind = figure::SeriesKind::bars, .bar_width = 1};
  for (std::size_t v = 0; v < count.size(); ++v)
    bars.points.push_back({static_cast<double>(v), std::log10(1 + count[v])});
  figure::Plot plot;
  plot.title = "Histogram of the log picture";
  plot.x.title = "level y, 0 black, 255 paper";
  plot.y.title = "log10(1 + pixels)";
  plot.series = {std::move(bars)};
  return plot;
}

using Value = double (*)(const curve::Jet2&);

constexpr int kSteps = 32;  ///< of a piece in plots

/// Arc length at equal steps of a chain's parameter, kSteps to a piece.
std::vector<double> lengths_along(const std::vector<curve::Bezier2>& pieces) {
  std::vector<double> lengths = {0};
  for (const curve::Bezier2& piece : pieces)
    for (int i = 1; i <= kSteps; ++i)
      lengths.push_back(lengths.back() +
                        core::distance(evaluate(piece, (i - 1.0) / kSteps),
                                       evaluate(piece, static_cast<double>(i) / kSteps)));
  return lengths;
}

figure::Series profile(const std::string& name, const std::vector<curve::Bezier2>& pieces,
                       Value value, std::size_t color) {
  figure::Series series{.name = name, .color = figure::palette(color)};
  const std::vector<double> lengths = lengths_along(pieces);
  for (std::size_t k = 0; k < pieces.size(); ++k)
    for (std::size_t i = 0; i <= kSteps; ++i)
      series.points.push_back(
          {lengths[k * kSteps + i], value(jet(pieces[k], static_cast<double>(i) / kSteps))});
  return series;
}

figure::Series target_of(const Stroke& stroke) {
  figure::Series series{.name = "target", .color = figure::palette(2), .dash = {4, 3}};
  const std::vector<double> lengths = lengths_along(stroke.curve);
  for (const auto& t : stroke.target)
    series.points.push_back({lengths[static_cast<std::size_t>(
                                 std::lround(t.t * static_cast<double>(lengths.size() - 1)))],
                             t.curvature});
  return series;
}

double curvature_of(const curve::Jet2& at) { return curvature(at); }
double speed_of(const curve::Jet2& at) { return speed(at); }

figure::Plot profiles(const Stroke& stroke, const std::string& title, const std::string& unit,
                      Value value) {
  figure::Plot plot;
  plot.title = title + " of the longest stroke";
  plot.x.title = "arc length, pixels";
  plot.y.title = title + ", " + unit;
  plot.series = {profile("quadratics", stroke.quadratics, value, 1),
                 profile("quintics", stroke.curve, value, 0)};
  if (value == curvature_of && !stroke.target.empty()) plot.series.push_back(target_of(stroke));
  return plot;
}

/// The stages on vectors, one sheet each, over the pale log picture.
std::vector<std::pair<std::string, figure::Drawing>> vector_sheets(const sketch::TraceResult& trace,
                                                                   const sketch::Stage* log) {
  std::vector<Sheet> sheets(4, Sheet(trace.width, trace.height));
  for (Sheet& sheet : sheets)
    if (log) sheet.picture(log->picture, 0.35);
  for (std::size_t i = 0; i < trace.strokes.size(); ++i) {
    const Stroke& stroke = trace.strokes[i];
    const figure::Color color = figure::palette(i);
    sheets[0].dots(stroke.points, figure::with_alpha(figure::kSoftInk, 0.6), 1);
    for (std::size_t k = 0; k < stroke.axes.size(); ++k)
      sheets[0].line({stroke.axes[k][0], stroke.axes[k][1]}, figure::palette(k % 2), 1.6);
    sheets[1].line(stroke.segments, color, 1.4, stroke.closed);
    sheets[1].dots(stroke.segments, color, 4);
    draw_pieces(sheets[2], stroke.quadratics, color, false);
    draw_pieces(sheets[3], stroke.curve, color, true);
  }
  return {{"07-groups", sheets[0].drawing()},
          {"08-segments", sheets[1].drawing()},
          {"09-quadratics", sheets[2].drawing()},
          {"10-quintics", sheets[3].drawing()}};
}

using Picture = std::pair<std::string, std::string>;

Result<Picture> encoded(const std::string& name, const figure::Drawing& drawing, double scale) {
  auto png = figure::write_png(drawing, scale);
  if (!png) return std::unexpected(png.error());
  return Picture{name + ".png", std::move(*png)};
}

/// The stages on pixels, and the log picture among them.
std::vector<std::pair<std::string, figure::Drawing>> raster_sheets(
    const std::vector<sketch::Stage>& stages, const sketch::Stage*& log) {
  static constexpr std::array<std::pair<const char*, const char*>, 5> kNames = {
      {{"log", "01-log"},
       {"binary", "03-binary"},
       {"smoothed", "04-smoothed"},
       {"edges", "05-edges"},
       {"lines", "06-lines"}}};
  std::vector<std::pair<std::string, figure::Drawing>> all;
  for (const sketch::Stage& stage : stages) {
    if (stage.name == "log") log = &stage;
    Sheet sheet(stage.picture.width, stage.picture.height);
    sheet.picture(stage.picture, 1);
    for (const auto& [name, file] : kNames)
      if (stage.name == name) all.emplace_back(file, sheet.drawing());
  }
  return all;
}

}  // namespace

Result<std::vector<Picture>> stage_pictures(const operations::Outcome& outcome) {
  const auto& answer = *outcome.result_as<operations::SketchAnswer>();
  const sketch::TraceResult& trace = answer.trace;
  // large pictures are shown at half size and less: 4 megapixels are enough to see
  const double size = static_cast<double>(trace.width) * trace.height;
  const double scale = size > 4e6 ? std::sqrt(4e6 / size) : 1;
  const sketch::Stage* log = nullptr;
  auto sheets = raster_sheets(answer.pictures, log);
  for (auto& sheet : vector_sheets(trace, log)) sheets.push_back(std::move(sheet));
  std::vector<std::pair<std::string, figure::Plot>> plots;
  if (log) plots.emplace_back("02-histogram", histogram(*log));
  plots.emplace_back("11-curvature",
                     profiles(trace.strokes.front(), "Curvature", "1/pixel", curvature_of));
  plots.emplace_back("12-derivative",
                     profiles(trace.strokes.front(), "First derivative", "pixels", speed_of));
  std::vector<Picture> all;
  const auto add = [&](Result<Picture> picture) {
    if (picture) all.push_back(std::move(*picture));
    return picture ? Result<void>{} : std::unexpected(picture.error());
  };
  for (const auto& [name, drawing] : sheets)
    if (auto done = add(encoded(name, drawing, scale)); !done) return std::unexpected(done.error());
  for (const auto& [name, plot] : plots)
    if (auto done = add(encoded(name, figure::draw(plot), 1.5)); !done)
      return std::unexpected(done.error());
  return all;
}

}  // namespace keyline::presentation
