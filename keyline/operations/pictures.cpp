#include "keyline/operations/pictures.h"

#include <cmath>

#include <fmt/format.h>

#include "keyline/core/error.h"
#include "keyline/curve/conversion.h"
#include "keyline/figure/curve_charts.h"
#include "keyline/operations/curve_samples.h"
#include "keyline/operations/fair_request.h"

namespace keyline::operations {
namespace {

constexpr double kWidth = 860;         // px
constexpr double kMostHeight = 460;    // of one figure
constexpr std::size_t kPoints = 2000;  // drawn at most
constexpr double kClosing = 1e-9;      // of the size

figure::ChartOptions chart_options(const ReportOptions& options) {
  return {.unit = options.unit, .width = kWidth, .largest_height = kMostHeight};
}

std::string heading(const ReportOptions& options, const std::string& otherwise) {
  std::string text = options.title.empty() ? otherwise : options.title;
  if (!options.subtitle.empty()) text += " \u2013 " + options.subtitle;
  return text;
}

double size_of(const std::vector<curve::Bezier2>& pieces) {
  double size = 0;
  for (const curve::Bezier2& piece : pieces)
    for (const core::Point2 p : piece.control)
      size = std::max(size, core::distance(p, pieces.front().control.front()));
  return size;
}

/// Ends that all but meet are made to meet.
void close(exchange::SvgPath& path) {
  if (path.pieces.empty()) return;
  const core::Point2 start = path.pieces.front().control.front();
  core::Point2& end = path.pieces.back().control.back();
  if (core::distance(start, end) > kClosing * size_of(path.pieces)) return;
  end = start;
  path.closed = true;
}

}  // namespace

figure::Drawing fair_picture(const acquire::KeyLine& line, const fairing::FairResult& result,
                             const ReportOptions& options) {
  if (line.points.size() != result.offsets.size())
    throw core::InvalidInput("fair_picture: the result is of another key-line");
  const figure::ChartOptions chart = chart_options(options);
  const figure::SampledCurve faired = detail::faired_samples(result);
  figure::Overlay overlay = detail::deviations(line.points, result.offsets, faired, kPoints);
  overlay.tolerance = result.tolerance;
  std::vector<figure::SampledCurve> curves{faired};
  const figure::SampledCurve spline = detail::spline_samples(result);
  if (!spline.points.empty()) curves.push_back(spline);
  figure::Drawing page =
      figure::stack({figure::overlay(overlay, chart), figure::curvature_plot(curves, chart),
                     figure::curvature_comb(faired, chart)});
  page.title = heading(options, line.id.empty() ? "Faired key-line" : line.id);
  return page;
}

figure::Drawing analyze_picture(const analysis::CurveAnalysis& analysis, const document::Path& path,
                                const ReportOptions& options) {
  const figure::ChartOptions chart = chart_options(options);
  const figure::SampledCurve curve = detail::path_samples(path, analysis.split.pieces);
  figure::Drawing page =
      figure::stack({figure::curvature_plot({curve}, chart), figure::curvature_comb(curve, chart),
                     figure::evolute_chart(curve, chart)});
  page.title = heading(options, "Curvature of a curve");
  return page;
}

CubicPath cubic_path(const document::Path& path, const std::string& name, double tolerance) {
  CubicPath made;
  made.path.name = name;
  for (const document::PlanarCurve& c : path.curves) {
    auto part = std::visit(
        [&](const auto& v) { return curve::approximate_by_cubics(v, tolerance); }, c.value);
    made.deviation = std::max(made.deviation, part.deviation);
    made.path.pieces.insert(made.path.pieces.end(), part.pieces.begin(), part.pieces.end());
  }
  const bool loop = path.curves.size() == 1 &&
                    std::holds_alternative<lac::Chain>(path.curves[0].value) &&
                    std::get<lac::Chain>(path.curves[0].value).closed;
  if (path.closed || loop) close(made.path);
  return made;
}

std::vector<exchange::SvgLayer> fair_layers(const fairing::FairResult& result,
                                            const std::string& name, double tolerance) {
  exchange::SvgLayer layer;
  layer.name = name.empty() ? "key-line" : name;
  layer.paths.push_back(cubic_path(fair_curve(result), name, tolerance).path);
  return {std::move(layer)};
}

core::Result<std::string> fair_svg(const fairing::FairResult& result, double tolerance,
                                   const std::string& unit, const std::string& metadata) {
  if (!(tolerance > 0) || !std::isfinite(tolerance))
    return core::fail(core::ErrorCode::bad_input, "the tolerance is not a length",
                      "give a number greater than 0", "tolerance");
  CubicPath cubics = cubic_path(fair_curve(result), "", tolerance);
  exchange::SvgLayer layer;
  layer.name = "key-line";
  const std::size_t count = cubics.path.pieces.size();
  layer.paths.push_back(std::move(cubics.path));
  exchange::SvgWriteOptions options;
  options.unit = unit;
  options.title = fmt::format("{} cubic B\u00E9zier pieces within {:.3g} of the exact curve", count,
                              cubics.deviation);
  options.metadata = metadata;
  return exchange::write_svg({std::move(layer)}, options);
}

}  // namespace keyline::operations
