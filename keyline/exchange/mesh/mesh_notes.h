#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "keyline/core/text.h"
#include "keyline/core/utf8.h"
#include "keyline/exchange/mesh/mesh.h"

/// What readers of meshes say of lines that they skip.
namespace keyline::exchange::detail {

inline constexpr std::size_t kMostNotes = 1000;

/// A word of the file, cut to what fits a line.
inline std::string quoted(std::string_view word) {
  return "\"" + std::string(core::whole_characters(word, 30)) + "\"";
}

inline std::string no_statement(std::string_view word, const char* format) {
  return quoted(word) + " is no statement of " + format;
}

/// The first of them, with their place.
inline void note(Mesh& mesh, std::string place, std::string_view what) {
  if (mesh.skipped.size() < kMostNotes)
    mesh.skipped.push_back(std::move(place) + ": " + std::string(what));
}

/// What of a mesh its section and its points do not show.
inline std::vector<std::string> left_out_of(const Mesh& mesh) {
  std::vector<std::string> left = mesh.skipped;
  if (!mesh.lines.empty())
    left.insert(left.begin(), core::counted(mesh.lines.size(), "line") + " between vertices");
  return left;
}

}  // namespace keyline::exchange::detail
