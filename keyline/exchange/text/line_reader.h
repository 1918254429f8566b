#pragma once

#include <cstddef>
#include <istream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "keyline/core/error.h"
#include "keyline/exchange/text/foreign_format.h"
#include "keyline/exchange/text/utf16.h"

namespace keyline::exchange {

/// Reads text line by line in bounded memory: lines end with \n, \r\n or \r; a byte order mark of
/// UTF-8 is skipped, behind one of UTF-16 the text is turned into UTF-8, and a line that is no
/// UTF-8 is taken for Windows-1252. A ^Z (the end mark of CP/M and DOS) is white space, and what is
/// no text behind one ends the input. Binary content and overlong lines are failures with the place
/// "name:line".
class LineReader {
 public:
  /// name: what failures call the input. longest: largest number of bytes in a line.
  LineReader(std::istream& in, std::string name, std::size_t longest);

  /// The next line without its end, valid until the next call. Sets `end` and returns an empty
  /// line after the last one.
  core::Result<std::string_view> next(bool& end);

  /// 1-based number of the line last returned.
  int number() const { return number_; }

  /// True once bytes that are no text were met behind a ^Z, and left out.
  bool ended_early() const { return ended_early_; }

  /// "name:line" of the line last returned.
  std::string place() const { return name_ + ":" + std::to_string(number_); }

 private:
  bool fill();
  /// Skips the \n of an \r\n whose \r ended the line before; false where there is none.
  bool ends_return();
  /// To the line what of it stands in the buffer: all of it, a part, or what there is before bytes
  /// that are no text.
  enum class Taken { line, part, end_of_text };
  core::Result<Taken> take();
  std::string_view in_utf8();
  std::unexpected<core::Failure> failure(std::string message, std::string hint) const;

  std::istream& in_;
  std::string name_;
  std::size_t longest_;
  std::vector<char> chunk_;  ///< as read
  std::optional<detail::Utf16Decoder> utf16_;
  std::string buffer_;
  std::size_t position_ = 0;
  std::size_t filled_ = 0;
  std::string line_;
  int number_ = 0;
  bool started_ = false;
  const detail::ForeignFormat* foreign_ = nullptr;  ///< what the input is, where that is known
  bool after_return_ = false;
  bool end_mark_ = false;
  bool ended_early_ = false;
};

}  // namespace keyline::exchange
