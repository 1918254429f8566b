#include "keyline/exchange/text/utf16.h"

#include <cstddef>

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

std::string from_utf16(std::string_view bytes, bool big_endian) {
  std::string text;
  for (std::size_t at = 0; at + 1 < bytes.size(); at += 2) {
    unsigned code = unit_at(bytes, at, big_endian);
    const bool pair = is_first_half(code) && at + 3 < bytes.size();
    if (const unsigned low = pair ? unit_at(bytes, at + 2, big_endian) : 0;
        low >= 0xdc00 && low < 0xe000) {
      code = 0x10000 + ((code - 0xd800) << 10) + (low - 0xdc00);
      at += 2;
    }
    if (code != 0xfeff) core::append_utf8(text, code);
  }
  return text;
}

std::string in_utf8(std::string bytes) {
  return starts_as_utf16(bytes) ? from_utf16(bytes, bytes[0] == '\xfe') : std::move(bytes);
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
