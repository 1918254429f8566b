// surface_figures FOLDER: the figures of docs/guide/surfaces.md as PNG and SVG in FOLDER, its
// tables on the standard output.
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "keyline/curve/bspline.h"
#include "keyline/exchange/json/json_surface.h"
#include "keyline/figure/plot.h"
#include "keyline/lac/quasi/quasi.h"
#include "keyline/presentation/surface_pictures.h"
#include "keyline/surface/continuity.h"
#include "keyline/surface/edit.h"
#include "keyline/surface/sweep.h"

namespace {

using namespace keyline;
using core::Point2;
using core::Point3;
using figure::Drawing;
using presentation::SurfacePicture;
using surface::BezierSurface;
using surface::FieldKind;
using surface::Surface;

template <class T>
T value(core::Result<T> result) {
  if (result) return std::move(*result);
  std::fprintf(stderr, "surface_figures: %s\n", result.error().message.c_str());
  std::exit(1);
}

std::string folder;

void write(const std::string& name, const std::string& bytes) {
  std::ofstream(folder + "/" + name, std::ios::binary) << bytes;
}
void write_picture(const std::string& name, const Drawing& d) {
  write(name, value(figure::write_png(d, 1)));
}

BezierSurface panel(const std::string& name) {
  std::ifstream in(folder + "/../../examples/" + name + ".json");
  std::stringstream text;
  text << in.rdbuf();
  return std::get<BezierSurface>(
      value(exchange::surface_from_json(nlohmann::json::parse(text.str()), name)));
}

Drawing picture(const std::vector<Surface>& s, std::optional<FieldKind> field,
                const std::string& title, double width = 380) {
  SurfacePicture p;
  p.title = title;
  p.field = field;
  p.unit = "mm";
  p.width = width;
  return value(presentation::surface_picture(s, p));
}

/// [Oya] Figs. 9 and 10: surfaces (a) and (b).
void panels() {
  std::vector<Drawing> lit;
  std::vector<Drawing> profiles;
  for (const char* name : {"panel-a", "panel-b"}) {
    const BezierSurface s = panel(name);
    const auto found = value(surface::sav(s));
    std::printf("%s: SAV %.4g, worst %s\n", name, found.sav,
                found.curves[found.worst].name.c_str());
    const std::string title = std::string("Surface (") + name[6] + ")";
    lit.push_back(picture({s}, std::nullopt, title, 470));
    profiles.push_back(presentation::network_profiles(s, title, "mm"));
  }
  write_picture("surface-panels.png",
                figure::stack({figure::tile(lit, 2), profiles[0], profiles[1]}));
}

/// [Oya] Figs. 11 to 13.
void edit_panel() {
  const BezierSurface given = panel("panel-c");
  const auto edited = value(surface::edit(given));
  write_picture("surface-edit.png", value(presentation::surface_edit_page(given, edited, {})));
}

/// What lower values cost.
void tradeoff() {
  const BezierSurface given = panel("panel-c");
  figure::Plot plot;
  plot.title = "Panel c: what a lower SAV costs";
  plot.subtitle = "a SAV of 0 stands at the bottom";
  plot.x.title = "largest departure [mm]";
  plot.y.title = "SAV";
  plot.y.scale = figure::Scale::log10;
  plot.y.low = 1e-3;
  plot.y.high = 500;
  plot.x.low = 0;
  for (const auto& [keep, name] : {std::pair{surface::Keep::start, "start kept"},
                                   {surface::Keep::corners, "corners kept"},
                                   {surface::Keep::joints, "joints kept"},
                                   {surface::Keep::boundary, "boundary kept"}}) {
    surface::EditOptions options;
    options.keep = keep;
    const auto edited = value(surface::edit(given, options));
    figure::Series series{.name = name,
                          .kind = figure::SeriesKind::points,
                          .color = figure::palette(plot.series.size()),
                          .size = 7};
    std::printf("%s: SAV %.4g to %.3g, departure %.3g\n", name, edited.before.sav, edited.after.sav,
                edited.departure);
    for (const auto& t : edited.tradeoff) {
      series.points.push_back({t.departure, std::max(t.sav, 1.3e-3)});
      std::printf("  %-22s departure %6.2f  SAV %.4g\n", t.name.c_str(), t.departure, t.sav);
    }
    plot.series.push_back(std::move(series));
  }
  write("surface-tradeoff.svg", figure::write_svg(figure::draw(plot)));
}

curve::BSpline3 in_xz(const curve::Bezier2& c) {
  curve::BSpline3 s{curve::degree(c), std::vector<double>(c.control.size(), 0.0), {}, {}};
  s.knots.insert(s.knots.end(), c.control.size(), 1.0);
  for (const Point2& p : c.control) s.control.push_back({p.x, 0, p.y});
  return s;
}

/// [QLAC] Fig. 9: the same handles met by a quasi-log-aesthetic curve of degree 8 and slope 0 and
/// by one with three control points moved, so that its curvature waves, swept along one rail.
void quasi_sweep() {
  const Point2 p0{0, 0};
  const Point2 p1{140, 95};
  const Point2 p2{330, 70};
  lac::QuasiOptions options;
  options.degree = 8;
  const auto quasi = value(lac::quasi_log_aesthetic(p0, p1, p2, 0.0, options));
  curve::Bezier2 wavy = quasi.curve;
  wavy.control[3].y += 34;
  wavy.control[4].y -= 46;
  wavy.control[5].y += 34;
  const curve::BSpline3 rail{
      3, {0, 0, 0, 0, 1, 1, 1, 1}, {{0, 0, 0}, {20, 90, 25}, {20, 190, 40}, {0, 280, 40}}, {}};
  std::vector<Drawing> cells;
  for (const auto& [profile, name] : {std::pair{wavy, "Degree 8, curvature not monotone"},
                                      {quasi.curve, "Quasi-log-aesthetic, degree 8, slope 0"}}) {
    const auto swept = value(surface::translate(in_xz(profile), rail));
    const auto verdict = curve::certify_monotone_curvature(profile);
    std::printf("%s: curvature monotone: %s\n", name,
                verdict.answer == curve::MonotoneVerdict::yes ? "yes" : "no");
    SurfacePicture p;
    p.title = name;
    p.field = FieldKind::zebra;
    p.stripe_count = 40;
    p.lighting.stripes = core::Vector3{1, 0.5, 0};
    p.width = 430;
    cells.push_back(value(presentation::surface_picture({swept}, p)));
  }
  write_picture("surface-quasi-sweep.png", figure::tile(cells, 2));
}

void lights() {
  const Surface s = panel("panel-c");
  std::vector<Drawing> cells;
  for (const FieldKind k :
       {FieldKind::zebra, FieldKind::isophote, FieldKind::reflection, FieldKind::highlight})
    cells.push_back(picture({s}, k, ""));
  write_picture("surface-lights.png", figure::tile(cells, 2));
}

/// A smooth patch cut in two, the second half spoilt by one row more each time.
void joints() {
  Surface whole = value(surface::edit(panel("panel-c"))).surface;
  const BezierSurface s = std::get<BezierSurface>(whole);
  BezierSurface first = s;
  BezierSurface second = s;
  for (int j = 0; j < s.net.columns; ++j) {
    const auto [a, b] = curve::split(curve::Bezier3{column_of(s.net, j), {}}, 0.45);
    for (int i = 0; i < s.net.rows; ++i) {
      first.net.at(i, j) = a.control[i];
      second.net.at(i, j) = b.control[i];
    }
  }
  std::vector<Drawing> cells;
  for (const int row : {1, 2, 3}) {
    BezierSurface spoilt = second;
    for (int j = 0; j < 4; ++j) spoilt.net.at(row, j).z += row == 1 ? 0.5 : row == 2 ? 1.5 : 0.0;
    const auto c = value(surface::edge_continuity(first, spoilt));
    std::printf("joint G%d: gap %.2g mm, angle %.3g rad, curvature jump %.2g 1/mm\n", c.order,
                c.gap, c.angle, c.curvature_jump);
    SurfacePicture p;
    p.title = "Joint G" + std::to_string(c.order);
    p.field = FieldKind::zebra;
    p.stripe_count = 60;
    p.lighting.stripes = core::Vector3{1, 2.2, 0};
    p.width = 300;
    cells.push_back(value(presentation::surface_picture({first, spoilt}, p)));
  }
  write_picture("surface-joints.png", figure::tile(cells, 3));
}

}  // namespace

int main(int argc, char** argv) {
  folder = argc > 1 ? argv[1] : ".";
  panels();
  edit_panel();
  tradeoff();
  quasi_sweep();
  lights();
  joints();
}
