#include "keyline/exchange/format.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "keyline/exchange/dxf_tags.h"
#include "keyline/exchange/hull_table.h"

namespace keyline::exchange {
namespace {

std::optional<Format> known(const std::string& extension) {
  static constexpr std::array<std::pair<std::string_view, Format>, 17> kKnown = {{
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
  }};
  for (const auto& [name, format] : kKnown)
    if (extension == name) return format;
  return std::nullopt;
}

/// The first bytes without a byte order mark and white space.
std::string_view start_of(std::string_view head) {
  if (head.starts_with("\xef\xbb\xbf")) head.remove_prefix(3);
  const std::size_t at = head.find_first_not_of(" \t\r\n");
  return at == std::string_view::npos ? std::string_view{} : head.substr(at);
}

}  // namespace

std::string extension_of(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return c < 0x80 ? std::tolower(c) : c; });
  return extension;
}

Format format_of(const std::filesystem::path& file, std::string_view head) {
  if (is_hull_csv(head)) return Format::offsets;
  if (const auto format = known(extension_of(file))) return *format;
  if (detail::looks_like_dxf(head)) return Format::dxf;
  const std::string_view start = start_of(head);
  if (start.starts_with("ISO-10303-21")) return Format::step;
  if (start.starts_with('{') || start.starts_with('[')) return Format::json;
  if (start.starts_with('<')) return Format::svg;
  return Format::points;
}

std::vector<std::string> written_extensions() {
  return {".svg", ".svgz", ".json", ".csv", ".dxf", ".step", ".stp", ".iges", ".igs", ".glif"};
}

}  // namespace keyline::exchange
