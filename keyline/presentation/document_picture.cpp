#include "keyline/presentation/document_picture.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <fmt/format.h>

#include "keyline/core/text.h"
#include "keyline/curve/length.h"
#include "keyline/document/color.h"
#include "keyline/figure/line_drawing.h"
#include "keyline/presentation/report_parts.h"

namespace keyline::presentation {
namespace {

using core::Point2;
using core::Result;

constexpr int kSamples = 48;                 // between neighbouring breakpoints of smooth curves
constexpr std::size_t kMostPoints = 400000;  // of all lines together
constexpr double kWidth = 860;               // px

/// Ink where the label has none.
figure::Color color_of(const std::string& text) {
  const int value = document::color_value(text);
  if (value < 0) return figure::kInk;
  return {static_cast<std::uint8_t>(value >> 16), static_cast<std::uint8_t>(value >> 8 & 0xff),
          static_cast<std::uint8_t>(value & 0xff)};
}

/// Straight members have their ends alone.
std::vector<Point2> points_of(const document::Path& path, int samples) {
  std::vector<Point2> points;
  for (const document::PlanarCurve& c : path.curves) {
    if (const auto* line = std::get_if<curve::Polyline2>(&c.value)) {
      points.insert(points.end(), line->points.begin(), line->points.end());
      continue;
    }
    const std::vector<double> breaks = breakpoints(c);
    const document::PlacedCurve placed = prepared(c);
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i)
      for (int k = 0; k <= samples; ++k)
        points.push_back(
            evaluate(placed, std::lerp(breaks[i], breaks[i + 1], k / double(samples))));
  }
  if (path.closed && !points.empty()) points.push_back(points.front());
  return points;
}

/// Fewer where there are very many curves, which then are small on the page.
int samples_for(const document::Document& document) {
  std::size_t spans = 1;
  for (const document::NamedPath& named : document.paths)
    for (const document::PlanarCurve& c : named.path.curves)
      if (!std::holds_alternative<curve::Polyline2>(c.value)) spans += breakpoints(c).size() - 1;
  return std::clamp(static_cast<int>(kMostPoints / spans), 4, kSamples);
}

std::string unit_of(const document::Document& document, const ReportOptions& options) {
  return document.unit.empty() ? options.unit : document.unit;
}

double length_of(const document::Path& path) {
  double length = 0;
  for (const document::PlanarCurve& c : path.curves)
    length +=
        std::visit([](const auto& value) { return curve::arc_length(value, 0, 1, 1e-6); }, c.value);
  return length;
}

report::ReportTable curve_table(const document::Document& document) {
  report::ReportTable table{.caption = "Curves",
                            .columns = {{"Curve", report::Alignment::text},
                                        {"Layer", report::Alignment::text},
                                        {"Members"},
                                        {"Length"},
                                        {"Width"},
                                        {"Closed", report::Alignment::text}}};
  for (std::size_t i = 0; i < document.paths.size(); ++i) {
    const document::NamedPath& named = document.paths[i];
    table.rows.push_back({named.label.name.empty() ? std::to_string(i + 1) : named.label.name,
                          named.label.layer, std::to_string(named.path.curves.size()),
                          fmt::format("{:.6g}", length_of(named.path)),
                          named.stroke_width > 0 ? fmt::format("{:.4g}", named.stroke_width) : "",
                          named.path.closed ? "yes" : "no"});
  }
  return table;
}

}  // namespace

Result<figure::Drawing> document_picture(const document::Document& document,
                                         const ReportOptions& options) {
  if (document.paths.empty())
    return core::fail(core::ErrorCode::unsupported, "there is no planar curve to draw",
                      "keyline analyze draws surfaces");
  const int samples = samples_for(document);
  std::vector<figure::DrawnLine> lines;
  for (const document::NamedPath& named : document.paths)
    lines.push_back(
        {points_of(named.path, samples), named.stroke_width, color_of(named.label.color)});
  return figure::line_drawing(
      lines, options.subtitle,
      {.title = options.title, .unit = unit_of(document, options), .width = kWidth});
}

Result<report::Report> document_report(const document::Document& document,
                                       const ReportOptions& options) {
  auto picture = document_picture(document, options);
  if (!picture) return std::unexpected(picture.error());
  report::Report report = detail::headed(options, "");
  report.verdict_line = core::counted(document.paths.size(), "curve");
  report.sections.push_back({.title = "Curves",
                             .figures = {{std::move(*picture), "The curves where they lie"}},
                             .tables = {curve_table(document)}});
  if (!document.surfaces.empty())
    report.notes.push_back(
        {report::NoteKind::note, core::counted(document.surfaces.size(), "surface") +
                                     " not shown here: keyline analyze shows surfaces"});
  for (const std::string& skipped : document.skipped)
    report.notes.push_back({report::NoteKind::note, "skipped: " + skipped});
  return report;
}

}  // namespace keyline::presentation
