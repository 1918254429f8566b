#include "keyline/presentation/sketch_overlay.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "keyline/figure/drawing.h"
#include "keyline/figure/label_places.h"
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
};

/// Names of lines and numbers of strokes, where they cover each other least.
class Names {
 public:
  explicit Names(Canvas& canvas)
      : canvas_(canvas), places_(canvas.drawing.width, canvas.drawing.height) {}

  void avoid(const std::vector<Point2>& line) {
    places_.avoid(figure::to_page(canvas_.view, line));
  }

  /// Beside one of the points, earlier ones preferred.
  void add(const std::vector<Point2>& beside, const std::string& text, figure::Color color,
           bool bold) {
    const double size = bold ? 1.3 * kText : kText;
    const auto place = places_.take(figure::to_page(canvas_.view, beside),
                                    figure::text_width(text, size, bold) + 2 * kHalo, size);
    const std::array leader = {place.named, place.middle};
    if (place.away)
      canvas_.drawing.add(figure::Shape{figure::polyline(leader, false),
                                        figure::Stroke{figure::with_alpha(color, 0.6), 0.7, {}},
                                        {}});
    canvas_.drawing.add(figure::Label{.at = place.middle,
                                      .text = text,
                                      .size = size,
                                      .color = color,
                                      .anchor = figure::Anchor::middle,
                                      .baseline = figure::Baseline::middle,
                                      .bold = bold,
                                      .halo = kHalo});
  }

 private:
  static constexpr double kHalo = 2;
  Canvas& canvas_;
  figure::LabelPlaces places_;
};

/// Points of a line beside which its name can stand: its middle, then in turn on both sides of it.
std::vector<Point2> places_along(const std::vector<Point2>& line) {
  constexpr std::array kShares = {0.5, 0.35, 0.65, 0.2, 0.8, 0.05, 0.95};
  std::vector<Point2> places;
  for (const double share : kShares)
    places.push_back(line[static_cast<std::size_t>(share * static_cast<double>(line.size()))]);
  return places;
}

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

struct Name {
  std::vector<Point2> line;
  std::string text;
  figure::Color color;
};

/// Draws the strokes; their numbers come back.
std::vector<Name> add_strokes(Canvas& canvas, const sketch::TraceResult& trace) {
  std::vector<Name> numbers;
  const std::vector<std::size_t> line = lines_of(trace);
  const double pen = trace.width > 0 ? 1 : canvas.view.scale * trace.strokes.front().width;
  const auto color = [&](std::size_t i) {
    return line[i] < trace.strokes.size() ? figure::palette(line[i]) : figure::kSoftInk;
  };
  for (std::size_t i = 0; i < trace.passes.size(); ++i)
    canvas.line(trace.passes[i].points, trace.passes[i].closed, figure::with_alpha(color(i), 0.3),
                std::max(1.0, pen));
  for (std::size_t i = 0; i < trace.passes.size(); ++i)
    if (!trace.passes[i].points.empty() && trace.passes.size() <= kMostNumbers)
      numbers.push_back({trace.passes[i].points, std::to_string(i), color(i)});
  return numbers;
}

/// Chords of a piece, so short that none is seen: a long one of few would leave the ink.
int steps_of(const curve::Bezier2& piece, double scale) {
  constexpr double kChord = 4;  ///< pixels
  double length = 0;
  for (std::size_t i = 1; i < piece.control.size(); ++i)
    length += core::distance(piece.control[i - 1], piece.control[i]);
  return static_cast<int>(std::clamp(std::ceil(scale * length / kChord), 8.0, 4000.0));
}

/// Draws the lines; their names come back.
std::vector<Name> add_lines(Canvas& canvas, const sketch::TraceResult& trace) {
  std::vector<Name> names;
  for (std::size_t i = 0; i < trace.strokes.size(); ++i) {
    std::vector<Point2> points;
    for (const curve::Bezier2& piece : trace.strokes[i].curve)
      for (int k = 0, n = steps_of(piece, canvas.view.scale); k <= n; ++k)
        points.push_back(evaluate(piece, static_cast<double>(k) / n));
    if (points.empty()) continue;
    canvas.line(points, false, figure::palette(i), 1.6);
    names.push_back({std::move(points), "stroke" + std::to_string(i + 1), figure::palette(i)});
  }
  return names;
}

/// Lines' names stand beside them anywhere, strokes' numbers at their first points.
void add_names(Canvas& canvas, const std::vector<Name>& lines, const std::vector<Name>& strokes) {
  Names names(canvas);
  for (const Name& line : lines) names.avoid(line.line);
  for (const Name& stroke : strokes) names.avoid(stroke.line);
  for (const Name& line : lines) names.add(places_along(line.line), line.text, line.color, true);
  for (const Name& stroke : strokes)
    names.add({stroke.line.front()}, stroke.text, stroke.color, false);
}

}  // namespace

core::Result<std::string> overlay_picture(const operations::Outcome& outcome) {
  const auto& answer = *outcome.result_as<operations::SketchAnswer>();
  Canvas canvas = canvas_over(area_of(answer.trace));
  add_ink(canvas, answer);
  const std::vector<Name> strokes = add_strokes(canvas, answer.trace);
  const std::vector<Name> lines = add_lines(canvas, answer.trace);
  add_names(canvas, lines, strokes);
  return figure::write_png(canvas.drawing, 1);
}

}  // namespace keyline::presentation
