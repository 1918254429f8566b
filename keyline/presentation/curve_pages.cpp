#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "keyline/exchange/cad/planar_form.h"
#include "keyline/operations/curve_edit.h"
#include "keyline/operations/fair.h"
#include "keyline/operations/json_form.h"
#include "keyline/presentation/analyze_report.h"
#include "keyline/presentation/class_a_figure.h"
#include "keyline/presentation/document_picture.h"
#include "keyline/presentation/draw_figure.h"
#include "keyline/presentation/encode.h"
#include "keyline/presentation/fair_report.h"
#include "keyline/presentation/pages.h"
#include "keyline/presentation/pictures.h"
#include "keyline/presentation/space_figure.h"

namespace keyline::presentation {
namespace {

using core::Result;
using detail::titled;
using figure::Drawing;
using nlohmann::json;
using report::Report;

const operations::FairAnswer& fair_of(const Shown& shown) {
  return *shown.outcome.result_as<operations::FairAnswer>();
}

const operations::FairRequest& request_of(const Shown& shown) {
  return *shown.outcome.request_as<operations::FairRequest>();
}

ReportOptions fair_options(const Shown& shown, const ReportOptions& given) {
  ReportOptions options = titled(given, "Faired key-line", shown.name);
  const auto& request = request_of(shown);
  const bool by_rule = request.options.tolerance <= 0;
  options.options.insert(options.options.begin(),
                         {"tolerance", fmt::format("{:.6g}{}", fair_of(shown).tolerance,
                                                   by_rule ? " (by the default rule)" : "")});
  options.options.emplace_back("seed", std::to_string(request.options.seed));
  return options;
}

acquire::KeyLine named_line(const Shown& shown) {
  acquire::KeyLine line = fair_of(shown).line;
  line.id = shown.name;
  return line;
}

const operations::AnalyzeAnswer& analysis_of(const ShownAnalysis& shown) {
  return *shown.analysis.outcome.result_as<operations::AnalyzeAnswer>();
}

/// Its place in the plane, where it has one.
const classa::Evaluation* place_of(const ShownAnalysis& shown) {
  if (!shown.class_a) return nullptr;
  const auto& value = *shown.class_a->result_as<operations::EvaluationShown>();
  return value.evaluation ? &*value.evaluation : nullptr;
}

PlaneEntry entry_of(const ShownAnalysis& shown) {
  const std::string& name = shown.analysis.name;
  return {name.empty() ? "the curve" : name, place_of(shown)};
}

Report analysis_report(const std::vector<ShownAnalysis>& all, const ReportOptions& options) {
  std::vector<PlaneEntry> places;
  for (const ShownAnalysis& one : all)
    if (place_of(one)) places.push_back(entry_of(one));
  std::vector<Report> reports;
  std::size_t place = 0;
  for (const ShownAnalysis& one : all) {
    const auto& answer = analysis_of(one);
    reports.push_back(analyze_report(answer.analysis, answer.path,
                                     titled(options, "Curve analysis", one.analysis.name)));
    if (place_of(one)) reports.back().sections.push_back(class_a_section(places, place++, {}));
  }
  return joined_report(reports, "Curve analysis");
}

Drawing analysis_picture(const std::vector<ShownAnalysis>& all, const ReportOptions& options) {
  std::vector<Drawing> drawings;
  for (const ShownAnalysis& one : all) {
    const auto& answer = analysis_of(one);
    drawings.push_back(analyze_picture(answer.analysis, answer.path,
                                       titled(options, "Curve analysis", one.analysis.name)));
    if (place_of(one))
      drawings.back() = figure::stack({drawings.back(), plane_chart({entry_of(one)}, {})});
  }
  return figure::tile(drawings, 1);
}

/// What a page of an edited curve shows, for one of them.
template <class Page>
Page of_edit(const Shown& shown, const ReportOptions& options,
             Page (*make)(const classa::EditResult&, const classa::Approximation&,
                          const classa::EditOptions&, const ReportOptions&)) {
  const auto& answer = *shown.outcome.result_as<operations::CurveEditAnswer>();
  const auto& request = *shown.outcome.request_as<operations::CurveEditRequest>();
  return make(*answer.edited, *answer.given, operations::edit_options(request),
              titled(options, "Edited curve", shown.name));
}

DrawShow show_of(const HandleView& view) {
  const auto wanted = [&](HandleFigure figure) {
    return std::ranges::find(view.show, figure) != view.show.end();
  };
  return {wanted(HandleFigure::comb), wanted(HandleFigure::evolute), wanted(HandleFigure::lcg),
          wanted(HandleFigure::region)};
}

/// The triangle of handles a request gives, where it gives one.
Result<std::optional<RegionQuestion>> region_of(const operations::Outcome& outcome) {
  const auto request = operations::write_json(*outcome.operation->request, outcome.request.get());
  if (!request) return std::unexpected(request.error());
  const json points = request->value("points", json());
  if (!points.is_array() || points.size() != 3 || points[0].size() != 2 ||
      !request->contains("alpha") || request->contains("closed"))
    return std::nullopt;
  std::vector<core::Point2> handles;
  for (const json& p : points) handles.push_back({p[0].get<double>(), p[1].get<double>()});
  const json& alpha = (*request)["alpha"];
  const auto slopes = alpha.is_array() ? alpha.get<std::vector<double>>()
                                       : std::vector<double>{alpha.get<double>()};
  auto question = region_question(handles, slopes, request->value("ratio", 0.5));
  if (!question) return std::unexpected(question.error());
  return *question;
}

/// The curve of a result.
const operations::AnyCurve* curve_of(const operations::Outcome& outcome) {
  const operations::AnyCurve* found = nullptr;
  core::visit_fields(
      *outcome.operation->result, outcome.result.get(),
      [&](const core::Field& field, const void* member) {
        if (&field.type() == &core::type_of<operations::AnyCurve>() && field.name == "curve")
          found = static_cast<const operations::AnyCurve*>(member);
      });
  return found;
}

Result<Pages> space_pages(const lac::SpaceChain& chain, const HandleView& view,
                          const ReportOptions& given) {
  if (!view.show.empty())
    return core::fail(core::ErrorCode::bad_input, "there are no figures of space curves to choose",
                      "leave it out: pictures show three views, curvature and torsion", "show");
  const ReportOptions options = titled(given, "Space curve from handles", "");
  return detail::pages_with_svg([=]() -> Result<Drawing> { return space_picture(chain, options); },
                                [=]() -> Result<Report> { return space_report(chain, options); });
}

}  // namespace

Pages fair_pages(const std::vector<Shown>& all, const ReportOptions& options) {
  return detail::pages_of(
      [=]() -> Result<Drawing> {
        std::vector<Drawing> drawings;
        for (const Shown& one : all)
          drawings.push_back(
              fair_picture(named_line(one), fair_of(one).faired, fair_options(one, options)));
        return detail::sheet_of(drawings);
      },
      [=]() -> Result<Report> {
        std::vector<Report> reports;
        for (const Shown& one : all)
          reports.push_back(fair_report(named_line(one), fair_of(one).faired,
                                        fair_options(one, options),
                                        request_of(one).options.slopes));
        return joined_report(reports, "Faired key-lines");
      });
}

Pages analysis_pages(const std::vector<ShownAnalysis>& all, const ReportOptions& options) {
  return detail::pages_of([=]() -> Result<Drawing> { return analysis_picture(all, options); },
                          [=]() -> Result<Report> { return analysis_report(all, options); });
}

Pages edit_pages(const std::vector<Shown>& all, const ReportOptions& options) {
  return detail::pages_of(
      [=]() -> Result<Drawing> {
        std::vector<Drawing> drawings;
        for (const Shown& one : all) drawings.push_back(of_edit(one, options, edit_picture));
        return figure::tile(drawings, 1);
      },
      [=]() -> Result<Report> {
        std::vector<Report> reports;
        for (const Shown& one : all) reports.push_back(of_edit(one, options, edit_report));
        return joined_report(reports, "Edited curves");
      });
}

Result<Pages> handle_pages(const operations::Outcome& outcome, const HandleView& view,
                           const ReportOptions& given) {
  const operations::AnyCurve& curve = *curve_of(outcome);
  if (const auto* space = std::get_if<document::SpaceCurve>(&curve))
    if (const auto* chain = std::get_if<lac::SpaceChain>(&space->value))
      return space_pages(*chain, view, given);
  const auto path = operations::planar_path(curve);
  if (!path) return Pages{};
  const DrawShow show = show_of(view);
  const auto region = region_of(outcome);
  if (!region) return std::unexpected(region.error());
  if (show.region && !*region)
    return core::fail(core::ErrorCode::bad_input, "a drawable region belongs to three handles",
                      "give the points P0 P1 P2, or leave out region", "show");
  const ReportOptions options = titled(given, "Curve from handles", "");
  const auto draw = [=] { return draw_picture(*path, show, *region, options); };
  const auto report = [=] { return draw_report(*path, show, *region, options); };
  return view.show.empty() ? detail::pages_of(draw, report) : detail::pages_with_svg(draw, report);
}

Pages document_pages(document::Document document, const ReportOptions& options) {
  if (document.paths.empty()) exchange::flatten(document);
  if (document.paths.empty() && !document.surfaces.empty()) return surface_pages(document, options);
  const auto shared = std::make_shared<const document::Document>(std::move(document));
  Pages pages = detail::pages_of([=] { return document_picture(*shared, options); },
                                 [=] { return document_report(*shared, options); });
  if (!shared->paths.empty()) pages.erase(".pdf");
  return pages;
}

}  // namespace keyline::presentation
