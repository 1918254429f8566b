#pragma once

#include <set>
#include <string>
#include <string_view>

#include "keyline/core/point.h"

namespace keyline::exchange::detail {

/// Groups of a DXF file as text. Handles are counted from `first` on.
class DxfText {
 public:
  explicit DxfText(unsigned long first = 0x100) : next_(first) {}

  void text(int code, std::string_view value);
  void whole(int code, long value);
  void real(int code, double value);
  /// Codes code, code + 10, code + 20.
  void point(int code, core::Point3 p);
  /// A new handle.
  void handle(int code);

  const std::string& content() const { return content_; }
  /// The next handle.
  unsigned long next() const { return next_; }

 private:
  std::string content_;
  unsigned long next_;
};

/// Text on one line, at most 255 bytes; what is not ASCII as \U+ and four hexadecimal digits.
std::string dxf_text(std::string_view text);
/// The same without the characters that names of layers may not hold; those become "_".
std::string dxf_name(std::string_view text);

/// The whole file around the entities: header, tables, blocks, objects.
std::string dxf_file(const DxfText& entities, const std::set<std::string>& layers, int unit);

}  // namespace keyline::exchange::detail
