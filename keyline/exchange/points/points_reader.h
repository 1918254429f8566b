#pragma once

#include <cstddef>
#include <filesystem>
#include <istream>
#include <string>
#include <vector>

#include "keyline/acquire/raw_curve.h"
#include "keyline/core/error.h"

namespace keyline::exchange {

/// What the reader finds out by itself and may be told instead. Columns are named as in the
/// file's header (letter case and units aside) or numbered from 1.
struct PointsOptions {
  std::vector<std::string> columns;  ///< x, y and maybe z; empty: by header, else the first ones
  std::string weight_column;         ///< empty: a column named w, weight or weights
  std::string id_column;             ///< empty: a column named id, curve or name
  char separator = 0;                ///< 0: found out; ' ' stands for any white space
  bool blank_lines_part = true;      ///< rows into curves of their own; false of a cloud
  std::size_t longest_line = 1 << 20;
};

struct PointsFile {
  std::vector<acquire::RawCurve> curves;
  std::string unit;  ///< of documents; empty where the columns taken tell none
};

/// Reads points from text: columns separated by commas, semicolons, bars, tabs or spaces (decimal
/// commas where semicolons, tabs or spaces separate), one point per line, maybe in brackets.
///
/// - Comment lines start with #, %, // or !; a header line (also a comment) of names chooses the
///   columns, and units after their names ("x [mm]", "x_m") or in a line of units alone behind
///   them ("mm,mm") the unit. Without a header the first two or three columns are x, y, z; a fourth
///   and later ones are ignored and noted.
/// - Airfoil files: title lines before the points are noted; text behind them (lines with words,
///   not of a row's shape) and a line of more or fewer numbers before them, as a window's, are
///   `left_out`; Lednicer files (counts of both sides first, maybe off) become one curve from
///   trailing edge over the nose to trailing edge; points (999, 999) part elements.
/// - Lists of nodes (.node and .poly of Triangle and TetGen): the first line's counts and the
///   numbers of nodes are no points, what follows the nodes is `left_out`, and fewer or others are
///   a failure. Files of Tecplot: VARIABLES is the header, a ZONE starts a curve, and one whose
///   numbers are no list of points, or not as many as its I, J and K tell, is a failure.
/// - A line of text between rows starts a curve of that name where three or more rows stand on both
///   sides of it, and is a failure elsewhere; likewise a number by itself that counts the rows
///   behind it. Where no rows follow, it is `left_out`.
/// - An id column makes one curve for each id, in order of first appearance.
/// - A header of upper and lower y over one x ("x yu yl", "station,upper,lower"), or with an x of
///   each ("xu,yu,xl,yl"), makes two curves, named after the columns ("yu"), behind the curve's own
///   name, if any ("wing/yu").
/// - Blank lines part rows into curves, as part_blocks says; not where an id column names them.
/// - Numbers behind the columns of the first row are `left_out`, and a failure where commas
///   separate: a decimal comma makes two of one number. A row that ends before columns in which the
///   first has numbers is a failure: which of its own are missing nobody knows. So is one of more
///   than the first, where the header has not as many.
/// - Missing entries (empty, nan, inf, null, NA, #N/A) give non-finite coordinates, left to
///   acquire_key_line to count and drop.
///
/// Fails: bad_input with path "file:line" for text where a number belongs, too few columns, an
/// unknown column, columns of two units, values above 1e100, binary content, a line longer than
/// longest_line, or no points at all; io where the file cannot be opened or read. Memory: that of
/// the points.
core::Result<PointsFile> read_points_file(const std::filesystem::path& path,
                                          const PointsOptions& options = {});

/// The curves alone.
core::Result<std::vector<acquire::RawCurve>> read_points(const std::filesystem::path& path,
                                                         const PointsOptions& options = {});

/// The same from an open stream; `name` stands for the file in failures.
core::Result<std::vector<acquire::RawCurve>> read_points(std::istream& in, const std::string& name,
                                                         const PointsOptions& options = {});

}  // namespace keyline::exchange
