#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <optional>

#include "keyline/exchange/document_file.h"
#include "keyline/exchange/format.h"
#include "keyline/exchange/line_reader.h"
#include "keyline/exchange/mesh.h"
#include "keyline/exchange/ply_header.h"
#include "keyline/exchange/text_table.h"

namespace keyline::exchange {
namespace {

using core::ErrorCode;
using core::Point3;
using core::Result;
using Take = std::function<void(Point3)>;

/// The first three numbers of a line; empty for a header, a count or a comment before the points.
Result<std::optional<Point3>> point_of(std::string_view line, const LineReader& lines,
                                       bool started) {
  line = detail::trimmed(line);
  if (line.empty() || detail::is_comment(line)) return std::nullopt;
  const detail::TableStyle style = detail::guess_style(line);
  const auto fields = detail::split(line, style);
  std::array<double, 3> c{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto value =
        k < fields.size() ? detail::parse_number(fields[k], style) : std::optional<double>();
    if (!value && (!started || fields.size() == 1)) return std::nullopt;  // header, count of a part
    if (!value || (std::isfinite(*value) && std::abs(*value) > 1e100))
      return core::fail(ErrorCode::bad_input, "three numbers (x y z) are needed here",
                        "give every point all its coordinates", lines.place());
    c[k] = *value;
  }
  return Point3{c[0], c[1], c[2]};
}

Result<void> stream_text(std::istream& in, const std::string& name, const Take& take) {
  LineReader lines(in, name, std::size_t{1} << 20);
  bool started = false;
  while (true) {
    bool end = false;
    const auto line = lines.next(end);
    if (!line) return std::unexpected(line.error());
    if (end) break;
    const auto p = point_of(*line, lines, started);
    if (!p) return std::unexpected(p.error());
    if (!*p) continue;
    started = true;
    if (core::is_finite(**p)) take(**p);
  }
  if (started) return {};
  return core::fail(ErrorCode::bad_input, "there are no points in it",
                    "give x, y and z on each line", name);
}

/// Vertices of a fixed size, a million bytes at a time.
Result<void> stream_vertices(std::istream& in, const detail::PlyHeader& header,
                             const detail::PlyElement& vertex, const Take& take) {
  std::size_t row = 0;
  for (const auto& property : vertex.properties) row += size_of(property.type);
  const std::size_t rows = std::max<std::size_t>(1, (std::size_t{1} << 20) / row);
  detail::PlyHeader chunk_header = header;
  chunk_header.size = 0;
  std::string chunk;
  std::size_t at = header.size;
  in.clear();
  in.seekg(static_cast<std::streamoff>(at));
  for (std::size_t done = 0; done < vertex.count; done += rows) {
    chunk.resize(row * std::min(rows, vertex.count - done));
    in.read(chunk.data(), static_cast<std::streamsize>(chunk.size()));
    if (static_cast<std::size_t>(in.gcount()) != chunk.size())
      return core::fail(ErrorCode::bad_input, "the file ends before its last vertex",
                        "check that it is complete",
                        "byte " + std::to_string(at + static_cast<std::size_t>(in.gcount())));
    at += chunk.size();
    detail::PlyValues values(chunk, chunk_header);
    for (std::size_t i = 0; i * row < chunk.size(); ++i) {
      Point3 p;
      for (const auto& property : vertex.properties) {
        const double value = values.next(property.type).value();
        if (property.name == "x") p.x = value;
        if (property.name == "y") p.y = value;
        if (property.name == "z") p.z = value;
      }
      if (core::is_finite(p)) take(p);
    }
  }
  return {};
}

Result<void> stream_ply(std::istream& in, const std::filesystem::path& file, const Take& take) {
  std::string head(std::size_t{1} << 20, '\0');
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(in.gcount()));
  const auto header = detail::read_ply_header(head);
  if (!header) return std::unexpected(header.error());
  const auto& elements = header->elements;
  const bool plain =
      header->binary && !elements.empty() && elements.front().name == "vertex" &&
      !elements.front().properties.empty() &&
      std::none_of(elements.front().properties.begin(), elements.front().properties.end(),
                   [](const detail::PlyProperty& p) { return p.count.has_value(); });
  if (plain) return stream_vertices(in, *header, elements.front(), take);
  const auto mesh = read_mesh(file);
  if (!mesh) return std::unexpected(mesh.error());
  for (const Point3 p : mesh->points)
    if (core::is_finite(p)) take(p);
  return {};
}

}  // namespace

Result<void> stream_points(const std::filesystem::path& file, const Take& take) {
  if (const auto head = head_of(file); !head) return std::unexpected(head.error());
  std::ifstream in(file, std::ios::binary);
  const auto done = extension_of(file) == ".ply" ? stream_ply(in, file, take)
                                                 : stream_text(in, file.string(), take);
  if (!done) return std::unexpected(in_file(done.error(), file.string()));
  return {};
}

}  // namespace keyline::exchange
