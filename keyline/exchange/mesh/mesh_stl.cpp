#include <algorithm>
#include <bit>
#include <cstring>
#include <iterator>
#include <optional>
#include <unordered_map>

#include "keyline/core/text.h"
#include "keyline/exchange/mesh/mesh.h"
#include "keyline/exchange/mesh/mesh_notes.h"
#include "keyline/exchange/text/ascii.h"
#include "keyline/exchange/text/byte_lines.h"
#include "keyline/exchange/text/text_table.h"

namespace keyline::exchange {
namespace {

using core::ErrorCode;
using core::Point3;
using core::Result;

constexpr std::size_t kHeader = 84;
constexpr std::size_t kTriangle = 50;
constexpr std::string_view kStatements[] = {"solid",   "facet",    "outer",   "vertex",
                                            "endloop", "endfacet", "endsolid"};

/// Equal corners of triangles as one vertex.
class Vertices {
 public:
  std::uint32_t index_of(Point3 p) {
    const auto [at, is_new] = known_.try_emplace({p.x + 0.0, p.y + 0.0, p.z + 0.0},
                                                 static_cast<std::uint32_t>(mesh_.points.size()));
    if (is_new) mesh_.points.push_back(p);
    return at->second;
  }
  void add(const std::array<Point3, 3>& corners) {
    std::array<std::uint32_t, 3> t{};
    for (std::size_t i = 0; i < 3; ++i) t[i] = index_of(corners[i]);
    mesh_.triangles.push_back(t);
  }
  Mesh take() { return std::move(mesh_); }
  Mesh& mesh() { return mesh_; }

 private:
  struct Hash {
    std::size_t operator()(const Point3& p) const {
      std::size_t h = 0;
      for (const double v : {p.x, p.y, p.z})
        h = (h ^ std::bit_cast<std::uint64_t>(v)) * 0x9E3779B97F4A7C15ULL, h ^= h >> 29;
      return h;
    }
  };
  Mesh mesh_;
  std::unordered_map<Point3, std::uint32_t, Hash> known_;
};

float number_at(std::string_view bytes, std::size_t at) {
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < 4; ++i)
    bits |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + i])) << (8 * i);
  return std::bit_cast<float>(bits);
}

std::size_t count_at(std::string_view bytes) {
  return std::bit_cast<std::uint32_t>(number_at(bytes, kHeader - 4));
}

Result<Mesh> read_binary(std::string_view bytes) {
  Vertices vertices;
  const std::size_t count = count_at(bytes);
  if (bytes.size() < kHeader + kTriangle * count)
    return core::fail(ErrorCode::bad_input,
                      "the file ends before its " + core::counted(count, "triangle"),
                      "check that it is complete", "byte " + std::to_string(bytes.size()));
  std::size_t bad = 0;
  for (std::size_t i = 0; i < count; ++i) {
    std::array<Point3, 3> corners;
    bool finite = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t at = kHeader + kTriangle * i + 12 * (k + 1);
      corners[k] = {number_at(bytes, at), number_at(bytes, at + 4), number_at(bytes, at + 8)};
      finite = finite && core::is_finite(corners[k]);
    }
    if (finite)
      vertices.add(corners);
    else
      ++bad;
  }
  if (bad > 0)
    vertices.mesh().skipped.push_back(core::counted(bad, "triangle that is", "triangles that are") +
                                      " not finite");
  if (const std::size_t rest = bytes.size() - kHeader - kTriangle * count; rest > 0)
    vertices.mesh().skipped.push_back(core::counted(rest, "byte") + " behind the " +
                                      core::counted(count, "triangle") + " that the file counts");
  return vertices.take();
}

/// Three numbers with nothing behind them.
std::optional<Point3> corner_of(std::string_view line) {
  double c[3] = {};
  for (double& value : c) {
    const auto number = core::parse_number(detail::take_word(line));
    if (!number) return std::nullopt;
    value = *number;
  }
  if (!detail::take_word(line).empty()) return std::nullopt;
  return Point3{c[0], c[1], c[2]};
}

Result<Mesh> read_text(std::string_view bytes) {
  Vertices vertices;
  detail::ByteLines lines(bytes);
  std::array<Point3, 3> corners;
  std::size_t have = 0;
  bool open = false;
  for (std::string_view line; lines.next(line);) {
    const std::string word = detail::lower_case(detail::take_word(line));
    if (word == "solid" || word == "endsolid") open = word == "solid";
    if (!word.empty() && std::ranges::find(kStatements, word) == std::end(kStatements)) {
      detail::note(vertices.mesh(), lines.place(), detail::no_statement(word, "STL"));
      continue;
    }
    const bool ends = word == "endloop";
    if (ends || word == "facet" || word == "endfacet" || word == "endsolid") {
      if (have != (ends ? 3 : 0))
        return core::fail(ErrorCode::bad_input,
                          ends ? "a triangle has three vertices"
                               : "the vertices before this line have no endloop",
                          "mend the file", lines.place());
      if (ends) vertices.add(corners);
      have = 0;
    }
    if (word != "vertex") continue;
    const auto corner = corner_of(line);
    if (have == 3 || !corner)
      return core::fail(
          ErrorCode::bad_input,
          have == 3 ? "a triangle has three vertices" : "a vertex needs three numbers",
          "mend the line", lines.place());
    corners[have++] = *corner;
  }
  if (vertices.mesh().triangles.empty())
    return core::fail(ErrorCode::bad_input, "there is no triangle in it", "give an STL file",
                      "line 1");
  if (open || have > 0)
    vertices.mesh().skipped.push_back("what follows " + lines.place() +
                                      ": the file ends before its endsolid");
  return vertices.take();
}

}  // namespace

Result<Mesh> read_stl(std::string_view bytes) {
  // Binary files may start with "solid" too: their size tells them.
  const bool fits =
      bytes.size() >= kHeader && bytes.size() == kHeader + kTriangle * count_at(bytes);
  const std::string start = detail::lower_case(bytes.substr(0, 512));
  const bool text = start.find("facet") != std::string::npos ||
                    (start.starts_with("solid") && bytes.find('\0') == std::string_view::npos);
  if (fits || (!text && bytes.size() >= kHeader)) return read_binary(bytes);
  return read_text(bytes);
}

}  // namespace keyline::exchange
