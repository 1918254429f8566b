#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "keyline/core/error.h"

namespace keyline::exchange::detail {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;
  std::optional<PlyType> count;  ///< of a list
};

struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  bool formatted = false;  ///< a line tells the format
  bool binary = false;
  bool big_endian = false;
  std::vector<PlyElement> elements;
  std::size_t size = 0;  ///< bytes up to the data
  std::size_t lines = 0;
};

std::size_t size_of(PlyType type);

/// Fails: bad_input with "line N".
core::Result<PlyHeader> read_ply_header(std::string_view bytes);

/// Fails: bad_input unless the header tells its format and one element of vertices that have x, y
/// and z, each once.
core::Result<void> check_vertices(const PlyHeader& header);

/// In words, what of the file is no vertex and no face with a list of vertices.
std::vector<std::string> other_elements(const PlyHeader& header);

/// True for the list of a face's vertices.
bool is_vertex_list(const PlyProperty& property);

/// Reads values one after the other, binary or as words. Past the end it gives failures with the
/// place: "byte N" or "line N".
class PlyValues {
 public:
  PlyValues(std::string_view bytes, const PlyHeader& header);

  core::Result<double> next(PlyType type);
  /// The next value as the length of a list; a failure, too, where it is none.
  core::Result<std::size_t> next_count(PlyType type);
  /// Where the next value stands, from the start of `bytes`.
  std::size_t position() const { return position_; }
  /// Whether anything but white space is left.
  bool more() const;

 private:
  core::Result<double> word();
  std::unexpected<core::Failure> failure(const char* what) const;

  std::string_view bytes_;
  const PlyHeader& header_;
  std::size_t position_;
  std::size_t line_;
};

}  // namespace keyline::exchange::detail
