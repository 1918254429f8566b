#include "keyline/exchange/text/line_reader.h"

#include <algorithm>
#include <utility>

#include "keyline/core/utf8.h"

namespace keyline::exchange {
namespace {

constexpr std::size_t kChunk = 1 << 16;

/// Control bytes no text file of numbers holds.
bool is_control(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return byte < 0x20 && c != '\t' && c != '\n' && c != '\r' && c != '\f' && c != '\v' &&
         byte != 0x1a;
}

}  // namespace

LineReader::LineReader(std::istream& in, std::string name, std::size_t longest)
    : in_(in), name_(std::move(name)), longest_(longest), chunk_(kChunk) {}

std::unexpected<core::Failure> LineReader::failure(std::string message, std::string hint) const {
  return core::fail(core::ErrorCode::bad_input, std::move(message), std::move(hint), place());
}

bool LineReader::fill() {
  position_ = filled_ = 0;
  while (filled_ == 0) {
    in_.read(chunk_.data(), std::ssize(chunk_));
    if (in_.gcount() == 0) break;
    const std::string_view chunk(chunk_.data(), static_cast<std::size_t>(in_.gcount()));
    if (!started_ && detail::starts_as_utf16(chunk)) utf16_.emplace(chunk[0] == '\xfe');
    buffer_ = utf16_ ? utf16_->next(chunk) : std::string(chunk);
    filled_ = buffer_.size();
    if (std::exchange(started_, true)) continue;
    foreign_ = detail::foreign_format(buffer_);
    position_ = buffer_.size() - detail::without_mark(buffer_).size();
  }
  return filled_ > 0;
}

std::string_view LineReader::in_utf8() {
  const bool plain = std::none_of(line_.begin(), line_.end(),
                                  [](char c) { return static_cast<unsigned char>(c) >= 0x80; });
  if (!plain && !core::is_utf8(line_)) line_ = core::from_windows_1252(line_);
  return line_;
}

bool LineReader::ends_return() {
  const bool expected = std::exchange(after_return_, false);
  if (!expected || position_ == filled_ || buffer_[position_] != '\n') return false;
  ++position_;
  return true;
}

core::Result<LineReader::Taken> LineReader::take() {
  if (foreign_) return failure(foreign_->what, foreign_->advice);
  const char* from = buffer_.data() + position_;
  const char* to = buffer_.data() + filled_;
  const char* stop = std::find_if(from, to, [](char c) { return c == '\n' || c == '\r'; });
  const char* control = std::find_if(from, stop, is_control);
  end_mark_ = end_mark_ || std::find(from, control, '\x1a') != control;
  if (control != stop && end_mark_) {
    ended_early_ = true;
    position_ = filled_ = 0;
    in_.setstate(std::ios::eofbit);
    return Taken::end_of_text;
  }
  if (control != stop) {
    return failure("this is not text (binary data found)",
                   "give a text file with one point per line");
  }
  if (line_.size() + static_cast<std::size_t>(stop - from) > longest_) {
    return failure("this line is longer than " + std::to_string(longest_) + " bytes",
                   "give a text file with one point per line");
  }
  line_.append(from, stop);
  position_ = static_cast<std::size_t>(stop - buffer_.data());
  if (stop == to) return Taken::part;
  after_return_ = *stop == '\r';
  ++position_;
  return Taken::line;
}

core::Result<std::string_view> LineReader::next(bool& end) {
  end = false;
  line_.clear();
  ++number_;
  bool any = false;
  while (position_ < filled_ || fill()) {
    if (ends_return()) continue;
    any = true;
    const auto taken = take();
    if (!taken) return std::unexpected(taken.error());
    if (*taken == Taken::line) return in_utf8();
    if (*taken == Taken::end_of_text) {
      end = line_.empty();
      return std::string_view(line_);
    }
  }
  if (in_.bad()) {
    return core::fail(core::ErrorCode::io, "reading failed", "check the device or the network",
                      name_);
  }
  end = !any;
  return in_utf8();
}

}  // namespace keyline::exchange
