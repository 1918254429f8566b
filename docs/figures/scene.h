#pragma once

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "keyline/core/error.h"
#include "keyline/figure/drawing.h"

/// Curves at one scale both ways, with names: what the programs of this folder share.
namespace keyline::docs {

template <class T>
T value(core::Result<T> result) {
  if (!result) throw core::InvalidInput(result.error().message + "; " + result.error().hint);
  return *std::move(result);
}

inline std::string number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", x);
  return text;
}

struct Line {
  std::string name;  ///< empty: not in the legend
  std::vector<core::Point2> points;
  figure::Color color = figure::kInk;
  double width = 1.8;
  std::vector<double> dash = {};
  bool fits = true;  ///< false: cut at the edge of the picture
};

struct Note {
  core::Point2 at;
  std::string text;
  core::Vector2 offset{6, -6};  ///< on the page, y down
};

struct Scene {
  std::string title;
  std::vector<Line> lines;
  std::vector<core::Point2> marks;
  double width = 480;
  double height = 320;
  std::vector<Note> notes = {};
  double room = 0;  ///< for other lines beyond what fits, as a share of its larger side
};

inline Line handles(const std::vector<core::Point2>& p) { return {"", p, figure::kRaw, 1, {3, 3}}; }

inline void add_legend(const Scene& scene, figure::Drawing& drawing) {
  double y = 40;
  for (const Line& line : scene.lines) {
    if (line.name.empty()) continue;
    drawing.add(figure::Shape{.path = figure::polyline(std::vector<core::Point2>{{12, y}, {34, y}}),
                              .stroke = figure::Stroke{line.color, line.width, line.dash}});
    drawing.add(figure::Label{
        .at = {40, y}, .text = line.name, .size = 11.5, .baseline = figure::Baseline::middle});
    y += 16;
  }
}

inline figure::Drawing draw(const Scene& scene) {
  figure::Drawing drawing;
  drawing.width = scene.width;
  drawing.height = scene.height;
  drawing.title = scene.title;
  figure::Box model;
  double names = 0;
  for (const Line& line : scene.lines) {
    names = std::max(names, figure::text_width(line.name, 11.5));
    if (!line.fits) continue;
    for (const core::Point2 p : line.points) include(model, p);
  }
  const figure::Box near =
      grown(model, scene.room * std::max(figure::width(model), figure::height(model)));
  for (const Line& line : scene.lines)
    for (const core::Point2 p : line.points)
      if (p.x > near.min.x && p.x < near.max.x && p.y > near.min.y && p.y < near.max.y)
        include(model, p);
  const figure::Box page{{names > 0 ? names + 56 : 16, 36},
                         {scene.width - (scene.notes.empty() ? 16 : 36), scene.height - 16}};
  const figure::Viewport view = fit_viewport(model, page);
  drawing.add(figure::Label{.at = {12, 22}, .text = scene.title, .size = 14, .bold = true});
  for (const Line& line : scene.lines)
    for (const auto& run : figure::clip_to_box(to_page(view, line.points), page))
      drawing.add(figure::Shape{.path = figure::polyline(run),
                                .stroke = figure::Stroke{line.color, line.width, line.dash}});
  if (!scene.marks.empty())
    drawing.add(figure::Marks{.points = to_page(view, scene.marks), .size = 5});
  for (const Note& note : scene.notes)
    drawing.add(figure::Label{
        .at = to_page(view, note.at) + note.offset, .text = note.text, .size = 11.5, .halo = 2});
  add_legend(scene, drawing);
  return drawing;
}

}  // namespace keyline::docs
