#include "keyline/exchange/mesh/ply_header.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>

#include "keyline/core/text.h"
#include "keyline/core/utf8.h"
#include "keyline/exchange/text/byte_lines.h"

namespace keyline::exchange::detail {
namespace {

using core::Result;

std::optional<PlyType> type_named(std::string_view name) {
  using enum PlyType;
  static constexpr std::array<std::pair<std::string_view, PlyType>, 16> kNames = {
      {{"char", int8},
       {"uchar", uint8},
       {"short", int16},
       {"ushort", uint16},
       {"int", int32},
       {"uint", uint32},
       {"float", float32},
       {"double", float64},
       {"int8", int8},
       {"uint8", uint8},
       {"int16", int16},
       {"uint16", uint16},
       {"int32", int32},
       {"uint32", uint32},
       {"float32", float32},
       {"float64", float64}}};
  for (const auto& [known, type] : kNames)
    if (known == name) return type;
  return std::nullopt;
}

bool add_property(PlyHeader& header, std::string_view line) {
  if (header.elements.empty()) return false;
  PlyProperty property;
  std::string_view word = take_word(line);
  if (word == "list") {
    property.count = type_named(take_word(line));
    if (!property.count) return false;
    word = take_word(line);
  }
  const auto type = type_named(word);
  if (!type) return false;
  property.type = *type;
  property.name = std::string(take_word(line));
  header.elements.back().properties.push_back(std::move(property));
  return header.elements.back().properties.size() <= 1000;
}

bool is_count(double v) { return v >= 0 && v == std::floor(v); }

bool add_element(PlyHeader& header, std::string_view line) {
  const std::string_view name = take_word(line);
  const auto count = core::parse_number(take_word(line));
  if (!is_count(count.value_or(-1)) || *count > 4e9 || header.elements.size() > 100) return false;
  header.elements.push_back({std::string(name), static_cast<std::size_t>(*count), {}});
  return true;
}

bool add_format(PlyHeader& header, std::string_view line) {
  const std::string_view name = take_word(line);
  header.formatted = true;
  header.binary = name != "ascii";
  header.big_endian = name == "binary_big_endian";
  return name == "ascii" || name == "binary_little_endian" || header.big_endian;
}

bool take_line(PlyHeader& header, std::string_view line) {
  const std::string_view word = take_word(line);
  if (word == "format") return add_format(header, line);
  if (word == "element") return add_element(header, line);
  if (word == "property") return add_property(header, line);
  return word == "comment" || word == "obj_info" || word.empty();
}

std::string_view trimmed_end(std::string_view line) {
  while (line.ends_with(' ') || line.ends_with('\t')) line.remove_suffix(1);
  return line;
}

}  // namespace

std::size_t size_of(PlyType type) {
  static constexpr std::array<std::size_t, 8> kSizes = {1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

Result<PlyHeader> read_ply_header(std::string_view bytes) {
  PlyHeader header;
  // Headers are short; binary data behind them must not be taken for text.
  ByteLines lines(bytes.substr(0, 1 << 20));
  std::string_view line;
  if (!lines.next(line) || trimmed_end(line) != "ply")
    return core::fail(core::ErrorCode::bad_input, "this is no PLY file", "it has to start with ply",
                      "line 1");
  while (lines.next(line)) {
    if (trimmed_end(line) == "end_header") {
      header.size = lines.position();
      header.lines = lines.number();
      return header;
    }
    if (!take_line(header, line))
      return core::fail(core::ErrorCode::bad_input, "this line of the PLY header cannot be read",
                        "mend it", lines.place());
  }
  return core::fail(core::ErrorCode::bad_input, "the PLY header does not end",
                    "check that the file is complete", lines.place());
}

Result<void> check_vertices(const PlyHeader& header) {
  const auto failure = [&](const std::string& what) {
    return core::fail(core::ErrorCode::bad_input, what, "mend the header",
                      "line " + std::to_string(header.lines));
  };
  if (!header.formatted) return failure("the header names no format");
  const auto is_vertex = [](const PlyElement& e) { return e.name == "vertex"; };
  const auto vertex = std::ranges::find_if(header.elements, is_vertex);
  if (std::ranges::count_if(header.elements, is_vertex) != 1)
    return failure("the header needs one element of vertices");
  for (const char* name : {"x", "y", "z"})
    if (std::ranges::count_if(vertex->properties, [name](const PlyProperty& p) {
          return p.name == name && !p.count;
        }) != 1)
      return failure(std::string("the vertices need ") + name + " as a property, once");
  return {};
}

bool is_vertex_list(const PlyProperty& property) {
  return property.count && (property.name == "vertex_indices" || property.name == "vertex_index");
}

std::vector<std::string> other_elements(const PlyHeader& header) {
  std::vector<std::string> others;
  for (const PlyElement& e : header.elements) {
    if (e.count == 0 || e.name == "vertex") continue;
    const bool face = e.name == "face";
    if (face && std::ranges::any_of(e.properties, is_vertex_list)) continue;
    const std::string name(core::whole_characters(e.name, 30));
    others.push_back(core::counted(e.count, "element") + " of the name \"" + name + '"' +
                     (face ? ": the header gives them no vertex_indices" : ""));
  }
  return others;
}

PlyValues::PlyValues(std::string_view bytes, const PlyHeader& header)
    : bytes_(bytes), header_(header), position_(header.size), line_(header.lines + 1) {}

std::unexpected<core::Failure> PlyValues::failure(const char* what) const {
  return core::fail(
      core::ErrorCode::bad_input, what, "check that the file is complete",
      header_.binary ? "byte " + std::to_string(position_) : "line " + std::to_string(line_));
}

Result<double> PlyValues::word() {
  while (position_ < bytes_.size() &&
         std::string_view(" \t\r\n\f\v").find(bytes_[position_]) != std::string_view::npos)
    line_ += bytes_[position_++] == '\n';
  const std::size_t end = std::min(bytes_.find_first_of(" \t\r\n\f\v", position_), bytes_.size());
  if (end == position_) return failure("the file ends before its last value");
  const auto value = core::parse_number(bytes_.substr(position_, end - position_));
  if (!value) return failure("a number is expected here");
  position_ = end;
  return *value;
}

bool PlyValues::more() const {
  return bytes_.find_first_not_of(" \t\r\n\f\v", position_) != std::string_view::npos;
}

Result<std::size_t> PlyValues::next_count(PlyType type) {
  const auto value = next(type);
  if (!value) return std::unexpected(value.error());
  if (!is_count(*value)) return failure("the length of a list is expected here");
  return static_cast<std::size_t>(*value);
}

Result<double> PlyValues::next(PlyType type) {
  if (!header_.binary) return word();
  const std::size_t size = size_of(type);
  if (bytes_.size() - position_ < size) return failure("the file ends before its last value");
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const std::size_t place = header_.big_endian ? size - 1 - i : i;
    bits |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes_[position_ + i]))
            << (8 * place);
  }
  position_ += size;
  switch (type) {
    case PlyType::int8:
      return static_cast<double>(static_cast<std::int8_t>(bits));
    case PlyType::int16:
      return static_cast<double>(static_cast<std::int16_t>(bits));
    case PlyType::int32:
      return static_cast<double>(static_cast<std::int32_t>(bits));
    case PlyType::float32:
      return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
    case PlyType::float64:
      return std::bit_cast<double>(bits);
    default:
      return static_cast<double>(bits);
  }
}

}  // namespace keyline::exchange::detail
