// lac_figures FOLDER: the figures of docs/log-aesthetic-curves.md as SVG in FOLDER.
#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "keyline/core/angle.h"
#include "keyline/figure/drawing.h"
#include "keyline/figure/plot.h"
#include "keyline/lac/g2/spline.h"
#include "keyline/lac/hermite/compound.h"
#include "keyline/lac/hermite/hermite.h"
#include "keyline/lac/hermite/region.h"
#include "keyline/lac/space/space_hermite.h"

#include "scene.h"

namespace {

using namespace keyline;
using core::Point2;
using docs::handles;
using docs::number;
using docs::Scene;
using docs::value;
using figure::Drawing;

// ---- The figures --------------------------------------------------------------------------

const std::vector<Point2> kTriangle{{0, 0}, {0.42, 1.05}, {2.2, 0.75}};

/// One triangle, every slope that meets it.
Drawing family() {
  Scene scene{"One triangle, many slopes", {handles(kTriangle)}, kTriangle};
  int i = 0;
  for (const double alpha : {-1.0, -0.4, 0.5, 1.4, 2.0}) {
    const auto solved = lac::solve_g1(kTriangle[0], kTriangle[1], kTriangle[2], alpha);
    if (!solved) continue;
    scene.lines.push_back({"slope " + number(alpha), sample(solved->segment, 200),
                           figure::palette(static_cast<std::size_t>(i++))});
  }
  return draw(scene);
}

/// Straight lines of the graph: log10 of radius from 0 to 1, two slopes meeting in the middle.
Drawing types() {
  std::vector<Drawing> charts;
  struct Type {
    const char* name;
    double first, second;
  };
  for (const Type& t : {Type{"(a) slope negative", -1, -1}, Type{"(b) slope zero", 0, 0},
                        Type{"(c) slope positive", 1, 1}, Type{"(d) minus, then plus", -1, 1.5},
                        Type{"(e) plus, then minus", 1.5, -1}}) {
    figure::Plot plot;
    plot.title = t.name;
    plot.width = 240;
    plot.height = 210;
    plot.x = {"log ρ", figure::Scale::linear, 0.0, 1.0};
    plot.y = {"log(ρ ds/dρ)", figure::Scale::linear, -1.0, 1.0};
    plot.series.push_back(
        {.points = {{0, -0.5 * t.first}, {0.5, 0}, {1, 0.5 * t.second}}, .width = 2});
    charts.push_back(figure::draw(plot));
  }
  return figure::tile(charts, 3);
}

/// Chord angle over turning that slopes can have.
Drawing region() {
  figure::Plot plot;
  plot.title = "Drawable region";
  plot.subtitle = "a slope meets the triangles between its two lines; 1/2 is the circular arc";
  plot.x = {"turning θ, degrees", figure::Scale::linear, 0.0, 180.0};
  plot.y = {"chord angle ψ as a share of θ", figure::Scale::linear, 0.0, 1.0};
  int i = 0;
  for (const double alpha : {-4.0, -1.0, -0.3, 1.3, 2.0, 4.0}) {
    figure::Series high{.name = "slope " + number(alpha),
                        .color = figure::palette(static_cast<std::size_t>(i++)),
                        .width = 1.8};
    figure::Series low = high;
    low.name = "";
    for (int k = 1; k < 180; ++k) {
      const double theta = core::kPi * k / 180;
      const core::Interval psi = lac::drawable_region(alpha, theta);
      high.points.push_back({double(k), psi.high / theta});
      low.points.push_back({double(k), psi.low / theta});
    }
    plot.series.push_back(std::move(high));
    plot.series.push_back(std::move(low));
  }
  return figure::draw(plot);
}

/// The compound curve and its evolute; a corner of the evolute would be a jump in the rate.
Drawing compound(double alpha0, double alpha1, double ratio) {
  Scene scene{"slopes " + number(alpha0) + ", " + number(alpha1) + ", ratio " + number(ratio),
              {handles(kTriangle)},
              {}};
  scene.width = 330;
  scene.height = 300;
  scene.room = 0.7;
  const auto solved =
      lac::solve_compound(kTriangle[0], kTriangle[1], kTriangle[2], {alpha0, alpha1, ratio});
  if (!solved) {
    scene.title += ": undrawable";
    return draw(scene);
  }
  const double joint = breakpoints(solved->chain)[1];
  std::vector<Point2> curve[2], evolute[2];
  for (int i = 0; i <= 400; ++i) {
    const double t = i / 400.0;
    const curve::Jet2 j = jet(solved->chain, t);
    curve[t < joint ? 0 : 1].push_back(j.point);
    const Point2 centre = centre_of_curvature(j);
    evolute[t < joint ? 0 : 1].push_back(centre);
  }
  for (int k = 0; k < 2; ++k) {
    scene.lines.push_back({"", curve[k], figure::palette(static_cast<std::size_t>(k)), 2.2});
    scene.lines.push_back({"",
                           evolute[k],
                           lighter(figure::palette(static_cast<std::size_t>(k)), 0.3),
                           1.2,
                           {},
                           false});
  }
  scene.marks = {solved->joint};
  return draw(scene);
}

Drawing compounds() {
  std::vector<Drawing> all;
  for (const auto& [a0, a1] : {std::pair{-1.0, 1.5}, {1.5, -1.0}, {-1.0, 0.5}, {0.5, 2.0}})
    all.push_back(compound(a0, a1, 0.5));
  return figure::tile(all, 2);
}

Drawing ratios() {
  std::vector<Drawing> all;
  for (const double ratio : {0.2, 0.4, 0.6, 0.8}) all.push_back(compound(-1, 1.5, ratio));
  return figure::tile(all, 2);
}

Drawing s_shapes() {
  Scene scene{"Through an inflection: slopes below zero", {}, {{0, 0}, {3, 0.4}}};
  int i = 0;
  for (const double alpha : {-0.5, -1.0, -2.0, -6.0}) {
    const auto solved = value(lac::solve_g1_directions({{0, 0}, 0.9}, {{3, 0.4}, 0.7}, alpha));
    scene.lines.push_back({"slope " + number(alpha), sample(solved.segment, 200),
                           figure::palette(static_cast<std::size_t>(i++))});
  }
  return draw(scene);
}

Drawing spline() {
  const std::vector<Point2> points{{0, 0}, {1, 0.9}, {2.4, 1.2}, {4, 0.7}, {5.2, 0.9}, {6, 1.6}};
  const auto solved = value(lac::solve_spline(points));
  Scene scene{"A G2 spline of clothoids with its curvature comb", {}, points};
  scene.width = 640;
  std::vector<Point2> tips;
  for (int i = 0; i <= 240; ++i) {
    const curve::Jet2 j = jet(solved.chain, i / 240.0);
    const Point2 tip =
        j.point - 0.45 * curve::curvature(j) * core::perpendicular_left(unit_tangent(j));
    tips.push_back(tip);
    if (i % 4 == 0) scene.lines.push_back({"", {j.point, tip}, figure::kFrame, 0.7});
  }
  scene.lines.push_back({"", tips, figure::palette(1), 1});
  scene.lines.push_back({"", sample(solved.chain, 300), figure::palette(0), 2.2});
  return draw(scene);
}

/// Space curves between the same ends with the same tangents, from two sides.
Drawing space() {
  const lac::SpaceHermite data{{0, 0, 0}, {3, 0, 0}, {1, 1.2, 0.6}, {1, -0.1, -0.6}};
  Scene above{"From above (x, y)", {}, {{0, 0}, {3, 0}}};
  Scene front{"From the front (x, z)", {}, {{0, 0}, {3, 0}}};
  int i = 0;
  for (const auto& [alpha, omega] : {std::pair{-3.0, 0.0}, {-1.0, 0.0}, {-1.0, 1.0}, {-0.3, 0.0}}) {
    const auto solved = value(lac::solve_g1_space(data, alpha, -1, omega));
    const figure::Color color = figure::palette(static_cast<std::size_t>(i++));
    const std::string name = "α " + number(alpha) + ", ω " + number(omega);
    docs::Line x_y{name, {}, color};
    docs::Line x_z = x_y;
    for (const core::Point3 p : sample(solved.chain, 200)) {
      x_y.points.push_back({p.x, p.y});
      x_z.points.push_back({p.x, p.z});
    }
    above.lines.push_back(std::move(x_y));
    front.lines.push_back(std::move(x_z));
  }
  return figure::tile({draw(above), draw(front)}, 2);
}

void write(const std::string& folder, const char* name, const Drawing& drawing) {
  std::ofstream(folder + "/" + name) << figure::write_svg(drawing);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: lac_figures FOLDER\n");
    return 2;
  }
  write(argv[1], "lac-types.svg", types());
  write(argv[1], "lac-family.svg", family());
  write(argv[1], "lac-region.svg", region());
  write(argv[1], "lac-compound.svg", compounds());
  write(argv[1], "lac-ratio.svg", ratios());
  write(argv[1], "lac-s-shape.svg", s_shapes());
  write(argv[1], "lac-spline.svg", spline());
  write(argv[1], "lac-space.svg", space());
  return 0;
}
