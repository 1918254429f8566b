#include "keyline/exchange/points/lattice_reader.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "keyline/core/text.h"
#include "keyline/exchange/file/read_file.h"
#include "keyline/exchange/points/points_kind.h"
#include "keyline/exchange/points/space_rows.h"
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

core::Result<core::Point3> point_of(detail::SpaceRows& rows, std::string_view line,
                                    const std::string& place) {
  const auto fields = rows.fields(line);
  if (rows.is_bare() && fields.size() > 3)
    return core::fail(ErrorCode::bad_input,
                      "three numbers (x y z) are needed here, not " + std::to_string(fields.size()),
                      "where numbers have a decimal comma, separate columns by ; or blanks", place);
  return rows.point(fields, line, place);
}

}  // namespace

core::Result<LatticeFile> read_lattice(std::istream& in, const std::string& name,
                                       const PointsOptions& options) {
  LineReader lines(in, name, options.longest_line);
  detail::PointsKind kind;
  detail::SpaceRows rows(options);
  std::vector<core::Point3> points;
  std::vector<std::size_t> lengths;
  std::optional<Shape> shape;
  bool blank = true;
  while (true) {
    bool end = false;
    const auto read = lines.next(end);
    if (!read) return std::unexpected(read.error());
    if (end) break;
    if (auto sound = kind.take(*read, name); !sound) return std::unexpected(sound.error());
    const std::string_view line = detail::trimmed(*read);
    blank = blank || line.empty();
    if (line.empty() || (rows.started() && detail::is_comment(line))) continue;
    if (!rows.started()) {
      if (!shape) {
        shape = shape_line(line);
        if (shape) continue;
      }
      const auto first =
          rows.is_first(detail::trimmed_in_front(*read), lines.number(), lines.place());
      if (!first) return std::unexpected(first.error());
      if (!*first) continue;
    }
    const auto point = point_of(rows, detail::trimmed_in_front(*read), lines.place());
    if (!point) return std::unexpected(point.error());
    if (blank) lengths.push_back(0);
    blank = false;
    ++lengths.back();
    points.push_back(*point);
  }
  auto lattice = shaped(std::move(points), shape, lengths, name);
  if (!lattice) return std::unexpected(lattice.error());
  return LatticeFile{std::move(*lattice), rows.unit(), rows.left_out()};
}

core::Result<LatticeFile> read_lattice(const std::filesystem::path& path,
                                       const PointsOptions& options) {
  auto in = open_file(path);
  if (!in) return std::unexpected(in.error());
  return read_lattice(*in, path.string(), options);
}

}  // namespace keyline::exchange
