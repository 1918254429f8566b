#include <algorithm>
#include <array>
#include <optional>

#include "keyline/core/text.h"
#include "keyline/exchange/file/read_file.h"
#include "keyline/exchange/file/standard_stream.h"
#include "keyline/exchange/mesh/mesh.h"
#include "keyline/exchange/mesh/mesh_notes.h"
#include "keyline/exchange/mesh/ply_header.h"
#include "keyline/exchange/points/points_columns.h"
#include "keyline/exchange/points/points_kind.h"
#include "keyline/exchange/points/space_rows.h"
#include "keyline/exchange/text/ascii.h"
#include "keyline/exchange/text/line_reader.h"
#include "keyline/exchange/text/text_table.h"

namespace keyline::exchange {
namespace {

using core::ErrorCode;
using core::Point3;
using core::Result;
using Take = std::function<void(Point3)>;

using Left = std::vector<std::string>;

/// Points of lines of text, one after the other.
class TextPoints {
 public:
  TextPoints(std::istream& in, const std::string& name, const Take& take)
      : lines_(in, name, std::size_t{1} << 20), name_(name), take_(take) {}

  Result<StreamedPoints> read() {
    while (true) {
      bool end = false;
      const auto line = lines_.next(end);
      if (!line) return std::unexpected(line.error());
      if (end) break;
      if (auto sound = kind_.take(*line, name_); !sound) return std::unexpected(sound.error());
      if (auto done = point(detail::trimmed_in_front(*line)); !done)
        return std::unexpected(done.error());
    }
    if (!rows_.started())
      return core::fail(ErrorCode::bad_input, "there are no points in it",
                        "give x, y and z on each line", name_);
    check_count();
    if (missing_ > 0)
      left_.push_back(core::counted(missing_, "point") + " without all coordinates");
    if (lines_.ended_early())
      left_.push_back("line " + std::to_string(lines_.number()) +
                      ": what follows the end mark (^Z)");
    const std::vector<std::string> of_rows = rows_.left_out();
    left_.insert(left_.begin(), of_rows.begin(), of_rows.end());
    return StreamedPoints{std::move(left_), rows_.unit()};
  }

 private:
  /// Lines before the points tell their columns; text behind them is left out.
  Result<void> point(std::string_view row) {
    const std::string_view line = detail::trimmed(row);
    if (line.empty()) return {};
    if (const auto count = lone_number(line)) return take_count(*count), core::Result<void>{};
    if (!rows_.started()) {
      const auto first = rows_.is_first(row, lines_.number(), lines_.place());
      if (!first) return std::unexpected(first.error());
      if (!*first) return {};
    }
    if (detail::is_comment(line)) return {};
    const auto fields = rows_.fields(line);
    const auto p = rows_.point(fields, row, lines_.place());
    if (!p) {
      if (!rows_.is_text(fields)) return std::unexpected(p.error());
      if (!remark_) remark_ = p.error();
      left_.push_back("line " + std::to_string(lines_.number()) + ": " + detail::shortened(line));
      return {};
    }
    if (remark_) return std::unexpected(*remark_);
    ++behind_count_;
    if (core::is_finite(*p))
      take_(*p);
    else
      ++missing_;
    return {};
  }

  static std::optional<double> lone_number(std::string_view line) {
    if (line.find_first_of(" \t,;|") != line.npos) return std::nullopt;
    return detail::parse_number(line, {});
  }

  /// A number by itself counts the points behind it.
  void take_count(double count) {
    check_count();
    count_ = Count{count, lines_.number()};
    behind_count_ = 0;
  }

  void check_count() {
    if (count_ && count_->points != static_cast<double>(behind_count_))
      left_.push_back("line " + std::to_string(count_->line) + ": the number " +
                      core::number_text(count_->points, 12) + ", which is not that of the " +
                      core::counted(behind_count_, "point") + " behind it");
    count_.reset();
  }

  struct Count {
    double points = 0;
    int line = 0;
  };

  LineReader lines_;
  const std::string& name_;
  const Take& take_;
  detail::PointsKind kind_;
  detail::SpaceRows rows_{{}};
  std::optional<core::Failure> remark_;  ///< of the first line of text behind points
  std::size_t missing_ = 0;
  std::optional<Count> count_;  ///< the last that was met
  std::size_t behind_count_ = 0;
  Left left_;
};

/// Of a file that has to be read whole.
Result<StreamedPoints> stream_mesh(const std::filesystem::path& file, const Take& take) {
  const auto mesh = read_mesh(file);
  if (!mesh) return std::unexpected(mesh.error());
  for (const Point3 p : mesh->points)
    if (core::is_finite(p)) take(p);
  return StreamedPoints{detail::left_out_of(*mesh), {}};
}

/// Vertices of a fixed size, a million bytes at a time.
Result<StreamedPoints> stream_vertices(std::istream& in, const detail::PlyHeader& header,
                                       const detail::PlyElement& vertex, const Take& take) {
  std::size_t row = 0;
  for (const auto& property : vertex.properties) row += size_of(property.type);
  const std::size_t rows = std::max<std::size_t>(1, (std::size_t{1} << 20) / row);
  detail::PlyHeader chunk_header = header;
  chunk_header.size = 0;
  std::string chunk;
  std::size_t at = header.size;
  std::size_t missing = 0;
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
      if (core::is_finite(p))
        take(p);
      else
        ++missing;
    }
  }
  Left left = detail::other_elements(header);
  if (missing > 0) left.push_back(core::counted(missing, "point") + " that are not finite");
  return StreamedPoints{std::move(left), {}};
}

Result<StreamedPoints> stream_ply(std::istream& in, const std::filesystem::path& file,
                                  const Take& take) {
  std::string head(std::size_t{1} << 20, '\0');
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(in.gcount()));
  const auto header = detail::read_ply_header(head);
  if (!header) return std::unexpected(header.error());
  if (auto sound = detail::check_vertices(*header); !sound) return std::unexpected(sound.error());
  const auto& elements = header->elements;
  const bool plain =
      header->binary && !elements.empty() && elements.front().name == "vertex" &&
      !elements.front().properties.empty() &&
      std::none_of(elements.front().properties.begin(), elements.front().properties.end(),
                   [](const detail::PlyProperty& p) { return p.count.has_value(); });
  if (plain) return stream_vertices(in, *header, elements.front(), take);
  return stream_mesh(file, take);
}

}  // namespace

Result<StreamedPoints> stream_points(const std::filesystem::path& file, const Take& take) {
  auto in = open_file(file);
  if (!in) return std::unexpected(in.error());
  const std::string name = file.string();
  const std::string extension = extension_of(file);
  auto done = extension == ".ply"   ? stream_ply(*in, file, take)
              : extension == ".obj" ? stream_mesh(file, take)
                                    : TextPoints(*in, name, take).read();
  if (!done) return std::unexpected(in_file(done.error(), name));
  return done;
}

}  // namespace keyline::exchange
