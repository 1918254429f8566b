#pragma once

#include <string>
#include <vector>

#include "keyline/classa/edit.h"
#include "keyline/classa/free_form.h"
#include "keyline/figure/class_a_charts.h"
#include "keyline/figure/drawing.h"
#include "keyline/presentation/report_options.h"
#include "keyline/report/report.h"

/// Figures and reports of room classa.
namespace keyline::presentation {

/// A curve to be shown in the plane.
struct PlaneEntry {
  std::string name;
  const classa::Evaluation* evaluation;
};

/// The alpha-s plane with the places of the curves (of types 4 and 5: the nearest curve with one
/// matrix), the minimum of the first, contours of strain energy for its chord and degree, and the
/// line of curves that keep its ends and start tangent.
figure::Drawing plane_chart(const std::vector<PlaneEntry>& curves,
                            const classa::CavOptions& options,
                            const std::vector<core::Point2>& path = {});

/// One page: both curves, curvature before and after, the plane.
figure::Drawing edit_picture(const classa::EditResult& edited, const classa::Approximation& given,
                             const classa::EditOptions& options, const ReportOptions& report = {});

/// The same with values in words and numbers.
report::Report edit_report(const classa::EditResult& edited, const classa::Approximation& given,
                           const classa::EditOptions& options, const ReportOptions& report = {});

/// "Class A" for the report of an analysed curve: the value of curves[index], and its place in the
/// plane among all of them.
report::Section class_a_section(const std::vector<PlaneEntry>& curves, std::size_t index,
                                const classa::CavOptions& options);

}  // namespace keyline::presentation
