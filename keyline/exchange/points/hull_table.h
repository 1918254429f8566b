#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "keyline/core/error.h"
#include "keyline/document/document.h"

/// Offset tables of ships' hulls: half-breadths over stations and waterlines.
namespace keyline::exchange {

/// half_breadth[i * stations.size() + k] at height waterlines[i] and position stations[k]; NaN
/// outside the hull. Both grow.
struct HullTable {
  std::vector<double> waterlines;
  std::vector<double> stations;
  std::vector<double> half_breadth;
  std::string unit = {};                   ///< as of documents; empty where none is stated
  std::vector<std::string> left_out = {};  ///< lines of text behind the rows, rows cut short
};

/// Text parted by commas, semicolons or tabs: after comments and lines of one or two cells (the
/// unit among them: "unit,ft"), a line of "waterline" (or "WL", with a unit in brackets: "WL [m]")
/// and the stations; every further line the height of a waterline and its half-breadths, empty or
/// dashes outside the hull. Or "station" ("ST") first and the two exchanged. Heights and stations
/// may have their names before them ("WL 0.5"), which is told. Rows and columns in any order.
/// Numbers plain, as fractions (3 1/2) or, in feet, as feet-inches-eighths (2-3-4, and 2-3-4+ for a
/// sixteenth more). Text behind the rows is `left_out`, and cells that a row has fewer than the
/// first line, which are outside the hull. Fails: bad_input with "line N", also where a station or
/// a waterline stands twice or a half-breadth is negative.
core::Result<HullTable> read_hull_csv(std::string_view text);
bool is_hull_csv(std::string_view head);

/// Space curves through the table's points (x along, y half-breadth, z height): "waterline-1" … and
/// "station-1" … (indices of the table from 1) on the layers "waterlines" and "stations", and
/// "buttock-1" to "buttock-3" at a quarter, half and three quarters of the largest half-breadth on
/// "buttocks", where straight lines between the table's points of a station first reach it from
/// below. Points without hull end a curve; of a run of zeros at an end the innermost is kept.
/// Skipped: curves of fewer than two points, counted.
document::Document hull_document(const HullTable& table);

}  // namespace keyline::exchange
