#pragma once

#include <algorithm>
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

}  // namespace keyline::exchange::detail
