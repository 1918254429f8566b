#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "keyline/core/error.h"
#include "keyline/exchange/points/points_columns.h"
#include "keyline/exchange/text/text_table.h"

namespace keyline::exchange::detail {

/// What the first line of a list of nodes of TetGen and Triangle says of the rows behind it.
struct NodeCounts {
  std::size_t nodes = 0;
  std::size_t others = 0;  ///< columns behind the coordinates: attributes and a mark
  double first = 0;        ///< number of the first node
  bool in_space = false;

  PointsColumns columns() const { return {1, 2, in_space ? 3 : PointsColumns::kNone}; }

  /// Whether a row has the number that follows so many nodes.
  bool is_next(const std::vector<std::string_view>& row, const TableStyle& style,
               std::size_t before) const;
  core::Failure out_of_turn(const std::vector<std::string_view>& row,
                            const std::string& place) const;
  core::Failure too_few(std::size_t read, const std::string& place) const;
};

/// The numbers of a row, -1 for what is none.
std::vector<double> numbers_of(const std::vector<std::string_view>& fields,
                               const TableStyle& style);

/// Whether a first row counts nodes, dimensions (2 or 3), attributes and marks, and the second is
/// such a node, numbered 0 or 1: as the node files of Triangle, and of TetGen in space.
std::optional<NodeCounts> node_counts(const std::vector<double>& first,
                                      const std::vector<std::string_view>& second,
                                      const TableStyle& style);

/// What the rest of a line is that names the variables of a file of Tecplot: VARIABLES = "X", "Y";
/// further ones may stand in the lines behind it, in quotes.
std::optional<std::string_view> tecplot_variables(std::string_view line);

/// Whether a line is the head of a zone of Tecplot: ZONE T="wing", I=80.
bool is_tecplot_zone(std::string_view line);

/// Whether a line behind that one, or behind such a line, still belongs to it: I=80, F=POINT.
bool goes_on_with_zone(std::string_view line);

/// How many points a zone of Tecplot tells of, I times J times K, in one or several lines.
struct ZoneCount {
  std::size_t before = 0;        ///< rows that stand before the zone
  std::string place;             ///< of its first line
  std::optional<double> points;  ///< none where none of the three is told

  void take(std::string_view line);
  /// Fails: bad_input where others than its points stand up to the row of that number.
  core::Result<void> check(std::size_t rows) const;
};

/// What a line of Tecplot calls the file or a zone: TITLE = "wing", ZONE T="upper"; empty where it
/// does not.
std::string tecplot_title(std::string_view line);

/// Whether a line of that zone says that its numbers are other than one point in each row: variable
/// by variable, or with elements behind them.
bool is_zone_of_blocks(std::string_view line);

}  // namespace keyline::exchange::detail
