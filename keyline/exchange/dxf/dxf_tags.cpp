#include "keyline/exchange/dxf/dxf_tags.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <type_traits>

#include "keyline/core/leading_number.h"
#include "keyline/core/text.h"
#include "keyline/core/utf8.h"
#include "keyline/exchange/text/ascii.h"
#include "keyline/exchange/text/utf16.h"

namespace keyline::exchange::detail {
namespace {

using core::Result;

constexpr std::string_view kSentinel("AutoCAD Binary DXF\r\n\x1a\0", 22);

std::optional<int> code_of(std::string_view text) {
  const auto code = core::parse_whole<int>(trimmed(text));
  return code && *code >= -5 && *code <= 1071 ? code : std::nullopt;
}

/// What a binary group of this code holds.
enum class Kind { text, real, int16, int32, int64, flag, chunk };

Kind kind_of(int code) {
  const auto within = [code](int low, int high) { return code >= low && code <= high; };
  if (within(10, 59) || within(110, 149) || within(210, 239) || within(460, 469) ||
      within(1010, 1059))
    return Kind::real;
  if (within(60, 79) || within(170, 179) || within(270, 289) || within(370, 389) ||
      within(400, 409) || within(1060, 1070))
    return Kind::int16;
  if (within(90, 99) || within(420, 429) || within(440, 459) || code == 1071) return Kind::int32;
  if (within(160, 169)) return Kind::int64;
  if (within(290, 299)) return Kind::flag;
  if (within(310, 319) || code == 1004) return Kind::chunk;
  return Kind::text;
}

/// The unit of UTF-16 behind "\U+"; empty where there are no four hexadecimal digits.
std::optional<unsigned> unit_at(std::string_view text) {
  if (!text.starts_with("\\U+") || text.size() < 7) return std::nullopt;
  const auto code = core::parse_whole<unsigned>(text.substr(3, 4), 16);
  return code && *code >= 0x20 ? code : std::nullopt;
}

/// The code point the escapes at the start of the text stand for, and how many bytes they take.
std::optional<std::pair<unsigned, std::size_t>> escape_at(std::string_view text) {
  const auto first = unit_at(text);
  if (!first) return std::nullopt;
  if (const auto second = unit_at(text.substr(7)))
    if (const auto both = of_pair(*first, *second)) return std::pair{*both, std::size_t{14}};
  return std::pair{*first, std::size_t{7}};
}

}  // namespace

std::optional<double> number_of(const DxfTag& tag) {
  if (std::isfinite(tag.number)) return tag.number;
  return core::parse_number(trimmed(tag.text));
}

std::optional<int> integer_of(const DxfTag& tag) {
  const auto value = number_of(tag);
  if (!value || std::abs(*value) > 999'999'999) return std::nullopt;
  return static_cast<int>(*value);
}

std::string text_of(const DxfTag& tag) {
  const bool utf8 = core::is_utf8(tag.text);
  std::string text;
  for (std::size_t i = 0; i < tag.text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(tag.text[i]);
    if (const auto escape = escape_at(tag.text.substr(i))) {
      core::append_utf8(text, escape->first);
      i += escape->second - 1;
    } else if (utf8 || byte < 0x80) {
      text += tag.text[i];
    } else {
      text += core::from_windows_1252(tag.text.substr(i, 1));
    }
  }
  return text;
}

DxfTags::DxfTags(std::string_view bytes) : bytes_(bytes) {
  binary_ = bytes_.starts_with(kSentinel);
  if (binary_) {
    position_ = kSentinel.size();
    // The first group is "0 SECTION": a second zero byte belongs to a two-byte code.
    short_codes_ = bytes_.size() > position_ + 1 && bytes_[position_ + 1] != '\0';
  } else {
    position_ = bytes_.size() - detail::without_mark(bytes_).size();
  }
}

std::string DxfTags::place(const DxfTag& tag) const {
  return (binary_ ? "byte " : "line ") + std::to_string(tag.place);
}

std::unexpected<core::Failure> DxfTags::failure(std::string what) const {
  return core::fail(
      core::ErrorCode::bad_input, std::move(what), "check that the file is a complete DXF file",
      binary_ ? "byte " + std::to_string(position_) : "line " + std::to_string(line_));
}

Result<std::optional<DxfTag>> DxfTags::next() { return binary_ ? next_binary() : next_text(); }

std::string_view DxfTags::line() {
  ++line_;
  const std::size_t from = position_;
  const std::size_t end = bytes_.find_first_of("\r\n", from);
  if (end == std::string_view::npos) {
    position_ = bytes_.size();
    return bytes_.substr(from);
  }
  const bool two = bytes_[end] == '\r' && end + 1 < bytes_.size() && bytes_[end + 1] == '\n';
  position_ = end + (two ? 2 : 1);
  return bytes_.substr(from, end - from);
}

Result<std::optional<DxfTag>> DxfTags::next_text() {
  std::string_view first;
  do {  // empty lines at the very end are let pass
    if (position_ >= bytes_.size()) return std::nullopt;
    first = trimmed(line());
  } while (first.empty() && bytes_.find_first_not_of(" \t\r\n", position_) == bytes_.npos);
  const auto code = code_of(first);
  if (!code) return failure("a group code (a whole number) is expected here");
  if (position_ >= bytes_.size()) return failure("the file ends within a group");
  DxfTag tag;
  tag.code = *code;
  tag.text = line();
  if (tag.code == 0) tag.text = trimmed(tag.text);
  tag.place = static_cast<std::uint32_t>(line_);
  return tag;
}

template <class T>
bool DxfTags::take(T& value) {
  if (bytes_.size() - position_ < sizeof(T)) return false;
  std::make_unsigned_t<std::conditional_t<std::is_floating_point_v<T>, std::int64_t, T>> bits = 0;
  for (std::size_t i = 0; i < sizeof(T); ++i)
    bits = static_cast<decltype(bits)>(
        bits | static_cast<decltype(bits)>(static_cast<unsigned char>(bytes_[position_ + i]))
                   << (8 * i));
  position_ += sizeof(T);
  value = std::bit_cast<T>(bits);
  return true;
}

bool DxfTags::take_code(std::int16_t& code) {
  if (!short_codes_) return take(code);
  std::uint8_t small = 0;
  if (!take(small)) return false;
  code = small;
  return small != 255 || take(code);
}

bool DxfTags::take_value(DxfTag& tag) {
  const auto number = [&]<class T>(T value) {
    const bool whole = take(value);
    tag.number = static_cast<double>(value);
    return whole;
  };
  switch (kind_of(tag.code)) {
    case Kind::real:
      return number(double{});
    case Kind::int16:
      return number(std::int16_t{});
    case Kind::int32:
      return number(std::int32_t{});
    case Kind::int64:
      return number(std::int64_t{});
    case Kind::flag:
      return number(std::int8_t{});
    case Kind::chunk: {
      std::uint8_t size = 0;
      if (!take(size) || bytes_.size() - position_ < size) return false;
      position_ += size;
      return true;
    }
    case Kind::text: {
      const std::size_t end = bytes_.find('\0', position_);
      if (end == std::string_view::npos) return false;
      tag.text = bytes_.substr(position_, end - position_);
      position_ = end + 1;
      return true;
    }
  }
  return false;
}

Result<std::optional<DxfTag>> DxfTags::next_binary() {
  if (position_ >= bytes_.size()) return std::nullopt;
  DxfTag tag;
  tag.place = static_cast<std::uint32_t>(position_);
  std::int16_t code = 0;
  const bool whole = take_code(code);
  tag.code = code;
  if (code < 0 || code > 1071) return failure("a group code is expected here");
  if (!whole || !take_value(tag)) return failure("the file ends within a group");
  return tag;
}

}  // namespace keyline::exchange::detail
