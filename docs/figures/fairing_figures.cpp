// fairing_figures FOLDER: [Fairing]'s figures 2, 5, 7, 8 and 15 to 18 from the code, as SVG in
// FOLDER.
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "keyline/analysis/lddc.h"
#include "keyline/figure/drawing.h"
#include "keyline/figure/plot.h"
#include "keyline/lac/hermite/compound.h"
#include "keyline/lac/hermite/hermite.h"

#include "scene.h"

namespace {

using namespace keyline;
using core::Point2;
using docs::number;
using docs::Scene;
using docs::value;
using figure::Drawing;

constexpr std::array<Point2, 3> kTriangle{{{0, 0}, {0.42, 1.05}, {2.2, 0.75}}};

figure::Color color(int i) { return figure::palette(static_cast<std::size_t>(i)); }

lac::Chain segment_chain(double alpha, const std::array<Point2, 3>& p = kTriangle) {
  return lac::chain_of(value(lac::solve_g1(p[0], p[1], p[2], alpha)).segment);
}
lac::Chain compound_chain(double first, double second) {
  return value(lac::solve_compound(kTriangle[0], kTriangle[1], kTriangle[2], {first, second, 0.5}))
      .chain;
}
lac::Chain piece(double alpha, double length, double from, double to) {
  return {{{0, 0}, 0.6}, {{alpha, length, from, to}}};
}

Drawing picture(const std::string& name, const lac::Chain& chain, double width = 200) {
  Scene scene{name, {{"", sample(chain, 300), color(0), 2.2}}, {}, width, 130};
  scene.marks = {scene.lines[0].points.front(), scene.lines[0].points.back()};
  return draw(scene);
}

analysis::Lddc diagram(const lac::Chain& chain) {
  return analysis::curvature_distribution_diagram(analysis::curvature_profile(chain));
}

figure::Series c_curve(const analysis::Lddc& lddc, int i, const std::string& name = "") {
  figure::Series line{.name = name, .color = color(i), .width = 2};
  for (const analysis::LddcTop& top : lddc.c_curve) line.points.push_back({top.x, top.y});
  return line;
}

std::string rounded(double x) { return number(std::round(1000 * x) / 1000 + 0.0); }

/// The papers' picture: bars of length by radius, and the C curve over their tops.
Drawing bars_of(const lac::Chain& chain, double width = 200) {
  const analysis::Lddc lddc = diagram(chain);
  figure::Plot plot{.width = width, .height = 180};
  if (chain.pieces.size() == 1 && lddc.has_gradient)
    plot.title = "gradient " + rounded(lddc.gradient);
  plot.x.title = "log(ρ / length)";
  plot.y.title = "log(share)";
  figure::Series bars{.kind = figure::SeriesKind::bars, .color = figure::kFrame};
  bars.bar_width = analysis::kLddcBarWidth;
  for (const analysis::LddcBar& bar : lddc.bars)
    if (bar.count > 0) bars.points.push_back({bar.low + 0.5 * analysis::kLddcBarWidth, bar.height});
  if (bars.points.size() ==
      1) {  // of an arc: all of the length, log 1 = 0 high; no range of its own
    plot.title = "one bar";
    plot.x.low = bars.points[0].x - 0.4;
    plot.x.high = bars.points[0].x + 0.4;
    plot.y.low = -2;
    plot.y.high = 0;
  }
  plot.series = {std::move(bars), c_curve(lddc, 1)};
  return figure::draw(plot);
}

/// Figure 8: the five rhythms.
Drawing rhythms() {
  const std::vector<std::pair<const char*, lac::Chain>> shown{
      {"minus: slope −1", segment_chain(-1)},
      {"zero: slope 0", segment_chain(0)},
      {"plus: slope 1", segment_chain(1)},
      {"plus, minus: 1.5, −1", compound_chain(1.5, -1)},
      {"minus, plus: −1, 1.5", compound_chain(-1, 1.5)}};
  std::vector<Drawing> drawn;
  for (const auto& [name, chain] : shown) drawn.push_back(picture(name, chain));
  for (const auto& [name, chain] : shown) drawn.push_back(bars_of(chain));
  return figure::tile(drawn, 5);
}

/// Figure 2: fuller and flatter, and what the diagram makes of it.
Drawing volumes() {
  figure::Plot plot{.width = 330, .height = 260};
  plot.title = "Distance of the C curve's ends";
  plot.x.title = "log(ρ / length)";
  plot.y.title = "log(share)";
  Scene scene{"Slope −1 over one chord", {}, {}, 330, 260};
  int i = 0;
  for (const double height : {0.4, 0.7, 1.0}) {
    const lac::Chain chain = segment_chain(-1, {{{0, 0}, {0.7, height}, {2, 0}}});
    const analysis::Lddc lddc = diagram(chain);
    scene.lines.push_back({"handle at " + number(height), sample(chain, 300), color(i), 2.2});
    plot.series.push_back(c_curve(lddc, i, rounded(lddc.distance_ab)));
    ++i;
  }
  return figure::tile({draw(scene), figure::draw(plot)}, 2);
}

/// Figures 5 and 6: the gradient is the slope.
Drawing gradients() {
  figure::Plot plot{.width = 480, .height = 300};
  plot.x.title = "log(ρ / length)";
  plot.y.title = "log(share)";
  int i = 0;
  for (const double alpha : {-2.0, -1.0, 0.0, 1.0, 2.0}) {
    const analysis::Lddc lddc = diagram(piece(alpha, 1, 2, 0.2));
    plot.series.push_back(
        c_curve(lddc, i++, "α = " + number(alpha) + ": gradient " + rounded(lddc.gradient)));
  }
  return figure::draw(plot);
}

/// Figure 7: cut its beginning off, scale what remains along and across: the curve itself.
Drawing self_affinity() {
  const lac::Chain whole = piece(1, 4, 1, 0.2);
  const double cut = 1.0;  // of the length; the radius is linear: 1 + s
  const lac::Chain rest = piece(1, 3, 0.5, 0.2);
  Scene scene{
      "Slope 1, and without its first quarter",
      {{"whole", sample(whole, 300), color(0), 2.2}, {"rest", sample(rest, 300), color(1), 2.2}},
      {},
      330,
      260};
  figure::Plot plot{.width = 330, .height = 260};
  plot.title = "Diagrams have one gradient";
  plot.x.title = "log(ρ / length)";
  plot.y.title = "log(share)";
  plot.series = {c_curve(diagram(whole), 0, "whole"),
                 c_curve(diagram(rest), 1, "rest, from s = " + number(cut))};
  return figure::tile({draw(scene), figure::draw(plot)}, 2);
}

/// Figures 15 to 18: curves A to D of the car.
Drawing key_line() {
  // the bends of y = x^2 / 400 at 100 and 420: a parabola's curvature is 200^2 / (200^2 + x^2)^1.5
  const auto bend = [](double x) { return 4e4 / std::pow(4e4 + x * x, 1.5); };
  const lac::Chain bonnet = piece(2.0 / 3, 530, bend(100), bend(420));
  const std::vector<std::pair<const char*, lac::Chain>> curves{
      {"A, bonnet", bonnet},
      {"B, windscreen", piece(-1, 260, 1.0 / 900, 1.0 / 900)},
      {"C, roof", piece(-1, 230, 1.0 / 300, 1.0 / 1500)},
      {"D, roof", piece(-1, 260, 1.0 / 1500, 1.0 / 400)}};
  std::vector<Drawing> drawn;
  for (const auto& [name, chain] : curves) drawn.push_back(picture(name, chain, 250));
  for (const auto& [name, chain] : curves) drawn.push_back(bars_of(chain, 250));
  return figure::tile(drawn, 4);
}

void write(const std::string& folder, const std::string& name, const Drawing& drawing) {
  std::ofstream(folder + "/" + name) << figure::write_svg(drawing);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: fairing_figures FOLDER\n");
    return 2;
  }
  const std::string folder = argv[1];
  write(folder, "fairing-2-volume.svg", volumes());
  write(folder, "fairing-5-gradient.svg", gradients());
  write(folder, "fairing-7-self-affinity.svg", self_affinity());
  write(folder, "fairing-8-rhythms.svg", rhythms());
  write(folder, "fairing-15-key-line.svg", key_line());
  return 0;
}
