#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "keyline/core/describe.h"
#include "keyline/core/error.h"
#include "keyline/operations/document_read.h"
#include "keyline/operations/document_write.h"
#include "keyline/operations/perform.h"
#include "keyline/presentation/report_options.h"

/// What operations answered as pictures and reports: .html, .pdf, .png and, where a picture says
/// more than the bare curve, .svg.
namespace keyline::presentation {

/// The content of a file by its extension, made when asked for.
using Pages = std::map<std::string, std::function<core::Result<std::string>()>>;

/// What an operation answered about one thing of a file.
struct Shown {
  std::string name;
  operations::Outcome outcome;
};

/// Of `fair`. Pages of several key-lines follow each other; many pictures stand side by side too.
/// Precondition: every outcome is of `fair`.
Pages fair_pages(const std::vector<Shown>& all, const ReportOptions& options);

/// Of curve.analyze; with the curve's place in the alpha-s plane where curve.cav answered too.
struct ShownAnalysis {
  Shown analysis;
  std::optional<operations::Outcome> class_a;
};
Pages analysis_pages(const std::vector<ShownAnalysis>& all, const ReportOptions& options);

/// Of curve.edit.
Pages edit_pages(const std::vector<Shown>& all, const ReportOptions& options);

/// A curve of curve.cav: "type 3, one matrix outside Class A".
std::string type_in_words(int type);

/// Pictures of a surface.
enum class Shot { lit, zebra, gaussian, mean, principal, isophote, reflection, highlight };
constexpr auto choices(const Shot*) {
  return core::words<Shot>({{Shot::lit, "lit"},
                            {Shot::zebra, "zebra"},
                            {Shot::gaussian, "gaussian"},
                            {Shot::mean, "mean"},
                            {Shot::principal, "principal"},
                            {Shot::isophote, "isophote"},
                            {Shot::reflection, "reflection"},
                            {Shot::highlight, "highlight"}});
}

/// How surfaces are shown.
struct SurfaceView {
  std::vector<Shot> show;
  std::optional<core::Point3> view;
  std::optional<double> stripes;
  static constexpr auto describe() {
    return core::fields(
        core::field<&SurfaceView::show>(
            "pictures of surfaces; lit, zebra, gaussian and mean unless given"),
        core::field<&SurfaceView::view>("direction to the eye; else on the mean normal"),
        core::field<&SurfaceView::stripes>(
            "zebra: black and white pairs to the half turn; else about eight show")
            .within(core::kPositive));
  }
  /// Fails: bad_input where the view has no direction.
  static core::Result<void> check(const SurfaceView& view);
};

/// A surface with the answer of surface.sav, or why there is none.
struct ShownSurface {
  std::string name;
  operations::NamedSurfaceValue surface;
  std::optional<operations::Outcome> value;
  std::string no_value;
};
Pages surface_pages(const std::vector<ShownSurface>& all, const SurfaceView& view,
                    const ReportOptions& options);

/// Of a document's surfaces, with their values and the usual pictures. No .svg: one of a document
/// holds its curves.
Pages surface_pages(const document::Document& document, const ReportOptions& options);

/// Of surface.edit_together about these surfaces.
Pages surface_edit_pages(const std::vector<operations::NamedSurfaceValue>& given,
                         const operations::Outcome& outcome, const ReportOptions& options);

/// Figures of a curve from handles.
enum class HandleFigure { comb, evolute, lcg, region };
constexpr auto choices(const HandleFigure*) {
  return core::words<HandleFigure>({{HandleFigure::comb, "comb"},
                                    {HandleFigure::evolute, "evolute"},
                                    {HandleFigure::lcg, "lcg"},
                                    {HandleFigure::region, "region"}});
}
struct HandleView {
  std::vector<HandleFigure> show;
  static constexpr auto describe() {
    return core::fields(
        core::field<&HandleView::show>("figures in svg, pdf, png and html; else the comb alone"));
  }
};

/// Of an operation lac.* that makes a curve.
/// Fails: bad_input for a region without three handles, for figures of a curve in space.
core::Result<Pages> handle_pages(const operations::Outcome& outcome, const HandleView& view,
                                 const ReportOptions& options);

/// A document's planar curves to look at, of one without any its surfaces. No .pdf of curves:
/// document.write makes one in real size.
Pages document_pages(document::Document document, const ReportOptions& options);

/// Of sketch.trace with stages: a picture of every stage, name ("01-log.png") and content.
/// Precondition: the outcome is of sketch.trace.
core::Result<std::vector<std::pair<std::string, std::string>>> stage_pictures(
    const operations::Outcome& outcome);

}  // namespace keyline::presentation
