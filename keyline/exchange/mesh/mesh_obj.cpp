#include <algorithm>
#include <cmath>
#include <limits>

#include "keyline/core/text.h"
#include "keyline/exchange/mesh/mesh.h"
#include "keyline/exchange/mesh/mesh_notes.h"
#include "keyline/exchange/mesh/mesh_polygon.h"
#include "keyline/exchange/text/byte_lines.h"
#include "keyline/exchange/text/utf16.h"

namespace keyline::exchange {
namespace {

using core::ErrorCode;
using core::Result;

/// Statements of the format that no vertex, face or line depends on, those of free-form geometry
/// (told by their "curv" and "surf") and those that were superseded among them.
constexpr std::string_view kUnused[] = {
    "vt",     "vn",         "vp",        "g",      "s",     "mg",       "o",
    "usemtl", "mtllib",     "usemap",    "maplib", "bevel", "c_interp", "d_interp",
    "lod",    "shadow_obj", "trace_obj", "ctech",  "stech", "cstype",   "deg",
    "bmat",   "step",       "parm",      "trim",   "hole",  "scrv",     "sp",
    "end",    "con",        "curv2",     "res",    "csh"};

class ObjReader {
 public:
  explicit ObjReader(std::string_view bytes) : lines_(bytes) {}

  Result<Mesh> read() {
    std::string_view line;
    std::string joined;
    while (lines_.next(line)) {
      if (line.ends_with('\\')) {  // goes on in the next line
        joined.append(line.substr(0, line.size() - 1));
        joined += ' ';
        continue;
      }
      if (!joined.empty()) {
        joined.append(line);
        line = joined;
      }
      if (auto done = statement(line); !done) return std::unexpected(done.error());
      joined.clear();
    }
    if (auto done = statement(joined); !done) return std::unexpected(done.error());
    return std::move(mesh_);
  }

 private:
  Result<void> statement(std::string_view line) {
    const std::string_view keyword = detail::take_word(line);
    if (keyword == "v") return vertex(line);
    if (keyword.empty() || keyword.front() == '#') return {};
    const bool face = keyword == "f" || keyword == "fo";  // "fo": as older programs write faces
    if (face || keyword == "l")
      element(line, face);
    else if (core::parse_number(keyword))
      note("numbers without a statement's name");
    else if (keyword == "curv" || keyword == "surf")
      note("free-form " + std::string(keyword));
    else if (keyword == "p" || keyword == "call")
      note(keyword == "p" ? "points by themselves" : "what another file holds");
    else if (std::ranges::find(kUnused, keyword) == std::end(kUnused))
      note(detail::no_statement(keyword, "OBJ"));
    return {};
  }

  Result<void> vertex(std::string_view line) {
    double c[3] = {};
    for (double& value : c) {
      const std::string_view word = detail::take_word(line);
      const auto number = core::parse_number(word);
      if (!number && word.find_first_of("0123456789") == word.npos)
        return core::fail(ErrorCode::bad_input, "a vertex needs three numbers", "mend the line",
                          lines_.place());
      if (!number) note("the vertex: " + detail::quoted(word) + " is no number");
      value = number.value_or(std::numeric_limits<double>::quiet_NaN());
    }
    if (mesh_.points.size() >= std::numeric_limits<std::uint32_t>::max() / 2)
      return core::fail(ErrorCode::bad_input, "there are too many vertices", "split the file",
                        lines_.place());
    mesh_.points.push_back({c[0], c[1], c[2]});
    return {};
  }

  void element(std::string_view line, bool face) {
    indices_.clear();
    for (auto word = detail::take_word(line); !word.empty(); word = detail::take_word(line)) {
      const auto number = core::parse_number(word.substr(0, word.find('/')));
      const double count = static_cast<double>(mesh_.points.size());
      const double index = !number ? -1 : *number < 0 ? count + *number : *number - 1;
      if (!(index >= 0 && index < count && index == std::floor(index)))
        return note(detail::quoted(word) + " is none of the vertices");
      indices_.push_back(static_cast<std::uint32_t>(index));
    }
    if (indices_.size() < (face ? 3 : 2)) return note("too few vertices");
    if (!face) {
      mesh_.lines.push_back(indices_);
      return;
    }
    if (!detail::add_polygon(mesh_, indices_)) note("a face of too many corners; divide it");
  }

  void note(std::string_view what) { detail::note(mesh_, lines_.place(), what); }

  detail::ByteLines lines_;
  Mesh mesh_;
  std::vector<std::uint32_t> indices_;
};

}  // namespace

Result<Mesh> read_obj(std::string_view bytes) {
  if (!detail::starts_as_utf16(bytes)) return ObjReader(detail::without_mark(bytes)).read();
  return ObjReader(detail::in_utf8(std::string(bytes))).read();
}

}  // namespace keyline::exchange
