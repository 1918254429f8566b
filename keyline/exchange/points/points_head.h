#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "keyline/core/error.h"
#include "keyline/exchange/points/points_columns.h"
#include "keyline/exchange/points/points_reader.h"
#include "keyline/exchange/points/points_sides.h"
#include "keyline/exchange/text/header_unit.h"
#include "keyline/exchange/text/text_table.h"

namespace keyline::exchange::detail {

/// What stands before the rows of a table, titles and a header with names and units, and what it
/// and the first row tell of the rows.
struct PointsHead {
  TableStyle style;             ///< of the rows
  bool fraction_known = false;  ///< whether style.decimal_comma is settled
  bool text_id = false;         ///< rows begin with a name
  bool pairs = false;           ///< commas without and with a blank take turns in the first row
  std::vector<std::string> names;
  std::vector<HeaderUnit> units;  ///< of the columns that have names
  std::optional<Sides> sides;     ///< what the header says of two curves
  char separator = 0;             ///< of the header
  bool counts = false;            ///< it is a comment: its mark may stand for a number of the point
  int line = 0;
  std::string variables;            ///< of Tecplot, as far as they have been read
  std::vector<std::string> titles;  ///< lines of text, the first some of them
  std::size_t text_lines = 0;       ///< all of them
  std::string first_text;           ///< shortened
  std::string last_text;
  std::size_t headed = 0;  ///< columns that the last of them heads with names not looked for
  bool unknown = false;    ///< as many as the first row has
  std::string said_unit;   ///< by a line of text

  /// Whether there is no line of text but one that heads the columns.
  bool has_no_title() const { return text_lines == 0 || (unknown && text_lines == 1); }
};

/// Takes a line, unless it is the first row of numbers.
/// Returns: whether it is. Fails: bad_input where it is a row with text in it.
core::Result<bool> is_first_row(PointsHead& head, const PointsOptions& options,
                                std::string_view line, int number, const std::string& place);

/// The columns of a table with that head and first row.
/// Fails: bad_input where a column asked for is not there, or decimal commas have parted numbers.
core::Result<PointsColumns> columns_below(PointsHead& head, const PointsOptions& options,
                                          const std::vector<std::string_view>& first_row,
                                          const std::string& place);

/// The first row with a fraction in it tells whether a comma parts it or a point.
void meet_fraction(PointsHead& head, std::string_view line);

/// Columns of a first row of that width behind those that are looked for, or that have names.
std::size_t further_columns(const PointsHead& head, std::size_t width);

/// These, and columns to which the head gives other names than are looked for, in words.
std::vector<std::string> columns_beside(const PointsHead& head, const PointsColumns& columns,
                                        std::size_t further);

/// The unit that the head gives the coordinates; empty: none. Units that are not known are told.
/// Fails: bad_input where it gives them two.
core::Result<std::string> unit_below(const PointsHead& head, const PointsColumns& columns,
                                     const std::string& place, std::vector<std::string>& left_out);

/// Of the lines before the rows: titles behind the first, and names of columns that are not looked
/// for.
std::vector<std::string> left_out_above(const PointsHead& head);

}  // namespace keyline::exchange::detail
