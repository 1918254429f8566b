#include "keyline/report/report.h"

namespace keyline::report {

namespace {

/// Without the columns that say nothing in any row.
ReportTable without_empty_columns(const ReportTable& table) {
  ReportTable kept;
  kept.caption = table.caption;
  kept.rows.resize(table.rows.size());
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    bool says_something = false;
    for (const auto& row : table.rows) says_something |= !row[c].empty();
    if (!says_something) continue;
    kept.columns.push_back(table.columns[c]);
    for (std::size_t r = 0; r < table.rows.size(); ++r) kept.rows[r].push_back(table.rows[r][c]);
  }
  return kept;
}

}  // namespace

ReportTable piece_table(const std::vector<PieceRow>& rows) {
  ReportTable table{"Pieces in order along the curve",
                    {{"Piece"},
                     {"Rhythm", Alignment::text},
                     {"Slope \u03B1"},
                     {"Length"},
                     {"Radius start \u2026 end"},
                     {"Turning"},
                     {"Volume"},
                     {"Impression", Alignment::text}},
                    {}};
  for (const PieceRow& row : rows)
    table.rows.push_back({std::to_string(table.rows.size() + 1), row.rhythm, row.slope, row.length,
                          row.radii, row.turning, row.volume, row.impression});
  return without_empty_columns(table);
}

ReportTable joint_table(const std::vector<JointRow>& rows) {
  ReportTable table{"Continuity where pieces meet",
                    {{"Joint", Alignment::text},
                     {"Gap"},
                     {"Angle"},
                     {"Curvature jump"},
                     {"Curvature rate jump"},
                     {"Order", Alignment::text}},
                    {}};
  for (const JointRow& row : rows)
    table.rows.push_back(
        {row.between, row.gap, row.angle, row.curvature_jump, row.rate_jump, row.order});
  return without_empty_columns(table);
}

}  // namespace keyline::report
