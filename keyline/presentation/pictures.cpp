#include "keyline/presentation/pictures.h"

#include "keyline/core/error.h"
#include "keyline/figure/curve_charts.h"
#include "keyline/presentation/curve_samples.h"

namespace keyline::presentation {
namespace {

constexpr double kWidth = 860;         // px
constexpr double kMostHeight = 460;    // of one figure
constexpr std::size_t kPoints = 2000;  // drawn at most

figure::ChartOptions chart_options(const ReportOptions& options) {
  return {.unit = options.unit, .width = kWidth, .largest_height = kMostHeight};
}

std::string heading(const ReportOptions& options, const std::string& otherwise) {
  std::string text = options.title.empty() ? otherwise : options.title;
  if (!options.subtitle.empty()) text += " \u2013 " + options.subtitle;
  return text;
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

}  // namespace keyline::presentation
