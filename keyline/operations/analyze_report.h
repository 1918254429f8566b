#pragma once

#include "keyline/analysis/analyze.h"
#include "keyline/document/planar_curve.h"
#include "keyline/operations/report_options.h"
#include "keyline/report/report.h"

namespace keyline::operations {

using AnalyzeReportOptions = ReportOptions;

/// Steps 3 and 4 of [Fairing] for any curve: the analysis behind the operation curve.analyze, with
/// monotone curvature certified where the curve's type allows it. Pieces are those of the curve's
/// split; noise is the standard deviation of the curve's positions, in its unit.
core::Result<analysis::CurveAnalysis> analyze_path(const document::Path& path, double noise = 0,
                                                   int plot_samples = 401);

/// Whether curvature is monotone, by the certificate of the curve's own type; undecided where there
/// is none (paths of several curves, polylines).
analysis::MonotoneAnswer certified_monotone(const document::Path& path);

/// The report of an analysed curve: curvature plot, comb, evolute, graph and diagram of each
/// monotone piece, all pieces with their readings, continuity at the curve's own joints, and
/// whether curvature is monotone. Pieces count from 0. Graphs of at most 40 pieces.
/// Precondition: `analysis` is of `path`.
report::Report analyze_report(const analysis::CurveAnalysis& analysis, const document::Path& path,
                              const AnalyzeReportOptions& options = {});

}  // namespace keyline::operations
