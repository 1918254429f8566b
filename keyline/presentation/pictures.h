#pragma once

#include "keyline/acquire/key_line.h"
#include "keyline/analysis/analyze.h"
#include "keyline/document/planar_curve.h"
#include "keyline/fairing/fair.h"
#include "keyline/figure/drawing.h"
#include "keyline/presentation/report_options.h"

namespace keyline::presentation {

/// One page: points and faired curve with the comb of deviations, curvature before and after, and
/// the curvature comb. Of the options title, subtitle and unit are used.
figure::Drawing fair_picture(const acquire::KeyLine& line, const fairing::FairResult& result,
                             const ReportOptions& options = {});

/// One page: curvature, comb and evolute of an analysed curve.
figure::Drawing analyze_picture(const analysis::CurveAnalysis& analysis, const document::Path& path,
                                const ReportOptions& options = {});

}  // namespace keyline::presentation
