#pragma once

#include <vector>

#include "keyline/acquire/key_line.h"
#include "keyline/core/interval.h"
#include "keyline/fairing/fair.h"
#include "keyline/presentation/report_options.h"
#include "keyline/report/report.h"

namespace keyline::presentation {

using FairReportOptions = ReportOptions;

/// The report of one faired key-line, as plain data for report::html_report.
///
/// Says:     what became of the points (overlay with an exaggerated comb of deviations), curvature
///           of the points' spline against the chain's, curvature comb, evolute, graph and
///           diagram of each piece with lines and slopes, all pieces with their readings and what
///           a surfacer would look at again (needles, near-steps, pieces too short to be seen,
///           slopes at their limits; ringed in the comb), all joints, every note of the result, and
///           what repeats the run.
/// Numbers:  pieces count from 0, as `--interpretation PIECE:RHYTHM` counts them.
/// Verdict:  good within the tolerance; caution where the work was cancelled; bad where a point
///           lies beyond the tolerance, with where.
/// Size:     at most 2,000 points are drawn, the worst of each stretch among them; graphs of at
///           most 40 pieces, the longest ones.
/// slopes:   the limits of the pieces' slopes that were in force.
/// Precondition: `result` came from fairing::fair on `line` (InvalidInput where its offsets and
///           the points differ in number).
report::Report fair_report(const acquire::KeyLine& line, const fairing::FairResult& result,
                           const FairReportOptions& options = {},
                           core::Interval slopes = fairing::FairOptions{}.slopes);

/// Several reports as one: sections of each under its title, the worst verdict for the whole.
/// One report comes back as it is; none gives an empty report. What repeats the run is the first
/// one's.
report::Report joined_report(const std::vector<report::Report>& reports, const std::string& title);

}  // namespace keyline::presentation
