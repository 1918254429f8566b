#include "keyline/presentation/draw_figure.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "keyline/core/angle.h"
#include "keyline/figure/curve_charts.h"
#include "keyline/figure/plot.h"
#include "keyline/figure/rhythm_charts.h"
#include "keyline/lac/hermite/compound.h"
#include "keyline/lac/hermite/hermite.h"
#include "keyline/lac/hermite/region.h"
#include "keyline/presentation/analyze_report.h"
#include "keyline/presentation/curve_samples.h"

namespace keyline::presentation {
namespace {

using core::ErrorCode;
using core::Point2;
using core::Result;
using figure::Drawing;

constexpr std::size_t kMostGraphs = 6;
constexpr int kTurnings = 120;  ///< at which the region's border is computed

core::Interval region_at(const RegionQuestion& q, double theta) {
  return q.alpha.size() == 2
             ? lac::drawable_region(lac::CompoundRhythm{q.alpha[0], q.alpha[1], q.ratio}, theta)
             : lac::drawable_region(q.alpha[0], theta);
}

double degrees(double radians) { return radians * 180 / core::kPi; }

/// Shares psi/theta of the turning, low and high, as one closed outline.
figure::Path region_outline(const RegionQuestion& q) {
  figure::Path path;
  std::vector<Point2> back;
  for (int i = 1; i <= kTurnings; ++i) {
    const double theta = i * 0.999 * core::kPi / kTurnings;
    const core::Interval psi = region_at(q, theta);
    const Point2 low{degrees(theta), psi.low / theta};
    if (i == 1) {
      path.move_to(low);
    } else {
      path.line_to(low);
    }
    back.push_back({degrees(theta), psi.high / theta});
  }
  for (auto p = back.rbegin(); p != back.rend(); ++p) path.line_to(*p);
  return path.close();
}

std::string slopes_of(const RegionQuestion& q) {
  if (q.alpha.size() == 2)
    return fmt::format("slopes {:.4g} and {:.4g}, ratio {:.4g}", q.alpha[0], q.alpha[1], q.ratio);
  return fmt::format("slope {:.4g}", q.alpha[0]);
}

Drawing graph_of(const analysis::PieceAnalysis& piece, std::size_t index) {
  figure::LcgPiece graph;
  graph.name = fmt::format("Piece {}: LCG", index);
  const std::size_t step = std::max<std::size_t>(1, piece.lcg.points.size() / 150);
  for (std::size_t i = 0; i < piece.lcg.points.size(); i += step)
    graph.points.push_back({piece.lcg.points[i].log_radius / std::numbers::ln10,
                            piece.lcg.points[i].log_rate / std::numbers::ln10});
  if (piece.lcg.defined && !graph.points.empty()) {
    const auto [low, high] = std::minmax_element(graph.points.begin(), graph.points.end(),
                                                 [](Point2 a, Point2 b) { return a.x < b.x; });
    graph.lines.push_back(
        {low->x, high->x, piece.lcg.slope, piece.lcg.intercept / std::numbers::ln10});
    graph.variance = piece.lcg.variance / (std::numbers::ln10 * std::numbers::ln10);
  }
  return figure::lcg_chart(graph);
}

void add_lcg_charts(const analysis::CurveAnalysis& analysis, std::vector<Drawing>& all) {
  std::vector<Drawing> charts;
  for (std::size_t i = 0; i < analysis.pieces.size() && charts.size() < kMostGraphs; ++i)
    if (analysis.pieces[i].lcg.defined) charts.push_back(graph_of(analysis.pieces[i], i));
  if (!charts.empty()) all.push_back(figure::tile(charts, 2));
}

}  // namespace

Result<RegionQuestion> region_question(const std::vector<Point2>& points, std::vector<double> alpha,
                                       double ratio) {
  if (points.size() != 3 || alpha.empty() || alpha.size() > 2)
    return core::fail(ErrorCode::bad_input, "a drawable region belongs to three handles",
                      "give three points and one or two slopes", "show");
  const auto angles = lac::handle_angles(points[0], points[1], points[2]);
  if (!angles) return std::unexpected(angles.error());
  return RegionQuestion{std::move(alpha), ratio, std::abs(angles->turning),
                        std::abs(angles->chord_angle)};
}

Drawing region_chart(const RegionQuestion& question) {
  figure::Plot plot;
  plot.title = "Drawable region";
  plot.subtitle = slopes_of(question) + "; the share is 1/2 for a circular arc";
  plot.x = {"turning θ, degrees", figure::Scale::linear, 0.0, 180.0};
  plot.y = {"chord angle ψ as a share of θ", figure::Scale::linear, 0.0, 1.0};
  plot.regions = {region_outline(question)};
  const double theta = question.theta;
  if (theta > 0) {
    const Point2 asked{degrees(theta), question.psi / theta};
    plot.series.push_back({.name = "the handles given",
                           .points = {asked},
                           .kind = figure::SeriesKind::points,
                           .color = figure::kWarning,
                           .marker = figure::Marker::dot,
                           .size = 7});
  }
  return figure::draw(plot);
}

Result<Drawing> draw_picture(const document::Path& path, const DrawShow& show,
                             const std::optional<RegionQuestion>& region,
                             const ReportOptions& options) {
  const auto analysis = operations::analyze_path(path);
  if (!analysis) return std::unexpected(analysis.error());
  const figure::SampledCurve curve = detail::path_samples(path, analysis->split.pieces);
  figure::ChartOptions chart;
  chart.unit = options.unit;
  std::vector<Drawing> all;
  if (show.comb || !(show.evolute || show.lcg || show.region))
    all.push_back(figure::curvature_comb(curve, chart));
  if (show.evolute) all.push_back(figure::evolute_chart(curve, chart));
  if (show.lcg) add_lcg_charts(*analysis, all);
  if (show.region && region) all.push_back(region_chart(*region));
  if (all.empty()) all.push_back(figure::curvature_comb(curve, chart));
  Drawing page = figure::stack(all);
  page.title = options.title.empty() ? "Curve from handles" : options.title;
  return page;
}

Result<report::Report> draw_report(const document::Path& path, const DrawShow& show,
                                   const std::optional<RegionQuestion>& region,
                                   const ReportOptions& options) {
  const auto analysis = operations::analyze_path(path);
  if (!analysis) return std::unexpected(analysis.error());
  report::Report report = analyze_report(*analysis, path, options);
  if (show.region && region)
    report.sections.push_back(
        {"Drawable region",
         {"Triangles whose point lies in the shaded area can be met by this rhythm."},
         {{region_chart(*region), "Chord angle over turning that can be drawn."}},
         {}});
  return report;
}

}  // namespace keyline::presentation
