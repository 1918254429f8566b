#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace keyline::exchange::detail {

/// True for a byte order mark of UTF-16, as Windows' editors and shells begin a text.
bool starts_as_utf16(std::string_view bytes);

/// The code point that two units of UTF-16 are together; empty where they are no pair.
std::optional<unsigned> of_pair(unsigned first, unsigned second);

/// The one or two units of a code point, each as four hexadecimal digits behind `mark`.
std::string utf16_digits(unsigned code, std::string_view mark = "");

/// UTF-16 as UTF-8, without byte order marks; half a character at the end is left out.
std::string from_utf16(std::string_view bytes, bool big_endian);

/// Without the byte order mark that some editors put before UTF-8.
std::string_view without_mark(std::string_view text);

/// A text that starts_as_utf16() as UTF-8, anything else as it is; without a byte order mark.
std::string in_utf8(std::string bytes);

/// The same a piece at a time.
class Utf16Decoder {
 public:
  explicit Utf16Decoder(bool big_endian) : big_(big_endian) {}

  /// The characters that the next bytes complete.
  std::string next(std::string_view bytes);

 private:
  bool big_;
  std::string rest_;  // of a character that goes on
};

}  // namespace keyline::exchange::detail
