#include "input.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>

#include <nlohmann/json.hpp>

#include "keyline/acquire/acquire.h"
#include "keyline/acquire/join.h"
#include "keyline/acquire/lattice.h"
#include "keyline/acquire/section.h"
#include "keyline/exchange/json_curve.h"
#include "keyline/exchange/lattice_reader.h"
#include "keyline/exchange/points_reader.h"
#include "keyline/exchange/svg_reader.h"
#include "keyline/operations/fair_request.h"

namespace keyline::app {
namespace {

using acquire::KeyLine;
using acquire::RawCurve;
using core::ErrorCode;
using core::fail;
using core::Result;

constexpr std::uintmax_t kLargestFile = 512u << 20;

template <class T>
Result<T> in_file(Result<T> result, const std::string& file) {
  if (result || result.error().path.starts_with(file)) return result;
  core::Failure failure = result.error();
  failure.path = failure.path.empty() ? file : file + ": " + failure.path;
  return std::unexpected(std::move(failure));
}

acquire::AcquireOptions acquire_options(const InputOptions& input) {
  acquire::AcquireOptions options;
  if (input.closed) options.closed = true;
  if (input.open) options.closed = false;
  if (input.keep_order) options.ordered = true;
  options.remove_outliers = !input.keep_strays;
  options.noise = input.noise;
  return options;
}

struct Cut {
  acquire::Axis axis = acquire::Axis::y;
  double position = 0;
};

Result<Cut> parse_section(const std::string& text) {
  Cut cut;
  const bool named = text.size() > 2 && text[1] == '=' && text[0] >= 'x' && text[0] <= 'z';
  const char* last = text.data() + text.size();
  if (named) {
    cut.axis = static_cast<acquire::Axis>(text[0] - 'x');
    const auto [end, error] = std::from_chars(text.data() + 2, last, cut.position);
    if (error == std::errc() && end == last && std::isfinite(cut.position)) return cut;
  }
  return fail(ErrorCode::bad_input, "\"" + text + "\" is no section",
              "give x=, y= or z= and a number, as in y=0", "--section");
}

Result<std::vector<RawCurve>> read_lattice_input(const InputOptions& input,
                                                 const std::string& file) {
  const auto lattice = exchange::read_lattice(file);
  if (!lattice) return std::unexpected(lattice.error());
  Result<RawCurve> curve = fail(ErrorCode::internal, "");
  if (input.row || input.column) {
    const long index = input.row ? *input.row : *input.column;
    if (index < 0)
      return fail(ErrorCode::bad_input, "rows and columns count from 0", "give 0 or more");
    curve = input.row ? acquire::lattice_row(*lattice, static_cast<std::size_t>(index))
                      : acquire::lattice_column(*lattice, static_cast<std::size_t>(index));
  } else {
    const auto cut = parse_section(input.section);
    if (!cut) return std::unexpected(cut.error());
    curve = acquire::lattice_section(*lattice, cut->axis, cut->position);
  }
  if (!curve) return std::unexpected(curve.error());
  return std::vector<RawCurve>{std::move(*curve)};
}

/// Band of a section that was not given: 1/150 of the cloud's size.
double usual_band(const RawCurve& cloud) {
  double size = 0;
  for (const core::Point3& p : cloud.points)
    if (core::is_finite(p)) size = std::max(size, core::distance(p, cloud.points.front()));
  return size > 0 && std::isfinite(size) ? size / 150 : 1;
}

Result<std::vector<RawCurve>> cut_cloud(const InputOptions& input, std::vector<RawCurve> clouds) {
  const auto cut = parse_section(input.section);
  if (!cut) return std::unexpected(cut.error());
  std::vector<RawCurve> cuts;
  for (const RawCurve& cloud : clouds) {
    auto curve = acquire::section_plane(cloud, cut->axis, cut->position,
                                        input.band ? *input.band : usual_band(cloud));
    if (!curve) return std::unexpected(curve.error());
    cuts.push_back(std::move(*curve));
  }
  return cuts;
}

Result<std::vector<RawCurve>> read_raw(const InputOptions& input, const std::string& file) {
  if (input.row || input.column) return read_lattice_input(input, file);
  exchange::PointsOptions options;
  options.columns = input.columns;
  options.weight_column = input.weights;
  options.id_column = input.id;
  auto raw = file == "-" ? exchange::read_points(std::cin, "standard input", options)
                         : exchange::read_points(std::filesystem::path(file), options);
  if (!raw) return raw;
  if (input.section.empty()) return raw;
  return cut_cloud(input, std::move(*raw));
}

Result<std::vector<KeyLine>> acquire_all(const InputOptions& input, const std::string& file) {
  const auto raw = in_file(read_raw(input, file), file);
  if (!raw) return std::unexpected(raw.error());
  std::vector<KeyLine> lines;
  for (const RawCurve& curve : *raw) {
    if (!input.select.empty() && curve.id != input.select) continue;
    auto line = in_file(acquire::acquire_key_line(curve, acquire_options(input)),
                        raw->size() > 1 ? file + ": " + curve.id : file);
    if (!line) return std::unexpected(line.error());
    line->id = curve.id;
    lines.push_back(std::move(*line));
  }
  if (lines.empty())
    return fail(ErrorCode::bad_input, "no curve is named \"" + input.select + "\"",
                "leave --select out to take all", file);
  return lines;
}

Result<std::vector<KeyLine>> join_files(const InputOptions& input) {
  std::vector<RawCurve> parts;
  for (const std::string& file : input.files) {
    auto raw = in_file(read_raw(input, file), file);
    if (!raw) return std::unexpected(raw.error());
    for (RawCurve& curve : *raw) parts.push_back(std::move(curve));
  }
  auto line = acquire::acquire_joined(parts, acquire_options(input));
  if (!line) return std::unexpected(line.error());
  return std::vector<KeyLine>{std::move(*line)};
}

Result<document::Document> document_of_json(const std::string& text, const std::string& file) {
  nlohmann::json j;
  try {
    j = nlohmann::json::parse(text);
  } catch (const nlohmann::json::parse_error& e) {
    const auto upto = std::min<std::size_t>(e.byte, text.size());
    const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<long>(upto), '\n');
    return fail(ErrorCode::bad_input, "not JSON", "mend it around byte " + std::to_string(e.byte),
                file + ":" + std::to_string(line));
  }
  document::Document document;
  const auto add = [&](const nlohmann::json& value, const std::string& where,
                       std::string name) -> Result<void> {
    auto path = exchange::path_from_json(value, where);
    if (!path) return in_file(Result<void>(std::unexpected(path.error())), file);
    document.paths.push_back({std::move(name), "", std::move(*path), 0});
    return {};
  };
  const bool several = j.is_object() && !j.contains("type") && j.contains("curves");
  if (several) {
    for (std::size_t i = 0; i < j["curves"].size(); ++i) {
      const auto& item = j["curves"][i];
      const std::string where = "curves[" + std::to_string(i) + "]";
      const bool named = item.is_object() && item.contains("curve");
      const std::string name =
          named && item.contains("name") && item["name"].is_string() ? item["name"] : "";
      if (auto done = add(named ? item["curve"] : item, where, name); !done)
        return std::unexpected(done.error());
    }
    return document;
  }
  const bool wrapped = j.is_object() && !j.contains("type") && j.contains("curve");
  if (auto done = add(wrapped ? j["curve"] : j, wrapped ? "curve" : "", ""); !done)
    return std::unexpected(done.error());
  return document;
}

Result<document::Document> document_of_svg(const std::string& text, const std::string& file) {
  const auto svg = in_file(exchange::read_svg(text), file);
  if (!svg) return std::unexpected(svg.error());
  if (!svg->metadata.empty()) {
    auto exact = document_of_json(svg->metadata, file);
    if (exact) {
      exact->unit = svg->unit;
      return exact;
    }
  }
  document::Document document;
  document.unit = svg->unit;
  for (const auto& curve : svg->curves) {
    document::NamedPath path;
    path.name = curve.name;
    path.path.closed = curve.closed;
    for (const curve::Bezier2& piece : curve.pieces) path.path.curves.push_back({piece});
    if (!path.path.curves.empty()) document.paths.push_back(std::move(path));
  }
  for (const auto& skipped : svg->skipped)
    document.skipped.push_back("line " + std::to_string(skipped.line) + ": " + skipped.what);
  return document;
}

}  // namespace

std::string extension_of(const std::string& file) {
  std::string extension = std::filesystem::path(file).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), ::tolower);
  return extension;
}

InputKind kind_of(const std::string& file) {
  const std::string extension = extension_of(file);
  if (extension == ".json") return InputKind::json;
  if (extension == ".svg") return InputKind::svg;
  return InputKind::points;
}

Result<std::string> read_file(const std::string& file) {
  if (file == "-")
    return std::string(std::istreambuf_iterator<char>(std::cin), std::istreambuf_iterator<char>());
  std::error_code error;
  if (std::filesystem::is_directory(file, error))
    return fail(ErrorCode::io, "is a directory", "name a file", file);
  std::ifstream in(file, std::ios::binary);
  if (!in)
    return fail(ErrorCode::io, std::string("cannot be opened: ") + std::strerror(errno),
                "check the name and the rights", file);
  if (std::filesystem::file_size(file, error) > kLargestFile && !error)
    return fail(ErrorCode::bad_input, "is larger than 512 MB", "split it", file);
  return std::string(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
}

Result<document::Document> load_document(const InputOptions& input) {
  const std::string& file = input.files.front();
  if (input.files.size() > 1)
    return fail(ErrorCode::bad_input, "one file of curves at a time", "give one INPUT");
  const auto text = read_file(file);
  if (!text) return std::unexpected(text.error());
  auto document = kind_of(file) == InputKind::svg ? document_of_svg(*text, file)
                                                  : document_of_json(*text, file);
  if (!document) return document;
  if (!input.select.empty())
    std::erase_if(document->paths, [&](const auto& p) { return p.name != input.select; });
  if (document->paths.empty())
    return fail(ErrorCode::bad_input, "holds no curve",
                input.select.empty() ? "give a file with paths" : "check --select", file);
  return document;
}

Result<std::vector<KeyLine>> load_key_lines(const InputOptions& input) {
  if (kind_of(input.files.front()) != InputKind::points) {
    const auto document = load_document(input);
    if (!document) return std::unexpected(document.error());
    std::vector<KeyLine> lines;
    for (const auto& named : document->paths) {
      auto line = in_file(operations::key_line_of(named.path), input.files.front());
      if (!line) return std::unexpected(line.error());
      line->id = named.name;
      if (document->skipped.size() > 0)
        line->report.notes.push_back(std::to_string(document->skipped.size()) +
                                     " things in the file were skipped");
      lines.push_back(std::move(*line));
    }
    return lines;
  }
  if (input.files.size() > 1) return join_files(input);
  return acquire_all(input, input.files.front());
}

}  // namespace keyline::app
