// compound_figures FOLDER: [Compound]'s figures 1 to 8 from the code, as SVG in FOLDER.
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "keyline/core/angle.h"
#include "keyline/figure/drawing.h"
#include "keyline/figure/plot.h"
#include "keyline/lac/hermite/compound.h"
#include "keyline/lac/hermite/hermite.h"
#include "keyline/lac/quasi/quasi.h"

#include "scene.h"

namespace {

using namespace keyline;
using core::Point2;
using docs::handles;
using docs::Line;
using docs::Note;
using docs::number;
using docs::Scene;
using docs::value;
using figure::Drawing;

figure::Color color(int i) { return figure::palette(static_cast<std::size_t>(i)); }

std::string slopes_of(const lac::CompoundRhythm& r) {
  return number(r.alpha0) + ", " + number(r.alpha1);
}

lac::Chain segment_chain(const std::array<Point2, 3>& p, double alpha) {
  return lac::chain_of(value(lac::solve_g1(p[0], p[1], p[2], alpha)).segment);
}
lac::Chain compound_chain(const std::array<Point2, 3>& p, const lac::CompoundRhythm& rhythm) {
  return value(lac::solve_compound(p[0], p[1], p[2], rhythm)).chain;
}

Point2 meeting(const core::Pose2& a, const core::Pose2& b) {
  const core::Vector2 u = core::unit_vector(a.direction);
  const core::Vector2 v = core::unit_vector(b.direction);
  return a.position + (cross(b.position - a.position, v) / cross(u, v)) * u;
}

/// The pieces in two colours.
void add_pieces(const lac::Chain& chain, Scene& scene) {
  int i = 0;
  for (const lac::Segment& s : segments(chain))
    scene.lines.push_back({"", sample(s, 200), color(i++), 2.2});
}

// ---- Figure 1 -------------------------------------------------------------------------------

constexpr std::array<Point2, 3> kTriangle{{{0, 0}, {0.42, 1.05}, {2.2, 0.75}}};

/// log10 rho against log10(rho ds/drho).
Drawing graph_of(const lac::Chain& chain) {
  figure::Plot plot;
  plot.width = 200;
  plot.height = 170;
  plot.x.title = "log ρ";
  plot.y.title = "log(ρ ds/dρ)";
  figure::Series series{.width = 2};
  for (int i = 1; i < 200; ++i) {
    const double k = std::abs(curvature(chain, i / 200.0));
    const double rate = std::abs(curvature_rate(chain, i / 200.0));
    if (k > 0 && rate > 0) series.points.push_back({-std::log10(k), std::log10(k / rate)});
  }
  plot.series.push_back(std::move(series));
  return figure::draw(plot);
}

Drawing types() {
  std::vector<Drawing> curves;
  std::vector<Drawing> graphs;
  const auto add = [&](const std::string& name, const lac::Chain& chain) {
    Scene scene{name, {}, {}, 200, 130};
    add_pieces(chain, scene);
    curves.push_back(draw(scene));
    graphs.push_back(graph_of(chain));
  };
  for (const auto& [name, alpha] :
       {std::pair{"(a) slope −1", -1.0}, {"(b) slope 0", 0.0}, {"(c) slope 1", 1.0}})
    add(name, segment_chain(kTriangle, alpha));
  add("(d) slopes −1, 1.5", compound_chain(kTriangle, {-1, 1.5, 0.5}));
  add("(e) slopes 1.5, −1", compound_chain(kTriangle, {1.5, -1, 0.5}));
  curves.insert(curves.end(), graphs.begin(), graphs.end());
  return figure::tile(curves, 5);
}

// ---- Figure 2 -------------------------------------------------------------------------------

/// A segment of the standard form and its triangle.
Drawing standard(const char* title, double alpha, double lambda, const core::Interval& angles) {
  const lac::Segment s = value(lac::standard_segment(alpha, lambda, angles));
  const core::Pose2 start = s.start;
  const core::Pose2 end = end_pose(s);
  Scene scene{title, {}, {start.position, meeting(start, end), end.position}, 330, 260};
  scene.lines.push_back(handles(scene.marks));
  const double end_of_form = 1 / ((1 - alpha) * lambda);  // tangent angle of the flex or cusp
  core::Interval shown{angles.low - 0.5, angles.high + 0.35};
  if (alpha < 1) shown.high = std::min(shown.high, end_of_form - 0.02);
  if (alpha > 1) shown.low = std::max(shown.low, end_of_form + 0.02);
  scene.lines.push_back({"",
                         sample(value(lac::standard_segment(alpha, lambda, shown)), 300),
                         figure::kFrame,
                         1,
                         {},
                         false});
  scene.lines.push_back({"", sample(s, 200), color(0), 2.2});
  scene.notes = {{scene.marks[0], "P0"}, {scene.marks[1], "P1"}, {scene.marks[2], "P2"}};
  return draw(scene);
}

Drawing standard_forms() {
  const lac::Segment given = value(lac::solve_g1({0, 0}, {0.42, 1.05}, {2.2, 0.75}, -1)).segment;
  Scene scene{"Given: Pa, Pb, Pc",
              {handles({kTriangle.begin(), kTriangle.end()})},
              {kTriangle.begin(), kTriangle.end()},
              330,
              260};
  scene.lines.push_back({"", sample(given, 200), color(0), 2.2});
  scene.notes = {{kTriangle[0], "Pa", {9, 8}}, {kTriangle[1], "Pb"}, {kTriangle[2], "Pc"}};
  const double theta = total_turning(given) < 0 ? -total_turning(given) : total_turning(given);
  return figure::tile({draw(scene), standard("(a) α ≤ 1: ρ = 1 at P0", -1, 0.25, {0, theta}),
                       standard("(b) α > 1: ρ = 1 at P2", 2, 0.5, {-theta, 0})},
                      3);
}

// ---- Figure 3 -------------------------------------------------------------------------------

Drawing joined_lines() {
  figure::Plot plot;
  plot.title = "Two segments joined at P";
  plot.subtitle = "same ρ, and Λ1 = Λ0 ρ^(α1 − α0)";
  plot.width = 420;
  plot.height = 280;
  plot.x = {"log ρ", figure::Scale::linear, 0.0, 1.0};
  plot.y = {"log(ρ ds/dρ)", figure::Scale::linear, 0.0, 1.2};
  const auto line = [&](double slope, double from, double to, int i, std::vector<double> dash) {
    plot.series.push_back(
        {.name = dash.empty() ? "slope " + number(slope) : "",
         .points = {{from, 0.4 + slope * (from - 0.45)}, {to, 0.4 + slope * (to - 0.45)}},
         .color = color(i),
         .width = dash.empty() ? 2.2 : 1,
         .dash = dash,
         .sets_range = false});
  };
  line(-0.8, 0, 0.45, 0, {});
  line(-0.8, 0.45, 1, 0, {3, 3});
  line(1.2, 0.45, 1, 1, {});
  line(1.2, 0, 0.45, 1, {3, 3});
  plot.notes.push_back({.at = {0.45, 0.4}, .text = "P", .offset = {-4, 18}});
  return figure::draw(plot);
}

// ---- Figures 4 and 5 ------------------------------------------------------------------------

Drawing handles_figure() {
  const lac::Chain chain = compound_chain(kTriangle, {-1, 1.5, 0.4});
  const auto poses = joints(chain);
  Scene scene{"θ0 = r θ at the joint, r = 0.4",
              {handles({kTriangle.begin(), kTriangle.end()})},
              {kTriangle.begin(), kTriangle.end()},
              420,
              300};
  const Point2 first = meeting(poses[0], poses[1]);
  const Point2 second = meeting(poses[1], poses[2]);
  scene.lines.push_back({"", {first, second}, figure::kRaw, 1, {3, 3}});
  add_pieces(chain, scene);
  scene.marks.push_back(poses[1].position);
  scene.notes = {{kTriangle[0], "a0", {9, 8}},
                 {kTriangle[1], "a1"},
                 {kTriangle[2], "a2"},
                 {core::mix(poses[0].position, poses[1].position, 0.5), "α0", {10, 12}},
                 {core::mix(poses[1].position, poses[2].position, 0.5), "α1", {0, 14}}};
  return draw(scene);
}

/// The chain moved so that the reference point has radius 1 and lies at the origin along x.
Drawing configuration(const char* title, const lac::CompoundRhythm& rhythm, bool at_joint) {
  const lac::Chain chain = compound_chain(kTriangle, rhythm);
  const auto poses = joints(chain);
  const core::Pose2 reference = poses[at_joint ? 1 : 0];
  const double bend = at_joint ? chain.pieces[0].curvature_end : chain.pieces[0].curvature_start;
  const auto placed = [&](Point2 p) {
    const core::Vector2 v =
        std::abs(bend) * core::rotate_ccw(p - reference.position, -reference.direction);
    return Point2{v.x, bend < 0 ? -v.y : v.y};
  };
  Scene scene{title, {}, {}, 400, 280};
  int i = 0;
  for (const lac::Segment& s : segments(chain)) {
    Line line{"", {}, color(i++), 2.2};
    for (const Point2 p : sample(s, 200)) line.points.push_back(placed(p));
    scene.lines.push_back(std::move(line));
  }
  const std::array<Point2, 6> p{poses[0].position, meeting(poses[0], poses[1]),
                                poses[1].position, meeting(poses[1], poses[2]),
                                poses[2].position, meeting(poses[0], poses[2])};
  for (int k = 0; k < 6; ++k) {
    scene.marks.push_back(placed(p[static_cast<std::size_t>(k)]));
    const core::Vector2 beside = k == 1   ? core::Vector2{-17, 12}
                                 : k == 2 ? core::Vector2{9, 11}
                                          : core::Vector2{6, -6};
    scene.notes.push_back({scene.marks.back(), "p" + std::to_string(k), beside});
  }
  scene.lines.push_back(handles({scene.marks[0], scene.marks[5], scene.marks[4]}));
  scene.lines.push_back(handles({scene.marks[1], scene.marks[3]}));
  return draw(scene);
}

// ---- Figure 6 -------------------------------------------------------------------------------

/// The paper's construction: the curve of a Lambda0, from its own standard form.
lac::Chain constructed(const lac::CompoundRhythm& r, double theta, double lambda0) {
  const double first = r.turning_share * theta;
  const lac::Segment one = value(lac::standard_segment(r.alpha0, lambda0, {0, first}));
  const double rho = 1 / one.curvature_end;
  const double lambda1 = lambda0 * std::pow(rho, r.alpha1 - r.alpha0);
  const double from = (std::pow(rho, r.alpha1 - 1) - 1) / ((r.alpha1 - 1) * lambda1);
  const lac::Segment two =
      value(lac::standard_segment(r.alpha1, lambda1, {from, from + theta - first}));
  return {one.start, {piece_of(one), piece_of(two)}, false};
}

/// Angle of the chord at the start.
double chord_angle(const lac::Chain& chain) {
  return core::direction_of(end_pose(chain).position - chain.start.position) -
         chain.start.direction;
}

Drawing search() {
  const lac::CompoundRhythm rhythm{-1, 1.5, 0.5};
  const auto angles = value(lac::handle_angles({0, 0}, {0.9, 0}, {1.9, 1.5}));
  const std::vector<Point2> wanted{{0, 0}, {0.9, 0}, {1.9, 1.5}};
  std::vector<Drawing> all{draw(Scene{"given", {handles(wanted)}, wanted, 260, 230})};
  double low = 0;
  double high = 1 / (rhythm.turning_share * angles.turning * (1 - rhythm.alpha0));
  for (int step = 0; step < 40; ++step) {
    const double lambda = (low + high) / 2;
    const lac::Chain chain = constructed(rhythm, angles.turning, lambda);
    const bool short_of = chord_angle(chain) < angles.chord_angle;
    (short_of ? low : high) = lambda;
    if (step > 3 && step < 39) continue;
    const double scale = angles.chord / distance(chain.start.position, end_pose(chain).position);
    const lac::Chain sized = transform(chain, {scale, 0, {}});
    const Point2 corner = meeting(sized.start, end_pose(sized));
    Scene scene{"Λ0 = " + number(lambda), {handles(wanted)}, {}, 260, 230};
    add_pieces(sized, scene);
    scene.lines.push_back({"", {{0, 0}, corner, end_pose(sized).position}, figure::kInk, 1});
    all.push_back(draw(scene));
  }
  return figure::tile(all, 3);
}

// ---- Figures 7 and 8 ------------------------------------------------------------------------

Drawing with_evolute(const std::array<Point2, 3>& p, const lac::CompoundRhythm& rhythm) {
  Scene scene{slopes_of(rhythm) + "; r = " + number(rhythm.turning_share),
              {handles({p.begin(), p.end()})},
              {},
              250,
              230};
  scene.room = 0.7;
  const auto solved = lac::solve_compound(p[0], p[1], p[2], rhythm);
  if (!solved) {
    scene.title += ": none";
    return draw(scene);
  }
  add_pieces(solved->chain, scene);
  const double joint = breakpoints(solved->chain)[1];
  for (int k = 0; k < 2; ++k) {
    Line centres{"", {}, lighter(color(k), 0.3), 1.2, {}, false};
    for (int i = 0; i <= 200; ++i) {
      const double t = k == 0 ? joint * i / 200 : joint + (1 - joint) * i / 200;
      centres.points.push_back(centre_of_curvature(jet(solved->chain, t)));
    }
    scene.lines.push_back(std::move(centres));
  }
  scene.marks = {solved->joint};
  return draw(scene);
}

Drawing compounds(const std::array<Point2, 3>& p, const std::vector<lac::CompoundRhythm>& rhythms) {
  std::vector<Drawing> all;
  for (const lac::CompoundRhythm& r : rhythms) all.push_back(with_evolute(p, r));
  return figure::tile(all, 4);
}

void write(const std::string& folder, const char* name, const Drawing& drawing) {
  std::ofstream(folder + "/" + name) << figure::write_svg(drawing);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: compound_figures FOLDER\n");
    return 2;
  }
  const std::string folder = argv[1];
  write(folder, "compound-1-types.svg", types());
  write(folder, "compound-2-standard-forms.svg", standard_forms());
  write(folder, "compound-3-graph.svg", joined_lines());
  write(folder, "compound-4-handles.svg", handles_figure());
  write(folder, "compound-5-configurations.svg",
        figure::tile({configuration("(a) α0 ≤ 1: ρ = 1 at p0", {-1, 1.5, 0.5}, false),
                      configuration("(b) α0 > 1: ρ = 1 at p2", {1.5, -1, 0.5}, true)},
                     2));
  write(folder, "compound-6-search.svg", search());
  write(folder, "compound-7-evolutes.svg",
        compounds(kTriangle, {{-1, 1.5, 0.3},
                              {-1, 1.5, 0.7},
                              {1.5, -1, 0.3},
                              {1.5, -1, 0.7},
                              {-0.5, 0.5, 0.5},
                              {0.5, -0.5, 0.5},
                              {-1, 2, 0.5},
                              {2, -1, 0.5}}));
  write(folder, "compound-8-evolutes.svg",
        compounds({{{0, 0}, {0.85, 0}, {1.5, 1.1}}}, {{-1, -0.3, 0.5},
                                                      {0.5, 2, 0.5},
                                                      {-0.5, 1, 0.5},
                                                      {1, -0.5, 0.5},
                                                      {-0.3, -1, 0.5},
                                                      {2, 0.5, 0.5},
                                                      {0, 1.5, 0.3},
                                                      {1.5, 0, 0.3}}));
  return 0;
}
