#pragma once

#include <string>
#include <vector>

#include "keyline/acquire/key_line.h"
#include "keyline/analysis/analyze.h"
#include "keyline/core/error.h"
#include "keyline/document/planar_curve.h"
#include "keyline/exchange/svg_writer.h"
#include "keyline/fairing/fair.h"
#include "keyline/figure/drawing.h"
#include "keyline/operations/report_options.h"

namespace keyline::operations {

/// One page: points and faired curve with the comb of deviations, curvature before and after, and
/// the curvature comb. Of the options title, subtitle and unit are used.
figure::Drawing fair_picture(const acquire::KeyLine& line, const fairing::FairResult& result,
                             const ReportOptions& options = {});

/// One page: curvature, comb and evolute of an analysed curve.
figure::Drawing analyze_picture(const analysis::CurveAnalysis& analysis, const document::Path& path,
                                const ReportOptions& options = {});

/// A path as one SVG path of cubic Béziers, G1 but at its corners, as few as the tolerance allows.
struct CubicPath {
  exchange::SvgPath path;
  double deviation = 0;  ///< bound of the distance from the exact path
};
/// Throws InvalidInput unless tolerance > 0. A path that closes to within 1e-9 of its size ends
/// exactly where it starts.
CubicPath cubic_path(const document::Path& path, const std::string& name, double tolerance);

/// The layer of a faired key-line, as fair_svg() writes it.
std::vector<exchange::SvgLayer> fair_layers(const fairing::FairResult& result,
                                            const std::string& name, double tolerance);

/// The faired curve as an SVG file: cubic Béziers within `tolerance`, the bound they meet in the
/// title, and `metadata`, the exact curve as JSON, for reading it back.
/// Fails as exchange::write_svg does; bad_input for a tolerance that is not positive.
core::Result<std::string> fair_svg(const fairing::FairResult& result, double tolerance,
                                   const std::string& unit, const std::string& metadata);

}  // namespace keyline::operations
