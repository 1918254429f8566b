#pragma once

#include "keyline/analysis/analyze.h"
#include "keyline/document/planar_curve.h"
#include "keyline/operations/curve_analyze.h"
#include "keyline/presentation/report_options.h"
#include "keyline/report/report.h"

namespace keyline::presentation {

using AnalyzeReportOptions = ReportOptions;

/// The report of an analysed curve: curvature plot, comb, evolute, graph and diagram of each
/// monotone piece, all pieces with their readings, continuity at the curve's own joints, and
/// whether curvature is monotone. Pieces count from 0. Graphs of at most 40 pieces.
/// Precondition: `analysis` is of `path`.
report::Report analyze_report(const analysis::CurveAnalysis& analysis, const document::Path& path,
                              const AnalyzeReportOptions& options = {});

}  // namespace keyline::presentation
