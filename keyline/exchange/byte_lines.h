#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

namespace keyline::exchange::detail {

/// Lines of text in memory; ends are \n, \r\n or \r.
class ByteLines {
 public:
  explicit ByteLines(std::string_view bytes) : bytes_(bytes) {}

  bool next(std::string_view& line) {
    if (position_ >= bytes_.size()) return false;
    const std::size_t from = position_;
    const std::size_t end = std::min(bytes_.find_first_of("\r\n", from), bytes_.size());
    const bool two = end + 1 < bytes_.size() && bytes_[end] == '\r' && bytes_[end + 1] == '\n';
    position_ = std::min(end + (two ? 2 : 1), bytes_.size());
    line = bytes_.substr(from, end - from);
    ++number_;
    return true;
  }
  std::size_t number() const { return number_; }
  std::string place() const { return "line " + std::to_string(number_); }
  std::size_t position() const { return position_; }

 private:
  std::string_view bytes_;
  std::size_t position_ = 0;
  std::size_t number_ = 0;
};

/// The next word of a line parted by blanks; empty at its end.
inline std::string_view take_word(std::string_view& line) {
  const std::size_t from = line.find_first_not_of(" \t\f\v");
  if (from == std::string_view::npos) {
    line = {};
    return {};
  }
  const std::size_t end = std::min(line.find_first_of(" \t\f\v", from), line.size());
  const std::string_view word = line.substr(from, end - from);
  line.remove_prefix(end);
  return word;
}

/// The finite number a word starts with; empty where it starts with none. What follows is let pass,
/// as everywhere with these formats.
inline std::optional<double> leading_number(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace keyline::exchange::detail
