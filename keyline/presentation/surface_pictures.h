#pragma once

#include <optional>
#include <string>
#include <vector>

#include "keyline/figure/drawing.h"
#include "keyline/figure/surface_view.h"
#include "keyline/presentation/report_options.h"
#include "keyline/report/report.h"
#include "keyline/surface/edit_patches.h"
#include "keyline/surface/interrogate.h"
#include "keyline/surface/network.h"

namespace keyline::presentation {

/// What a picture of surfaces shows.
struct SurfacePicture {
  std::string title = {};
  std::optional<surface::FieldKind> field = {};  ///< empty: lit, with lines of constant u and v
  surface::Lighting lighting = {};               ///< common to all surfaces
  std::optional<double> stripe_count = {};       ///< of a zebra; empty: stripes_for()
  std::string unit = {};
  int grid = 0;  ///< points along u and v of each surface; 0: 161, fewer for many surfaces
  double width = 470;
  std::optional<core::Interval> range = {};  ///< of a curvature map; empty: without the outer 2 %
  std::optional<core::Vector3> view = {};    ///< empty: obliquely on the mean normal
};

/// The range of the finite values without the outer 2 % at either end; [0, 1] where there is none.
core::Interval usual_range(std::vector<double> values);

/// Pairs of stripes at which about eight show on the surfaces: 12 to 400.
double stripes_for(const std::vector<surface::Surface>& surfaces);

/// The surfaces in one picture, at one view and scale. principal shows the larger one.
/// Fails as surface::interrogate does.
core::Result<figure::Drawing> surface_picture(const std::vector<surface::Surface>& surfaces,
                                              const SurfacePicture& options = {});

/// Curvature of the network curves against arc length, rows on the left, columns on the right
/// ([Oya] Figs. 9 to 12), as it shows in each curve's mean plane; positive where the curve bends
/// towards the mean normal of the patch on the whole.
figure::Drawing network_profiles(const surface::BezierSurface& s, const std::string& title,
                                 const std::string& unit = {});

/// Which pictures a report or page shows, and how the light stands in them.
struct SurfaceLook {
  /// Empty member: lit.
  std::vector<std::optional<surface::FieldKind>> shots = {
      {}, surface::FieldKind::zebra, surface::FieldKind::gaussian, surface::FieldKind::mean};
  std::optional<core::Vector3> view = {};   ///< of the picture; empty: obliquely on the mean normal
  std::optional<double> stripe_count = {};  ///< of the zebra
  surface::Lighting lighting = {};
};

/// One surface of a file with its value.
struct SurfaceSubject {
  std::string name;
  surface::Surface surface;
  std::vector<surface::PatchValue> values;  ///< empty where it has none
  std::string no_value;                     ///< then: why
  int trims = 0;                            ///< edges that cut a face out of it in its file
};

/// SAV by patch and curve with the worst named, pictures (lit, zebra, curvature), network profiles
/// of the worst patch. Fails as surface_picture does.
core::Result<report::Report> surface_report(const SurfaceSubject& subject,
                                            const ReportOptions& options = {},
                                            const SurfaceLook& look = {});

/// One page of the same pictures for all surfaces of a file.
core::Result<figure::Drawing> surface_page(const std::vector<SurfaceSubject>& subjects,
                                           const ReportOptions& options = {},
                                           const SurfaceLook& look = {});

/// Before and after an edit: zebra, mean curvature and network profiles on one page.
core::Result<figure::Drawing> surface_edit_page(const surface::BezierSurface& given,
                                                const surface::EditResult& edited,
                                                const ReportOptions& options = {});

/// The same as a report, with the table of curves before and after and the trade-off.
core::Result<report::Report> surface_edit_report(const surface::BezierSurface& given,
                                                 const surface::EditResult& edited,
                                                 const ReportOptions& options = {});

/// Of a surface of several patches: zebra and mean curvature before and after; in the report the
/// tables of patches and joints too.
core::Result<figure::Drawing> surface_edit_page(const surface::Surface& given,
                                                const surface::SurfaceEdit& edit,
                                                const ReportOptions& options = {});
core::Result<report::Report> surface_edit_report(const surface::Surface& given,
                                                 const surface::SurfaceEdit& edit,
                                                 const ReportOptions& options = {});

}  // namespace keyline::presentation
