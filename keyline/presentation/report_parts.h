#pragma once

#include <string>
#include <vector>

#include "keyline/analysis/continuity.h"
#include "keyline/analysis/lcg.h"
#include "keyline/analysis/lddc.h"
#include "keyline/analysis/rhythm.h"
#include "keyline/presentation/report_options.h"
#include "keyline/report/report.h"

/// What the reports of fairing and of analysis share.
namespace keyline::presentation::detail {

/// A report of its head alone; `title` where the options give none.
report::Report headed(const ReportOptions& options, std::string title);

/// "12.3 mm", with a no-break space; "12.3" without a unit.
std::string length_text(double value, const std::string& unit, int significant = 4);
/// "radius 120 mm" as "120 mm"; "∞" for a straight end.
std::string radii_text(double curvature_start, double curvature_end, const std::string& unit);
/// "0.12 mm²".
std::string area_text(double value, const std::string& unit);
/// "−1.02" or "−1.02, 0.5"; empty without slopes.
std::string slopes_text(const std::vector<double>& slopes);
/// "plus 0.67 (62 %), arc (38 %)": the first few plausible readings, best first.
std::string readings_text(const std::vector<analysis::Interpretation>& interpretations);

report::JointRow joint_row(const std::string& between, const analysis::JointContinuity& joint,
                           const std::string& unit);

/// Values may break at their unit: they stand in narrow boxes.
void let_units_wrap(std::vector<report::KeyNumber>& numbers);

/// What stands in the two diagrams of a piece.
struct PieceGraphs {
  std::string name;   ///< "Piece 3 · minus"
  double length = 0;  ///< longest pieces go first where there are too many
  analysis::Lcg lcg;  ///< of the piece
  analysis::Lddc lddc;
  analysis::Lcg before;  ///< of the points' spline over the same stretch; may be undefined
  analysis::Lddc before_lddc;
};

/// Charts side by side for a few pieces, in compact sheets for many; at most 40 pieces. `text`
/// gets a sentence on pieces that have no graph and on those left out.
void add_graphs(report::Section& section, const std::vector<PieceGraphs>& pieces);

}  // namespace keyline::presentation::detail
