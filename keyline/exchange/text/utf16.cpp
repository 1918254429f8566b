#include "keyline/exchange/text/utf16.h"

#include <cstddef>
#include <utility>

#include "keyline/core/utf8.h"

namespace keyline::exchange::detail {
namespace {

unsigned unit_at(std::string_view bytes, std::size_t at, bool big_endian) {
  const auto a = static_cast<unsigned char>(bytes[at]);
  const auto b = static_cast<unsigned char>(bytes[at + 1]);
  return static_cast<unsigned>(big_endian ? a << 8 | b : b << 8 | a);
}

bool is_first_half(unsigned unit) { return unit >= 0xd800 && unit < 0xdc00; }

}  // namespace

bool starts_as_utf16(std::string_view bytes) {
  return bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff");
}

std::optional<unsigned> of_pair(unsigned first, unsigned second) {
  if (!is_first_half(first) || second < 0xdc00 || second >= 0xe000) return std::nullopt;
  return 0x10000 + ((first - 0xd800) << 10) + (second - 0xdc00);
}

std::string utf16_digits(unsigned code, std::string_view mark) {
  static constexpr char kDigits[] = "0123456789ABCDEF";
  std::string text;
  const auto append = [&](unsigned unit) {
    text += mark;
    for (int shift = 12; shift >= 0; shift -= 4) text += kDigits[unit >> shift & 15];
  };
  if (code > 0xffff) append(0xd7c0 + (code >> 10));  // 0xd800 + (code - 0x10000 >> 10)
  append(code > 0xffff ? 0xdc00 + (code & 0x3ff) : code);
  return text;
}

std::string from_utf16(std::string_view bytes, bool big_endian) {
  std::string text;
  for (std::size_t at = 0; at + 1 < bytes.size(); at += 2) {
    unsigned code = unit_at(bytes, at, big_endian);
    const unsigned next = at + 3 < bytes.size() ? unit_at(bytes, at + 2, big_endian) : 0;
    if (const auto both = of_pair(code, next)) {
      code = *both;
      at += 2;
    }
    if (code != 0xfeff) core::append_utf8(text, code);
  }
  return text;
}

std::string_view without_mark(std::string_view text) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  return text;
}

std::string in_utf8(std::string bytes) {
  if (starts_as_utf16(bytes)) return from_utf16(bytes, bytes[0] == '\xfe');
  bytes.erase(0, bytes.size() - without_mark(bytes).size());
  return bytes;
}

std::string Utf16Decoder::next(std::string_view bytes) {
  rest_ += bytes;
  std::size_t whole = rest_.size() / 2 * 2;
  if (whole >= 2 && is_first_half(unit_at(rest_, whole - 2, big_))) whole -= 2;
  std::string text = from_utf16(std::string_view(rest_).substr(0, whole), big_);
  rest_.erase(0, whole);
  return text;
}

}  // namespace keyline::exchange::detail
