#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "keyline/core/error.h"

namespace keyline::exchange::detail {

/// One group of a DXF file: its code and its value, as text (ASCII files and strings) or number.
struct DxfTag {
  std::string_view text = {};
  double number = std::numeric_limits<double>::quiet_NaN();  ///< set in binary files
  int code = 0;
  std::uint32_t place = 0;  ///< line (ASCII) or byte (binary)
};

/// Value as a finite number; empty where it is none.
std::optional<double> number_of(const DxfTag& tag);
/// Value as a whole number of at most nine digits.
std::optional<int> integer_of(const DxfTag& tag);
/// Value as UTF-8: bytes that are none are read as Windows-1252, \U+ and four
/// hexadecimal digits are resolved.
std::string text_of(const DxfTag& tag);

/// Reads the groups of a DXF file, ASCII or binary (R12's one-byte codes and the later two-byte
/// ones), one after the other. Views point into the bytes given.
class DxfTags {
 public:
  explicit DxfTags(std::string_view bytes);

  /// The next group; empty at the end of the file.
  /// Fails: bad_input with "line N" or "byte N" where no group stands.
  core::Result<std::optional<DxfTag>> next();

  /// "line 12" or "byte 345".
  std::string place(const DxfTag& tag) const;

 private:
  core::Result<std::optional<DxfTag>> next_text();
  core::Result<std::optional<DxfTag>> next_binary();
  std::string_view line();
  std::unexpected<core::Failure> failure(std::string what) const;
  // false where the file ends within what is taken
  template <class T>
  bool take(T& value);
  bool take_code(std::int16_t& code);
  bool take_value(DxfTag& tag);

  std::string_view bytes_;
  std::size_t position_ = 0;
  std::size_t line_ = 0;
  bool binary_ = false;
  bool short_codes_ = false;
};

}  // namespace keyline::exchange::detail
