#include "keyline/exchange/format/format.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <utility>

#include "keyline/exchange/points/hull_table.h"
#include "keyline/exchange/text/utf16.h"

namespace keyline::exchange {
namespace {

std::optional<Format> known(const std::string& extension) {
  static constexpr std::array<std::pair<std::string_view, Format>, 18> kKnown = {{
      {".json", Format::json},
      {".svg", Format::svg},
      {".svgz", Format::svg},
      {".dxf", Format::dxf},
      {".ttf", Format::font},
      {".otf", Format::font},
      {".ttc", Format::font},
      {".glif", Format::glif},
      {".obj", Format::mesh},
      {".stl", Format::mesh},
      {".ply", Format::mesh},
      {".step", Format::step},
      {".stp", Format::step},
      {".p21", Format::step},
      {".iges", Format::iges},
      {".igs", Format::iges},
      {".csv", Format::points},
      {".scap", Format::scap},
  }};
  for (const auto& [name, format] : kKnown)
    if (extension == name) return format;
  return std::nullopt;
}

/// The first bytes without a byte order mark and white space.
std::string_view start_of(std::string_view head) {
  head = detail::without_mark(head);
  const std::size_t at = head.find_first_not_of(" \t\r\n");
  return at == std::string_view::npos ? std::string_view{} : head.substr(at);
}

/// Lines of "v 1 2 3", "f 1 2 3" or what else an OBJ file begins with.
bool looks_like_obj(std::string_view head) {
  for (; !head.empty(); head.remove_prefix(std::min(head.size(), head.find('\n') + 1))) {
    const std::string_view line = start_of(head.substr(0, head.find('\n')));
    if (line.find('\n') != std::string_view::npos || line.empty() || line.starts_with('#')) {
      if (head.find('\n') == std::string_view::npos) return false;
      continue;
    }
    const std::string_view word = line.substr(0, line.find_first_of(" \t"));
    static constexpr std::array<std::string_view, 7> kWords = {"v", "vn", "vt",    "o",
                                                               "g", "f",  "mtllib"};
    return word.size() < line.size() && std::ranges::find(kWords, word) != kWords.end();
  }
  return false;
}

/// A header of 80 bytes, a number of triangles, and the first one's normal: of length 1, or 0.
bool looks_like_binary_stl(std::string_view head) {
  constexpr std::size_t kHeader = 84;
  if (head.size() < kHeader + 50 || head.find('\0') == std::string_view::npos) return false;
  float normal[3];
  std::memcpy(normal, head.data() + kHeader, sizeof normal);
  if constexpr (std::endian::native == std::endian::big)
    for (float& x : normal)
      x = std::bit_cast<float>(__builtin_bswap32(std::bit_cast<std::uint32_t>(x)));
  const double length = std::hypot(normal[0], normal[1], normal[2]);
  return length == 0 || std::abs(length - 1) < 0.01;
}

/// The mark of a binary file, or a first group of "0 SECTION" or a comment ("999") before it.
bool looks_like_dxf(std::string_view head) {
  if (head.starts_with("AutoCAD Binary DXF")) return true;
  const std::size_t at = head.find("SECTION");
  if (at == std::string_view::npos || at > 1000) return false;
  const std::string_view code = start_of(head.substr(0, head.find_first_of("\r\n")));
  const std::string_view plain = code.substr(0, code.find_last_not_of(" \t") + 1);
  return plain == "0" || plain == "999";
}

bool looks_like_iges(std::string_view head) {
  return head.size() > 80 && head.substr(72, 8) == "S0000001";
}

/// "#width height", "@pen".
bool looks_like_scap(std::string_view head) {
  if (!head.starts_with('#')) return false;
  const std::size_t second = head.find('\n');
  return second != std::string_view::npos && head.substr(second + 1).starts_with('@') &&
         head.substr(1, second - 1).find_first_not_of("0123456789. \t\r") == std::string_view::npos;
}

std::string_view xml_extension(std::string_view start) {
  return start.find("<glyph") != std::string_view::npos &&
                 start.find("<svg") == std::string_view::npos
             ? ".glif"
             : ".svg";
}

std::string_view extension_by_content(std::string_view head) {
  using namespace std::string_view_literals;
  if (const std::string_view picture = picture_extension(head); !picture.empty()) return picture;
  if (looks_like_dxf(head)) return ".dxf";
  if (head.starts_with("\x1f\x8b")) return ".svgz";
  if (head.starts_with("\0\1\0\0"sv) || head.starts_with("true")) return ".ttf";
  if (head.starts_with("OTTO")) return ".otf";
  if (head.starts_with("ttcf")) return ".ttc";
  if (head.starts_with("ply\n") || head.starts_with("ply\r")) return ".ply";
  if (looks_like_iges(head)) return ".iges";
  if (looks_like_scap(head)) return ".scap";
  const std::string_view start = start_of(head);
  if (start.starts_with("ISO-10303-21")) return ".step";
  if (start.starts_with('{') || start.starts_with('[')) return ".json";
  if (start.starts_with('<')) return xml_extension(start);
  if (start.starts_with("solid ") || looks_like_binary_stl(head)) return ".stl";
  return looks_like_obj(head) ? ".obj" : "";
}

}  // namespace

std::string_view picture_extension(std::string_view head) {
  using namespace std::string_view_literals;
  if (head.starts_with("\x89PNG\r\n\x1a\n")) return ".png";
  if (head.starts_with("\xff\xd8\xff")) return ".jpg";
  if (head.starts_with("II*\0"sv) || head.starts_with("MM\0*"sv)) return ".tif";
  if (head.starts_with("RIFF") && head.size() > 12 && head.substr(8, 4) == "WEBP") return ".webp";
  return "";
}

std::string telling_extension(const std::filesystem::path& file, std::string_view head) {
  static constexpr std::array<std::string_view, 7> kOthers = {".png",  ".jpg",  ".jpeg", ".tif",
                                                              ".tiff", ".webp", ".scap"};
  std::string own = file == "-" ? "" : extension_of(file);
  if (known(own) || std::ranges::find(kOthers, own) != kOthers.end()) return own;
  return std::string(extension_by_content(detail::in_utf8(std::string(head))));
}

Format format_of(const std::filesystem::path& file, std::string_view head) {
  if (is_hull_csv(detail::in_utf8(std::string(head)))) return Format::offsets;
  return known(telling_extension(file, head)).value_or(Format::points);
}

std::vector<std::string> written_extensions() {
  return {".svg", ".svgz", ".json", ".csv", ".dxf", ".step", ".stp", ".iges", ".igs", ".glif"};
}

}  // namespace keyline::exchange
