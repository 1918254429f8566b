#pragma once

#include <optional>
#include <string>
#include <vector>

#include "keyline/core/error.h"
#include "keyline/document/planar_curve.h"
#include "keyline/figure/drawing.h"
#include "keyline/presentation/report_options.h"
#include "keyline/report/report.h"

/// Figures of a curve drawn from handles.
namespace keyline::presentation {

/// Which figures are wanted.
struct DrawShow {
  bool comb = false;
  bool evolute = false;
  bool lcg = false;
  bool region = false;
};

/// The slopes a drawable region belongs to and the triangle that was asked for.
struct RegionQuestion {
  std::vector<double> alpha;  ///< one, or two with ratio
  double ratio = 0.5;
  double theta = 0;  ///< turning from P0P1 to P1P2
  double psi = 0;    ///< angle from P0P1 to P0P2
};
/// From three handles; bad_input where they make no triangle.
core::Result<RegionQuestion> region_question(const std::vector<core::Point2>& points,
                                             std::vector<double> alpha, double ratio);

/// The chord angles that can be met against the turning, with the triangle asked for marked.
figure::Drawing region_chart(const RegionQuestion& question);

/// The figures asked for, one below the other; of none, the curvature comb. A region is left out
/// without its question.
core::Result<figure::Drawing> draw_picture(const document::Path& path, const DrawShow& show,
                                           const std::optional<RegionQuestion>& region,
                                           const ReportOptions& options = {});

/// The report of the curve's analysis, with the region where asked for.
core::Result<report::Report> draw_report(const document::Path& path, const DrawShow& show,
                                         const std::optional<RegionQuestion>& region,
                                         const ReportOptions& options = {});

}  // namespace keyline::presentation
