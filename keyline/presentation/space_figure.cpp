#include "keyline/presentation/space_figure.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "keyline/core/extent.h"
#include "keyline/figure/plot.h"
#include "keyline/presentation/report_parts.h"

namespace keyline::presentation {
namespace {

using core::Point2;
using core::Point3;
using core::Vector3;
using figure::Drawing;

constexpr int kPoints = 601;
constexpr std::size_t kTeeth = 12;  ///< points from one tooth to the next

constexpr double kWide = 920;    ///< of the page
constexpr double kAside = 0.35;  ///< longest tooth of the comb, as share of the curve's box

/// What is drawn in space: the curve, and the ends of the teeth of its comb.
struct Shown {
  std::vector<Point3> points, teeth;
};

struct View {
  std::string title;
  Vector3 across, up;  ///< z is up in space
};

Point2 seen(const View& view, const Point3& p) {
  const Vector3 v = p - Point3{};
  return {dot(v, view.across), dot(v, view.up)};
}

/// Points along the curve and, where curvature looks out of it, the ends of a comb as long as
/// `longest` at most.
Shown shown(const lac::SpaceChain& chain, double longest) {
  Shown s;
  std::vector<double> at;
  for (int i = 0; i < kPoints; ++i) at.push_back(i / (kPoints - 1.0));
  const auto frames = lac::frames(chain, at);
  double most = 0;
  for (const double t : at) most = std::max(most, std::abs(lac::curvature(chain, t)));
  for (std::size_t i = 0; i < frames.size(); ++i) {
    s.points.push_back(frames[i].position);
    const double tooth = most > 0 ? longest * lac::curvature(chain, at[i]) / most : 0;
    s.teeth.push_back(frames[i].position - tooth * frames[i].normal);
  }
  return s;
}

/// Directions of the axes, where they do not lie along the page.
void add_axes(Drawing& drawing, const View& view, Point2 corner) {
  constexpr double kLength = 24;
  const std::pair<const char*, Vector3> axes[] = {
      {"x", {1, 0, 0}}, {"y", {0, 1, 0}}, {"z", {0, 0, 1}}};
  for (const auto& [name, axis] : axes) {
    const core::Vector2 way{dot(axis, view.across), -dot(axis, view.up)};
    const Point2 tip = corner + kLength * way;
    drawing.add(figure::Shape{.path = figure::polyline(std::vector{corner, tip}),
                              .stroke = figure::Stroke{figure::kInk, 0.9, {}}});
    drawing.add(figure::Label{.at = tip + 9.0 * way,
                              .text = name,
                              .size = 11,
                              .anchor = figure::Anchor::middle,
                              .baseline = figure::Baseline::middle,
                              .italic = true});
  }
}

/// `extent` is the box's size in every view, so that all have one scale.
Drawing view_of(const View& view, const Shown& what, double extent, bool slanted) {
  Drawing drawing;
  drawing.width = (kWide - 16) / 2;
  drawing.height = 300;
  drawing.title = view.title;
  std::vector<Point2> curve, comb, all;
  for (const Point3& p : what.points) curve.push_back(seen(view, p));
  for (const Point3& p : what.teeth) comb.push_back(seen(view, p));
  all = curve;
  if (slanted) all.insert(all.end(), comb.begin(), comb.end());
  const figure::Box tight = figure::box_of(all);
  const Point2 centre = core::mix(tight.min, tight.max, 0.5);
  const core::Vector2 half{0.5 * extent, 0.5 * extent};
  const figure::Viewport viewport = figure::fit_viewport({centre + -1.0 * half, centre + half},
                                                         {{16, 36}, {drawing.width - 16, 284}});
  drawing.add(figure::Label{.at = {12, 22}, .text = view.title, .size = 14, .bold = true});
  const auto line = [&](const std::vector<Point2>& points, figure::Color color, double width) {
    drawing.add(figure::Shape{.path = figure::polyline(to_page(viewport, points)),
                              .stroke = figure::Stroke{color, width, {}}});
  };
  if (slanted) {
    for (std::size_t i = 0; i < curve.size(); i += kTeeth)
      line({curve[i], comb[i]}, figure::palette(1), 0.6);
    line(comb, figure::palette(1), 1);
    add_axes(drawing, view, {36, 262});
  }
  line(curve, figure::palette(0), 1.8);
  drawing.add(figure::Marks{.points = {to_page(viewport, curve.front())}, .size = 6});
  return drawing;
}

Drawing views_of(const lac::SpaceChain& chain) {
  const double box = longest_side(core::box_of(lac::sample(chain, kPoints)));
  const Shown what = shown(chain, kAside * box);
  std::vector<Point3> all = what.points;
  all.insert(all.end(), what.teeth.begin(), what.teeth.end());
  const double extent = 1.2 * longest_side(core::box_of(all));  // seen at a slant a box is wider
  // Along the cube's diagonal, from where x comes to the lower right and y goes to the upper right.
  const double a = std::sqrt(0.5), b = std::sqrt(1.0 / 6);
  const View slant{"At a slant, with its comb of curvature", {a, a, 0}, {-b, b, 2 * b}};
  const View along[] = {{"From above: x, y", {1, 0, 0}, {0, 1, 0}},
                        {"From the front: x, z", {1, 0, 0}, {0, 0, 1}},
                        {"From the side: y, z", {0, 1, 0}, {0, 0, 1}}};
  std::vector<Drawing> views{view_of(slant, what, extent, true)};
  for (const View& view : along) views.push_back(view_of(view, what, box, false));
  return figure::tile(views, 2);
}

Drawing laws_of(const lac::SpaceChain& chain, const std::string& unit) {
  figure::Plot plot;
  plot.title = "Curvature and torsion";
  plot.width = kWide;
  plot.height = 320;
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
  plot.width = kWide;
  plot.height = 320;
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
  report::Report report = detail::headed(options, title_of(options));
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
  report.sections = {
      {"Views",
       {"At a slant and along the three axes, these at one scale; the dot is the start. Teeth "
        "stand "
        "on the curve away from its centre of curvature and are as long as it bends."},
       {{views_of(chain), "The curve from four sides."},
        {laws_of(chain, options.unit), "Curvature and torsion along the curve."},
        {graphs_of(chain), "Straight lines of the two slopes."}},
       {table}}};
  return report;
}

}  // namespace keyline::presentation
