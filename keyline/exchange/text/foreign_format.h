#pragma once

#include <string_view>

namespace keyline::exchange::detail {

/// What a file is that other programs write and nothing here reads, and what to do about it.
struct ForeignFormat {
  std::string_view start;  ///< of the file
  const char* what;
  const char* advice;
};

/// The format of a file that starts with these bytes; null for any other. Most of these files are
/// text with numbers in it, which a table's reader would take for points.
const ForeignFormat* foreign_format(std::string_view head);

}  // namespace keyline::exchange::detail
