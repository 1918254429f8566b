#include "keyline/exchange/font/font.h"

#include <array>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H

#include "keyline/core/leading_number.h"
#include "keyline/core/text.h"
#include "keyline/core/utf8.h"

namespace keyline::exchange {
namespace {

using core::ErrorCode;
using core::Point2;
using core::Result;
using curve::Bezier2;
using document::Document;

struct Library {
  FT_Library value = nullptr;
  Library() { FT_Init_FreeType(&value); }
  ~Library() {
    if (value) FT_Done_FreeType(value);
  }
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;
};

struct Face {
  FT_Face value = nullptr;
  Face() = default;
  ~Face() {
    if (value) FT_Done_Face(value);
  }
  Face(const Face&) = delete;
  Face& operator=(const Face&) = delete;
};

struct Glyph {
  FT_UInt index = 0;
  std::string name;
};

/// Contours as they are drawn.
struct Contours {
  std::vector<std::vector<Bezier2>> list;
  Point2 at;

  void add(Bezier2 piece) {
    at = piece.control.back();
    bool moves = false;
    for (const Point2 p : piece.control) moves = moves || p != piece.control.front();
    if (moves) list.back().push_back(std::move(piece));
  }
  /// Contours are closed: where the end is not the start a line is missing.
  void close() {
    if (list.empty() || list.back().empty()) return;
    const Point2 start = list.back().front().control.front();
    if (at != start) add({{at, start}, {}});
  }
};

/// Outlines are loaded at one pixel a unit, in 64ths of it, and drawn at twice that: the points
/// TrueType implies halfway between handles are not rounded.
constexpr int kShift = 1;
constexpr double kSteps = 64 << kShift;

Point2 point(const FT_Vector* v) {
  return {static_cast<double>(v->x) / kSteps, static_cast<double>(v->y) / kSteps};
}

FT_Outline_Funcs drawing() {
  FT_Outline_Funcs functions{};
  functions.shift = kShift;
  functions.move_to = [](const FT_Vector* to, void* user) {
    auto& c = *static_cast<Contours*>(user);
    c.close();
    c.list.emplace_back();
    c.at = point(to);
    return 0;
  };
  functions.line_to = [](const FT_Vector* to, void* user) {
    auto& c = *static_cast<Contours*>(user);
    c.add({{c.at, point(to)}, {}});
    return 0;
  };
  functions.conic_to = [](const FT_Vector* handle, const FT_Vector* to, void* user) {
    auto& c = *static_cast<Contours*>(user);
    c.add({{c.at, point(handle), point(to)}, {}});
    return 0;
  };
  functions.cubic_to = [](const FT_Vector* a, const FT_Vector* b, const FT_Vector* to, void* user) {
    auto& c = *static_cast<Contours*>(user);
    c.add({{c.at, point(a), point(b), point(to)}, {}});
    return 0;
  };
  return functions;
}

std::unexpected<core::Failure> missing(const std::string& what) {
  return core::fail(ErrorCode::bad_input, "the font has no glyph for \"" + what + "\"",
                    "give a character, /name or U+hexadecimal", "--glyphs");
}

/// The code point at the front of UTF-8 text, which is taken off.
FT_ULong take_character(std::string_view& text) {
  const auto first = static_cast<unsigned char>(text.front());
  const std::size_t length = first < 0x80 ? 1 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;
  FT_ULong code = length == 1 ? first : first & (0xffU >> (length + 1));
  for (std::size_t i = 1; i < length; ++i)
    code = code << 6 | (static_cast<unsigned char>(text[i]) & 0x3f);
  text.remove_prefix(length);
  return code;
}

std::string name_of(FT_Face face, FT_UInt index) {
  std::array<char, 64> name{};
  if (FT_Get_Glyph_Name(face, index, name.data(), name.size()) != 0) return {};
  return name.data();
}

Result<Glyph> coded_glyph(FT_Face face, FT_ULong code, const std::string& name) {
  const FT_UInt index = FT_Get_Char_Index(face, code);
  if (index == 0) return missing(name);
  return Glyph{index, name};
}

Result<std::vector<Glyph>> glyphs_of(FT_Face face, const std::string& wanted) {
  const auto only = [](Result<Glyph> glyph) -> Result<std::vector<Glyph>> {
    if (!glyph) return std::unexpected(glyph.error());
    return std::vector<Glyph>{*glyph};
  };
  if (!core::is_utf8(wanted)) return missing("(no UTF-8)");
  if (wanted.size() > 1 && wanted[0] == '/') {
    if (!FT_HAS_GLYPH_NAMES(face))
      return core::fail(ErrorCode::bad_input, "the font does not name its glyphs",
                        "give a character or U+hexadecimal", "--glyphs");
    const FT_UInt index = FT_Get_Name_Index(face, wanted.c_str() + 1);
    if (index == 0 && wanted.substr(1) != name_of(face, 0)) return missing(wanted);
    return std::vector<Glyph>{{index, wanted.substr(1)}};
  }
  if (wanted.starts_with("U+") && wanted.size() > 2) {
    const auto code = core::parse_whole<FT_ULong>(std::string_view(wanted).substr(2), 16);
    if (!code) return missing(wanted);
    return only(coded_glyph(face, *code, wanted));
  }
  std::vector<Glyph> glyphs;
  for (std::string_view rest = wanted; !rest.empty();) {
    const std::string_view before = rest;
    const FT_ULong code = take_character(rest);
    const auto glyph =
        coded_glyph(face, code, std::string(before.substr(0, before.size() - rest.size())));
    if (!glyph) return std::unexpected(glyph.error());
    glyphs.push_back(*glyph);
  }
  return glyphs;
}

Result<void> add_glyph(Document& document, FT_Face face, const Glyph& glyph) {
  const bool loaded = FT_Set_Pixel_Sizes(face, face->units_per_EM, face->units_per_EM) == 0 &&
                      FT_Load_Glyph(face, glyph.index, FT_LOAD_NO_HINTING | FT_LOAD_NO_BITMAP) == 0;
  if (!loaded || face->glyph->format != FT_GLYPH_FORMAT_OUTLINE)
    return core::fail(ErrorCode::bad_input, "the glyph \"" + glyph.name + "\" has no outline",
                      "choose another", "--glyphs");
  Contours contours;
  const FT_Outline_Funcs functions = drawing();
  if (FT_Outline_Decompose(&face->glyph->outline, &functions, &contours) != 0)
    return core::fail(ErrorCode::bad_input,
                      "the outline of the glyph \"" + glyph.name + "\" is damaged",
                      "choose another", "--glyphs");
  contours.close();
  if (contours.list.empty())
    document.skipped.push_back("the glyph \"" + glyph.name + "\": it has no outline");
  int number = 0;
  for (auto& pieces : contours.list) {
    if (pieces.empty()) continue;
    ++number;
    document::NamedPath named{
        {number == 1 ? glyph.name : glyph.name + "#" + std::to_string(number), glyph.name, {}},
        {{}, true},
        0};
    for (Bezier2& piece : pieces) {
      document::PlanarCurve curve;
      curve.value = std::move(piece);
      named.path.curves.push_back(std::move(curve));
    }
    document.paths.push_back(std::move(named));
  }
  return {};
}

}  // namespace

Result<Document> read_font(std::string_view bytes, const std::string& glyphs) {
  const Library library;
  Face face;
  const auto* data = reinterpret_cast<const FT_Byte*>(bytes.data());
  if (!library.value || FT_New_Memory_Face(library.value, data, static_cast<FT_Long>(bytes.size()),
                                           0, &face.value) != 0)
    return core::fail(ErrorCode::bad_input, "this is no font that can be read",
                      "give a TrueType or OpenType font");
  if (!FT_IS_SCALABLE(face.value))
    return core::fail(ErrorCode::bad_input, "the font holds bitmaps alone",
                      "give a TrueType or OpenType font");
  if (glyphs.empty())
    return core::fail(ErrorCode::bad_input,
                      "the font holds " +
                          core::counted(static_cast<std::size_t>(face.value->num_glyphs), "glyph"),
                      "choose some with --glyphs S", "--glyphs");
  const auto wanted = glyphs_of(face.value, glyphs);
  if (!wanted) return std::unexpected(wanted.error());
  Document document;
  for (const Glyph& glyph : *wanted)
    if (auto done = add_glyph(document, face.value, glyph); !done)
      return std::unexpected(done.error());
  if (const FT_Long others = face.value->num_faces - 1; others > 0)
    document.skipped.push_back(core::counted(static_cast<std::size_t>(others), "further font") +
                               " of the collection");
  if (FT_HAS_MULTIPLE_MASTERS(face.value))
    document.skipped.emplace_back(
        "what the font varies in: its glyphs stand as they do by default");
  if (document.paths.empty())
    return core::fail(ErrorCode::bad_input, "the glyphs have no outline", "choose others",
                      "--glyphs");
  return document;
}

}  // namespace keyline::exchange
