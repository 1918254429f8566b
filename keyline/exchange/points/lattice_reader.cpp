#include "keyline/exchange/points/lattice_reader.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "keyline/core/coordinate.h"
#include "keyline/core/text.h"
#include "keyline/exchange/file/read_file.h"
#include "keyline/exchange/text/ascii.h"
#include "keyline/exchange/text/line_reader.h"
#include "keyline/exchange/text/text_table.h"

namespace keyline::exchange {
namespace {

using core::ErrorCode;

struct Shape {
  std::size_t rows = 0;
  std::size_t columns = 0;
};

std::optional<Shape> shape_line(std::string_view line) {
  const detail::TableStyle style = detail::guess_style(line);
  const auto fields = detail::split(line, style);
  if (fields.size() != 2) return std::nullopt;
  const auto rows = detail::parse_number(fields[0], style);
  const auto columns = detail::parse_number(fields[1], style);
  const auto whole = [](const std::optional<double>& v) {
    return v && *v >= 1 && *v <= 1e9 && std::floor(*v) == *v;
  };
  if (!whole(rows) || !whole(columns)) return std::nullopt;
  return Shape{static_cast<std::size_t>(*rows), static_cast<std::size_t>(*columns)};
}

bool are_all(const std::vector<std::size_t>& lengths, std::size_t length) {
  return std::ranges::all_of(lengths, [=](std::size_t n) { return n == length; });
}

core::Result<acquire::Lattice> shaped(std::vector<core::Point3> points,
                                      const std::optional<Shape>& given,
                                      const std::vector<std::size_t>& lengths,
                                      const std::string& name) {
  acquire::Lattice lattice;
  if (given) {
    lattice.rows = given->rows;
    lattice.columns = given->columns;
    if (lattice.rows * lattice.columns != points.size()) {
      return core::fail(ErrorCode::bad_input,
                        std::to_string(given->rows) + " x " + std::to_string(given->columns) +
                            " points announced, " + std::to_string(points.size()) + " found",
                        "correct the first line", name);
    }
    if (lengths.size() > 1 && !are_all(lengths, lattice.columns))
      return core::fail(ErrorCode::bad_input,
                        "blank lines part the points into other rows than the " +
                            std::to_string(given->rows) + " of " + std::to_string(given->columns) +
                            " announced",
                        "correct the first line, or leave it out", name);
  } else {
    lattice.rows = lengths.size();
    lattice.columns = lengths.empty() ? 0 : lengths[0];
    for (std::size_t i = 0; i < lengths.size(); ++i) {
      if (lengths[i] == lattice.columns) continue;
      return core::fail(ErrorCode::bad_input,
                        "row " + std::to_string(i) + " has " + core::counted(lengths[i], "point") +
                            ", the first row " + std::to_string(lattice.columns),
                        "give rows of equal length, with nan for missing points", name);
    }
  }
  if (lattice.rows < 2 || lattice.columns < 2) {
    return core::fail(ErrorCode::bad_input, "this is no lattice of rows and columns",
                      "part the rows by blank lines, or start with a line 'rows columns'", name);
  }
  lattice.points = std::move(points);
  return lattice;
}

core::Result<core::Point3> point_of(const std::vector<std::string_view>& fields,
                                    const detail::TableStyle& style, const std::string& place) {
  if (fields.size() > 3)
    return core::fail(ErrorCode::bad_input,
                      "three numbers (x y z) are needed here, not " + std::to_string(fields.size()),
                      "where numbers have a decimal comma, separate columns by ; or blanks", place);
  double value[3] = {0, 0, 0};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto number = k < fields.size() ? detail::parse_number(fields[k], style) : std::nullopt;
    if (!number || core::is_too_large(*number)) {
      return core::fail(ErrorCode::bad_input, "three numbers (x y z) are needed here",
                        "give every point of the lattice all its coordinates", place);
    }
    value[k] = *number;
  }
  return core::Point3{value[0], value[1], value[2]};
}

}  // namespace

core::Result<acquire::Lattice> read_lattice(std::istream& in, const std::string& name) {
  LineReader lines(in, name, PointsOptions{}.longest_line);
  std::vector<core::Point3> points;
  std::vector<std::size_t> lengths;
  std::optional<Shape> shape;
  bool blank = true;
  while (true) {
    bool end = false;
    const auto read = lines.next(end);
    if (!read) return std::unexpected(read.error());
    if (end) break;
    const std::string_view line = detail::trimmed(*read);
    if (line.empty() || detail::is_comment(line)) {
      blank = blank || line.empty();
      continue;
    }
    if (points.empty() && !shape) {
      shape = shape_line(line);
      if (shape) continue;
    }
    const detail::TableStyle style = detail::guess_style(line);
    const auto fields = detail::split(line, style);
    const bool header = points.empty() && !detail::parse_number(fields[0], style);
    if (header) continue;
    const auto point = point_of(fields, style, lines.place());
    if (!point) return std::unexpected(point.error());
    if (blank) lengths.push_back(0);
    blank = false;
    ++lengths.back();
    points.push_back(*point);
  }
  return shaped(std::move(points), shape, lengths, name);
}

core::Result<acquire::Lattice> read_lattice(const std::filesystem::path& path) {
  auto in = open_file(path);
  if (!in) return std::unexpected(in.error());
  return read_lattice(*in, path.string());
}

}  // namespace keyline::exchange
