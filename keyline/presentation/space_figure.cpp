#include "keyline/presentation/space_figure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "keyline/figure/plot.h"

namespace keyline::presentation {
namespace {

using core::Point2;
using core::Point3;
using figure::Drawing;

constexpr int kPoints = 201;

struct View {
  const char* title;
  double Point3::* across;
  double Point3::* up;
};

/// `extent` is the box's size in every view, so that all have one scale.
Drawing view_of(const View& view, const std::vector<Point3>& points, double extent) {
  Drawing drawing;
  drawing.width = 300;
  drawing.height = 250;
  drawing.title = view.title;
  std::vector<Point2> flat;
  for (const Point3& p : points) flat.push_back({p.*view.across, p.*view.up});
  const figure::Box tight = figure::box_of(flat);
  const Point2 centre = core::mix(tight.min, tight.max, 0.5);
  const core::Vector2 half{0.5 * extent, 0.5 * extent};
  const figure::Viewport viewport =
      figure::fit_viewport({centre + -1.0 * half, centre + half}, {{16, 36}, {284, 234}});
  drawing.add(figure::Label{.at = {12, 22}, .text = view.title, .size = 14, .bold = true});
  drawing.add(figure::Shape{.path = figure::polyline(to_page(viewport, flat)),
                            .stroke = figure::Stroke{figure::palette(0), 1.8, {}}});
  drawing.add(figure::Marks{.points = {to_page(viewport, flat.front())}, .size = 6});
  return drawing;
}

Drawing views_of(const lac::SpaceChain& chain) {
  const std::vector<Point3> points = lac::sample(chain, kPoints);
  double extent = 0;
  for (const auto axis : {&Point3::x, &Point3::y, &Point3::z}) {
    const auto [low, high] =
        std::minmax_element(points.begin(), points.end(),
                            [&](const Point3& a, const Point3& b) { return a.*axis < b.*axis; });
    extent = std::max(extent, (*high).*axis - (*low).*axis);
  }
  std::vector<Drawing> views;
  for (const View& view : {View{"From the front: x, y", &Point3::x, &Point3::y},
                           View{"From above: x, z", &Point3::x, &Point3::z},
                           View{"From the side: y, z", &Point3::y, &Point3::z}})
    views.push_back(view_of(view, points, extent));
  return figure::tile(views, 3);
}

Drawing laws_of(const lac::SpaceChain& chain, const std::string& unit) {
  figure::Plot plot;
  plot.title = "Curvature and torsion";
  plot.width = 620;
  plot.height = 260;
  plot.x.title = unit.empty() ? "arc length" : "arc length, " + unit;
  plot.y.title = unit.empty() ? "κ, τ" : "κ, τ in 1/" + unit;
  figure::Series bend{.name = "curvature κ", .color = figure::palette(0), .width = 1.8};
  figure::Series twist{.name = "torsion τ", .color = figure::palette(1), .width = 1.8};
  const double length = arc_length(chain);
  for (int i = 0; i < kPoints; ++i) {
    const double t = i / (kPoints - 1.0);
    bend.points.push_back({t * length, lac::curvature(chain, t)});
    twist.points.push_back({t * length, lac::torsion(chain, t)});
  }
  plot.series = {std::move(bend), std::move(twist)};
  return figure::draw(plot);
}

/// Logarithmic curvature and torsion graphs: straight lines of slopes alpha and beta, piece by
/// piece; nothing where a law is constant.
Drawing graphs_of(const lac::SpaceChain& chain) {
  figure::Plot plot;
  plot.title = "Logarithmic curvature and torsion graphs";
  plot.width = 620;
  plot.height = 260;
  plot.x.title = "log ρ, log μ (radii of curvature and torsion)";
  plot.y.title = "log(ρ ds/dρ), log(μ ds/dμ)";
  figure::Series bend{.name = "curvature", .color = figure::palette(0), .width = 1.8};
  figure::Series twist{.name = "torsion", .color = figure::palette(1), .width = 1.8};
  const auto add = [](const lac::Piece& law, figure::Series& series) {
    if (law.curvature_start == law.curvature_end) return;
    for (int i = 0; i <= 60; ++i) {
      const double k = std::abs(lac::curvature(law, i / 60.0));
      const double rate = std::abs(lac::curvature_rate(law, i / 60.0));
      const bool defined = k > 0 && rate > 0 && std::isfinite(rate);
      series.points.push_back(defined ? Point2{-std::log10(k), std::log10(k / rate)}
                                      : Point2{NAN, NAN});
    }
    series.points.push_back({NAN, NAN});
  };
  for (const lac::SpacePiece& p : chain.pieces) {
    add(lac::curvature_law(p), bend);
    add(lac::torsion_law(p), twist);
  }
  plot.series = {std::move(bend), std::move(twist)};
  return figure::draw(plot);
}

std::string title_of(const ReportOptions& options) {
  return options.title.empty() ? "Log-aesthetic space curve" : options.title;
}

}  // namespace

Drawing space_picture(const lac::SpaceChain& chain, const ReportOptions& options) {
  Drawing page = figure::stack({views_of(chain), laws_of(chain, options.unit), graphs_of(chain)});
  page.title = title_of(options);
  return page;
}

report::Report space_report(const lac::SpaceChain& chain, const ReportOptions& options) {
  report::Report report;
  report.title = title_of(options);
  report.subtitle = options.subtitle;
  report.generator = options.generator;
  report.command = options.command;
  report.options = options.options;
  report.numbers = {{"Length", fmt::format("{:.6g}", arc_length(chain)), options.unit}};
  report::ReportTable table{
      "Pieces",
      {{"slope of curvature"}, {"of torsion"}, {"length"}, {"κ from"}, {"to"}, {"τ from"}, {"to"}},
      {}};
  for (const lac::SpacePiece& p : chain.pieces) {
    std::vector<std::string> row;
    for (const double x : {p.alpha, p.beta, p.length, p.curvature_start, p.curvature_end,
                           p.torsion_start, p.torsion_end})
      row.push_back(fmt::format("{:.6g}", x));
    table.rows.push_back(std::move(row));
  }
  report.sections = {{"Views",
                      {"Seen along the three axes at one scale; the dot is the start."},
                      {{views_of(chain), "The curve from three sides."},
                       {laws_of(chain, options.unit), "Curvature and torsion along the curve."},
                       {graphs_of(chain), "Straight lines of the two slopes."}},
                      {table}}};
  return report;
}

}  // namespace keyline::presentation
