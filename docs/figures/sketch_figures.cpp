// sketch_figures FOLDER: the figures of docs/curvature-driven.md as SVG in FOLDER, its table on the
// standard output.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "keyline/curve/jet.h"
#include "keyline/exchange/image/image_reader.h"
#include "keyline/figure/plot.h"
#include "keyline/fit/curvature_drive.h"
#include "keyline/sketch/quintics.h"
#include "keyline/sketch/trace.h"

#include "scene.h"

namespace {

using namespace keyline;
using core::Point2;
using curve::Bezier2;
using docs::value;
using figure::Drawing;
using fit::CurvatureTarget;

using Pieces = std::vector<Bezier2>;

void save(const std::string& folder, const std::string& name, const Drawing& drawing) {
  std::ofstream(folder + "/" + name) << figure::write_svg(drawing);
}

// ---- The example of three segments --------------------------------------------------------

/// Four concatenated line segments, as a hand draws the roof of a car: three quadratics.
const std::vector<Point2> kRoof = {{0, 95}, {30, 47}, {85, 10}, {150, 0}, {215, 15}};

struct Wanted {
  const char* name;
  std::vector<CurvatureTarget> points;  ///< as clicked into the plot, per pixel
};

const std::vector<Wanted>& targets() {
  static const std::vector<Wanted> kTargets = {
      {"level", {{0, 0.005}, {1, 0.005}}},
      {"falling", {{0, 0.0065}, {0.5, 0.005}, {1, 0.0035}}},
      {"one swell", {{0, 0.003}, {0.25, 0.005}, {0.5, 0.006}, {0.75, 0.0057}, {1, 0.004}}},
      {"two swells",
       {{0, 0.0035}, {0.2, 0.006}, {0.45, 0.004}, {0.7, 0.006}, {0.9, 0.004}, {1, 0.0035}}},
      {"a step", {{0, 0.0035}, {0.49, 0.0035}, {0.51, 0.0065}, {1, 0.0065}}},
  };
  return kTargets;
}

Pieces roof(bool continuous) {
  Pieces pieces = sketch::elevated(sketch::quadratics(kRoof, false));
  if (continuous) sketch::make_curvature_continuous(pieces, false);
  return pieces;
}

double rms(const std::vector<CurvatureTarget>& points) {
  double sum = 0;
  for (const CurvatureTarget& t : points) sum += t.curvature * t.curvature;
  return std::sqrt(sum / static_cast<double>(points.size()));
}

void print_table() {
  std::printf("| target | joints | end | before | reached | steps | end moved |\n");
  std::printf("|---|---|---|---|---|---|---|\n");
  for (const Wanted& wanted : targets())
    for (const bool continuous : {false, true})
      for (const bool hold : {false, true}) {
        const auto r =
            value(fit::drive_curvature({roof(continuous), 0}, wanted.points, {.hold_end = hold}));
        const double size = rms(wanted.points);
        std::printf("| %s | %s | %s | %.1f %% | %.2f %% | %d | %.1f |\n", wanted.name,
                    continuous ? "G2" : "free", hold ? "held" : "free", 100 * r.before / size,
                    100 * r.after / size, r.iterations, r.end_moved);
      }
}

// ---- Figures ------------------------------------------------------------------------------

/// Curves with their curvature as hairs on the outer side, joints as dots.
Drawing combs(const std::string& title, const Pieces& pieces, double height, int hairs,
              double width, double page_height) {
  docs::Scene scene{title, {}, {}, width, page_height};
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const figure::Color color = figure::palette(k);
    std::vector<Point2> along;
    std::vector<Point2> tips;
    std::vector<Point2> teeth;
    for (int i = 0; i <= hairs; ++i) {
      const auto at = jet(pieces[k], static_cast<double>(i) / hairs);
      along.push_back(at.point);
      tips.push_back(at.point -
                     height * curvature(at) * core::perpendicular_left(unit_tangent(at)));
      teeth.insert(teeth.end(), {along.back(), tips.back(), along.back()});
    }
    scene.lines.push_back({"", teeth, figure::kFrame, 0.6});
    scene.lines.push_back({"", tips, color, 1});
    scene.lines.push_back({"", along, color, 2});
    scene.marks.push_back(along.front());
  }
  scene.marks.push_back(pieces.back().control.back());
  return draw(scene);
}

/// Curvature over the chain's parameter; the target dashed.
Drawing distribution(const std::string& title, const Pieces& pieces,
                     const std::vector<CurvatureTarget>& target, double width, double height) {
  figure::Plot plot;
  plot.title = title;
  plot.width = width;
  plot.height = height;
  plot.x.title = "parameter, an equal share per piece";
  plot.y.title = "curvature, 1/px";
  const auto n = static_cast<double>(pieces.size());
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    figure::Series part{.color = figure::palette(k)};
    for (int i = 0; i <= 48; ++i)
      part.points.push_back(
          {(static_cast<double>(k) + i / 48.0) / n, curvature(jet(pieces[k], i / 48.0))});
    plot.series.push_back(std::move(part));
    if (k > 0) plot.rules.push_back({.at = static_cast<double>(k) / n});
  }
  figure::Series wanted{.name = "specified", .color = figure::kInk, .width = 2, .dash = {2, 4}};
  for (const CurvatureTarget& t : target) wanted.points.push_back({t.t, t.curvature});
  if (!target.empty()) plot.series.push_back(std::move(wanted));
  return draw(plot);
}

/// [Sketch] Figs. 17 to 20, for a target that can be met and one that cannot.
void draw_example(const std::string& folder) {
  const Pieces before = roof(false);
  const auto& swell = targets()[2].points;
  const auto& step = targets()[4].points;
  const Pieces after = value(fit::drive_curvature({before, 0}, swell)).chain.pieces;
  const Pieces part = value(fit::drive_curvature({before, 0}, step)).chain.pieces;
  constexpr double kHairs = 4000;
  const auto combed = [&](const std::string& title, const Pieces& pieces) {
    return combs(title, pieces, kHairs, 32, 420, 240);
  };
  const auto plotted = [](const std::string& title, const Pieces& pieces, const auto& target) {
    return distribution(title, pieces, target, 420, 240);
  };
  save(folder, "sketch-17-driven.svg",
       figure::tile({combed("Three quintics from line segments", before),
                     plotted("Their curvature, and one specified", before, swell),
                     combed("Driven to it", after), plotted("Curvature reached", after, swell),
                     combed("Driven to a step", part), plotted("Curvature reached", part, step)},
                    2));
}

sketch::Stroke longest_line(const std::string& file, sketch::CurvatureAim aim) {
  sketch::TraceOptions options;
  options.curve.tolerance = 0;
  options.curve.aim = aim;
  return value(sketch::trace(value(exchange::read_image_file(file)), options)).strokes.front();
}

/// [Sketch] Figs. 22 to 25 on the drawing of the examples: its longest line.
void draw_sketch(const std::string& folder) {
  const std::string file = folder + "/../../examples/sketch.png";
  const sketch::Stroke stroke = longest_line(file, sketch::CurvatureAim::none);
  const sketch::Stroke driven = longest_line(file, sketch::CurvatureAim::smooth);
  docs::Scene segments{"Line segments along the longest line", {}, stroke.segments, 860, 250};
  segments.lines.push_back({"", stroke.points, figure::kRaw, 3});
  segments.lines.push_back({"", stroke.segments, figure::kInk, 1});
  std::printf(
      "\nlongest line: %zu line segments, curvature off its target %.4f before, %.4f after\n",
      stroke.segments.size() - 1, driven.driven->before, driven.driven->after);
  constexpr double kHairs = 500;
  const auto combed = [&](const std::string& title, const Pieces& pieces) {
    return combs(title, pieces, kHairs, 10, 860, 300);
  };
  save(folder, "sketch-22-car.svg",
       figure::stack(
           {draw(segments),
            combed("Quintics on them: curvature jumps", sketch::elevated(stroke.quadratics)),
            combed("Continuous by Eqs. 9 and 10, but for corners", stroke.curve),
            combed("Driven to its own curvature without the waves", driven.curve)}));
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) {
    std::fprintf(stderr, "usage: sketch_figures FOLDER\n");
    return 2;
  }
  print_table();
  draw_example(arguments[1]);
  draw_sketch(arguments[1]);
  return 0;
}
