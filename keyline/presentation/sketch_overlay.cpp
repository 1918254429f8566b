#include "keyline/presentation/sketch_overlay.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "keyline/figure/drawing.h"
#include "keyline/figure/path.h"
#include "keyline/figure/plot.h"
#include "keyline/operations/sketch_trace.h"

namespace keyline::presentation {
namespace {

using core::Point2;

constexpr double kSide = 1600;  ///< pixels of the longer side, at least
constexpr double kMostPixels = 16e6;
constexpr double kPale = 0.6;              ///< of the ink's darkness is left
constexpr std::size_t kMostNumbers = 400;  ///< of strokes: more would hide the drawing
constexpr double kText = 11;
constexpr double kRim = 0.03;  ///< of the size of drawn strokes

/// What is drawn on: model coordinates (y up) to pixels.
struct Canvas {
  figure::Drawing drawing;
  figure::Viewport view;

  void line(const std::vector<Point2>& points, bool closed, figure::Color color, double width) {
    drawing.add(figure::Shape{figure::polyline(figure::to_page(view, points), closed),
                              figure::Stroke{color, width, {}},
                              {}});
  }
  void number(Point2 at, const std::string& text, figure::Color color, bool bold) {
    drawing.add(figure::Label{.at = figure::to_page(view, at),
                              .text = text,
                              .size = bold ? 1.3 * kText : kText,
                              .color = color,
                              .bold = bold,
                              .halo = 2});
  }
};

/// Of a picture its page, of drawn strokes what they reach over and a rim.
figure::Box area_of(const sketch::TraceResult& trace) {
  if (trace.width > 0) return {{0, 0}, {double(trace.width), double(trace.height)}};
  figure::Box box;
  for (const sketch::DrawnStroke& pass : trace.passes)
    for (const Point2 p : pass.points) figure::include(box, p);
  return figure::grown(box, kRim * core::distance(box.min, box.max));
}

Canvas canvas_over(const figure::Box& area) {
  const core::Vector2 size = area.max - area.min;
  const double longer = std::max(size.x, size.y);
  const double scale =
      longer > kSide ? std::min({1.0, std::sqrt(kMostPixels / (size.x * size.y))}) : kSide / longer;
  Canvas canvas;
  canvas.drawing.width = std::max(1.0, std::round(scale * size.x));
  canvas.drawing.height = std::max(1.0, std::round(scale * size.y));
  canvas.view = {scale, Point2{-scale * area.min.x, scale * area.max.y}};
  return canvas;
}

void add_ink(Canvas& canvas, const operations::SketchAnswer& answer) {
  const auto log = std::ranges::find(answer.pictures, "log", &sketch::Stage::name);
  if (log == answer.pictures.end()) return;
  figure::Picture picture{{{0, 0}, {canvas.drawing.width, canvas.drawing.height}},
                          log->picture.width,
                          log->picture.height,
                          {},
                          {}};
  for (const std::uint8_t v : log->picture.data)
    picture.rgb.insert(picture.rgb.end(), 3, static_cast<std::uint8_t>(255 - kPale * (255 - v)));
  canvas.drawing.add(std::move(picture));
}

/// By number of a stroke, the line that stands for it; the count of lines where none does.
std::vector<std::size_t> lines_of(const sketch::TraceResult& trace) {
  std::vector<std::size_t> line(trace.passes.size(), trace.strokes.size());
  for (std::size_t i = 0; i < trace.strokes.size(); ++i)
    for (const std::size_t m : trace.strokes[i].members)
      if (m < line.size()) line[m] = i;
  return line;
}

void add_strokes(Canvas& canvas, const sketch::TraceResult& trace) {
  const std::vector<std::size_t> line = lines_of(trace);
  const double pen = trace.width > 0 ? 1 : canvas.view.scale * trace.strokes.front().width;
  const auto color = [&](std::size_t i) {
    return line[i] < trace.strokes.size() ? figure::palette(line[i]) : figure::kSoftInk;
  };
  for (std::size_t i = 0; i < trace.passes.size(); ++i)
    canvas.line(trace.passes[i].points, trace.passes[i].closed, figure::with_alpha(color(i), 0.3),
                std::max(1.0, pen));
  if (trace.passes.size() > kMostNumbers) return;
  for (std::size_t i = 0; i < trace.passes.size(); ++i)
    if (!trace.passes[i].points.empty())
      canvas.number(trace.passes[i].points.front(), std::to_string(i), color(i), false);
}

/// Chords of a piece, so short that none is seen: a long one of few would leave the ink.
int steps_of(const curve::Bezier2& piece, double scale) {
  constexpr double kChord = 4;  ///< pixels
  double length = 0;
  for (std::size_t i = 1; i < piece.control.size(); ++i)
    length += core::distance(piece.control[i - 1], piece.control[i]);
  return static_cast<int>(std::clamp(std::ceil(scale * length / kChord), 8.0, 4000.0));
}

void add_lines(Canvas& canvas, const sketch::TraceResult& trace) {
  for (std::size_t i = 0; i < trace.strokes.size(); ++i) {
    std::vector<Point2> points;
    for (const curve::Bezier2& piece : trace.strokes[i].curve)
      for (int k = 0, n = steps_of(piece, canvas.view.scale); k <= n; ++k)
        points.push_back(evaluate(piece, static_cast<double>(k) / n));
    if (points.empty()) continue;
    canvas.line(points, false, figure::palette(i), 1.6);
    canvas.number(points[points.size() / 2], "stroke" + std::to_string(i + 1), figure::palette(i),
                  true);
  }
}

}  // namespace

core::Result<std::string> overlay_picture(const operations::Outcome& outcome) {
  const auto& answer = *outcome.result_as<operations::SketchAnswer>();
  Canvas canvas = canvas_over(area_of(answer.trace));
  add_ink(canvas, answer);
  add_strokes(canvas, answer.trace);
  add_lines(canvas, answer.trace);
  return figure::write_png(canvas.drawing, 1);
}

}  // namespace keyline::presentation
