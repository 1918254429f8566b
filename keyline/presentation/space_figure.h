#pragma once

#include "keyline/figure/drawing.h"
#include "keyline/lac/space/space.h"
#include "keyline/presentation/report_options.h"
#include "keyline/report/report.h"

/// Figures of a log-aesthetic space curve.
namespace keyline::presentation {

/// A view at a slant with the comb of curvature, views along the three axes at one scale, curvature
/// and torsion against arc length, and the logarithmic graphs of both.
figure::Drawing space_picture(const lac::SpaceChain& chain, const ReportOptions& options = {});

/// The same with length, end values and slopes, piece by piece.
report::Report space_report(const lac::SpaceChain& chain, const ReportOptions& options = {});

}  // namespace keyline::presentation
