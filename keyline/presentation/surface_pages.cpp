#include <algorithm>

#include <fmt/format.h>

#include "keyline/core/text.h"
#include "keyline/operations/surface_edit.h"
#include "keyline/presentation/encode.h"
#include "keyline/presentation/fair_report.h"
#include "keyline/presentation/pages.h"
#include "keyline/presentation/surface_pictures.h"

namespace keyline::presentation {
namespace {

using core::Result;
using detail::titled;
using figure::Drawing;
using report::Report;

constexpr std::size_t kMostReports = 12;

std::optional<surface::FieldKind> field_of(Shot shot) {
  using Kind = surface::FieldKind;
  switch (shot) {
    case Shot::lit:
      return {};
    case Shot::zebra:
      return Kind::zebra;
    case Shot::gaussian:
      return Kind::gaussian;
    case Shot::mean:
      return Kind::mean;
    case Shot::principal:
      return Kind::principal;
    case Shot::isophote:
      return Kind::isophote;
    case Shot::reflection:
      return Kind::reflection;
    case Shot::highlight:
      return Kind::highlight;
  }
  return {};
}

SurfaceLook look_of(const SurfaceView& view) {
  SurfaceLook look;
  if (!view.show.empty()) look.shots.clear();
  for (const Shot shot : view.show) look.shots.push_back(field_of(shot));
  look.stripe_count = view.stripes;
  if (view.view) look.view = *view.view - core::Point3{};
  look.lighting.view = look.view;
  return look;
}

SurfaceSubject subject_of(const ShownSurface& shown) {
  SurfaceSubject subject{
      shown.name, shown.surface.surface, {}, shown.no_value, shown.surface.trims};
  if (shown.value) subject.values = shown.value->result_as<operations::SurfaceValueShown>()->values;
  return subject;
}

/// With the values that a report tells.
std::vector<SurfaceSubject> valued(std::vector<SurfaceSubject> subjects) {
  for (SurfaceSubject& s : subjects) {
    if (auto values = surface::sav_by_patch(s.surface))
      s.values = std::move(*values);
    else
      s.no_value = values.error().message;
  }
  return subjects;
}

double sav_of(const SurfaceSubject& s) {
  double sum = 0;
  for (const auto& p : s.values) sum += p.value.sav;
  return sum;
}

Result<Report> surfaces_report(std::vector<SurfaceSubject> subjects, const ReportOptions& options,
                               const SurfaceLook& look) {
  std::stable_sort(subjects.begin(), subjects.end(),
                   [](const auto& a, const auto& b) { return sav_of(a) > sav_of(b); });
  std::vector<Report> reports;
  for (const SurfaceSubject& subject : subjects) {
    if (reports.size() == kMostReports) break;
    auto made = surface_report(subject, options, look);
    if (!made) return std::unexpected(made.error());
    reports.push_back(std::move(*made));
  }
  Report whole = joined_report(reports, "Surface analysis");
  if (subjects.size() > kMostReports)
    whole.notes.push_back(
        {report::NoteKind::note, fmt::format("The {} surfaces of largest SAV out of {} are shown.",
                                             kMostReports, subjects.size())});
  return whole;
}

/// A surface that was edited and how.
struct Edited {
  std::string name;
  surface::Surface given;
  surface::SurfaceEdit edit;
  std::optional<double> limit;

  /// Where the surface is one patch.
  const surface::EditResult* one() const {
    const auto& patches = edit.edited.patches;
    return patches.size() == 1 && patches.front().result ? &*patches.front().result : nullptr;
  }
};

std::vector<Edited> edited_of(const std::vector<operations::NamedSurfaceValue>& given,
                              const operations::SurfacesEditAnswer& answer) {
  std::vector<Edited> all;
  for (std::size_t i = 0; i < given.size(); ++i)
    if (const auto& edit = answer.surfaces[i].edit)
      all.push_back({given[i].name, given[i].surface, *edit->edit, edit->limit});
  return all;
}

Result<Drawing> page_of(const std::vector<Edited>& all, const ReportOptions& given) {
  std::vector<Drawing> pages;
  for (const Edited& e : all) {
    const ReportOptions options = titled(given, "Edited surface", e.name);
    auto page = e.one() ? surface_edit_page(e.edit.grid.patches.front(), *e.one(), options)
                        : surface_edit_page(e.given, e.edit, options);
    if (!page) return page;
    pages.push_back(std::move(*page));
  }
  return figure::stack(pages);
}

Result<Report> report_of(const std::vector<Edited>& all, const ReportOptions& given) {
  std::vector<Report> reports;
  for (const Edited& e : all) {
    const ReportOptions options = titled(given, "Edited surface", e.name);
    auto made = e.one() ? surface_edit_report(e.edit.grid.patches.front(), *e.one(), options)
                        : surface_edit_report(e.given, e.edit, options);
    if (!made) return made;
    made->numbers.push_back({"Limit of the departure",
                             e.limit ? core::number_text(*e.limit, 4) : "none",
                             "of several patches a hundredth of the size unless told"});
    reports.push_back(std::move(*made));
  }
  return joined_report(reports, "Edited surfaces");
}

}  // namespace

Result<void> SurfaceView::check(const SurfaceView& view) {
  if (!view.view || norm(*view.view - core::Point3{}) > 0) return {};
  return core::fail(core::ErrorCode::bad_input, "the view has no direction", "give x,y,z not all 0",
                    "view");
}

Pages surface_pages(const std::vector<ShownSurface>& all, const SurfaceView& view,
                    const ReportOptions& options) {
  std::vector<SurfaceSubject> subjects;
  for (const ShownSurface& one : all) subjects.push_back(subject_of(one));
  const SurfaceLook look = look_of(view);
  return detail::pages_with_svg([=] { return surface_page(subjects, options, look); },
                                [=] { return surfaces_report(subjects, options, look); });
}

Pages surface_pages(const document::Document& document, const ReportOptions& options) {
  std::vector<SurfaceSubject> subjects;
  for (const document::NamedSurface& s : document.surfaces)
    subjects.push_back({s.label.name, s.surface, {}, {}, s.trims});
  return detail::pages_of([=] { return surface_page(subjects, options); },
                          [=] { return surfaces_report(valued(subjects), options, {}); });
}

Pages surface_edit_pages(const std::vector<operations::NamedSurfaceValue>& given,
                         const operations::Outcome& outcome, const ReportOptions& options) {
  const auto all = edited_of(given, *outcome.result_as<operations::SurfacesEditAnswer>());
  return detail::pages_with_svg([=] { return page_of(all, options); },
                                [=] { return report_of(all, options); });
}

}  // namespace keyline::presentation
