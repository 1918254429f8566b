#include "keyline/exchange/svg/svg_text.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <utility>

#include <zlib.h>

#include "keyline/core/utf8.h"
#include "keyline/exchange/text/ascii.h"
#include "keyline/exchange/text/utf16.h"

namespace keyline::exchange::detail {
namespace {

using core::ErrorCode;
using core::fail;
using core::Result;

Result<std::string> uncompressed(std::string_view bytes, std::size_t largest) {
  const std::size_t most = std::min(largest, 10 * bytes.size() + (std::size_t{10} << 20));
  z_stream stream{};
  constexpr int kGzip = 16 + MAX_WBITS;
  if (inflateInit2(&stream, kGzip) != Z_OK)
    return fail(ErrorCode::internal, "the compressed SVG file cannot be opened");
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(std::min<std::size_t>(bytes.size(), 1U << 31));
  std::string text;
  std::array<char, 1 << 16> chunk{};
  int state = Z_OK;
  while (state == Z_OK && text.size() <= most) {
    stream.next_out = reinterpret_cast<Bytef*>(chunk.data());
    stream.avail_out = static_cast<uInt>(chunk.size());
    state = inflate(&stream, Z_NO_FLUSH);
    text.append(chunk.data(), chunk.size() - stream.avail_out);
  }
  inflateEnd(&stream);
  if (text.size() > most)
    return fail(ErrorCode::bad_input, "the compressed SVG file holds too much",
                "uncompress it first (gunzip)");
  if (state != Z_STREAM_END)
    return fail(ErrorCode::bad_input, "the compressed SVG file is broken",
                "check that it is complete",
                "byte " + std::to_string(bytes.size() - stream.avail_in));
  return text;
}

/// Whether a text starts as XML does, behind a byte order mark or in UTF-16, too.
bool may_be_xml(std::string_view text) {
  const std::size_t at =
      text.find_first_not_of(std::string_view(" \t\r\n\0\xef\xbb\xbf\xfe\xff", 10));
  return at != text.npos && text[at] == '<';
}

/// The encoding an XML declaration states, in lower case.
std::string declared_encoding(std::string_view bytes) {
  const std::string_view head = bytes.substr(0, std::min<std::size_t>(bytes.find("?>"), 300));
  const std::size_t word = head.find("encoding");
  if (word == std::string_view::npos) return {};
  const std::size_t at = head.find_first_of("\"'", word);
  if (at == std::string_view::npos) return {};
  const std::size_t end = head.find(head[at], at + 1);
  if (end == std::string_view::npos) return {};
  return lower_case(head.substr(at + 1, end - at - 1));
}

/// Encodings in which XML's own characters, numbers and commands stand as in ASCII.
bool agrees_with_ascii(std::string_view name) {
  for (const char* family : {"iso-8859-", "latin", "windows-", "cp125", "koi8-", "mac", "us-ascii",
                             "shift_jis", "euc-", "gb", "big5", "utf-8"})
    if (name.starts_with(family)) return true;
  return false;
}

Result<void> to_utf8(SvgText& text, std::string_view bytes) {
  const std::string_view given = text.in(bytes);
  const bool big = given.starts_with("\xfe\xff") || given.starts_with(std::string_view("\0<", 2));
  const bool little =
      given.starts_with("\xff\xfe") || given.starts_with(std::string_view("<\0", 2));
  if (big || little) {
    text.own = from_utf16(given, big);
  } else if (!core::is_utf8(given)) {
    std::string name = declared_encoding(given);
    if (name.empty()) name = "utf-8";
    if (!agrees_with_ascii(name))
      return fail(ErrorCode::unsupported, "the SVG file is not in UTF-8 but in " + name,
                  "save it with the encoding UTF-8");
    text.own = core::from_windows_1252(given);
    if (name != "iso-8859-1" && name != "latin1" && name != "windows-1252")
      text.notes.push_back("names in " + name + ": only their ASCII letters are right");
  }
  return {};
}

using Entities = std::map<std::string, std::string, std::less<>>;

/// What <!ENTITY name "value"> define in the document type.
Entities entities_of(std::string_view type) {
  Entities entities;
  constexpr std::string_view kStart = "<!ENTITY";
  constexpr std::size_t kMost = 1000;
  constexpr std::string_view kSpace = " \t\r\n";
  for (std::size_t at = type.find(kStart); at != type.npos && entities.size() < kMost;
       at = type.find(kStart, at)) {
    at = type.find_first_not_of(kSpace, at + kStart.size());
    if (at == type.npos) break;
    const std::size_t end = type.find_first_of(" \t\r\n>", at);
    const std::size_t quote = end == type.npos ? end : type.find_first_not_of(kSpace, end);
    if (quote == type.npos) break;
    if (type[quote] != '"' && type[quote] != '\'') continue;  // of a file outside, or a parameter
    const std::size_t close = type.find(type[quote], quote + 1);
    if (close == type.npos) break;
    entities.emplace(type.substr(at, end - at), type.substr(quote + 1, close - quote - 1));
    at = close;
  }
  return entities;
}

/// Text with entities put in, as long as depth and room allow; false where they do not.
class Expansion {
 public:
  Expansion(const Entities& entities, std::size_t room) : entities_(entities), room_(room) {}

  bool append(std::string& result, std::string_view text, int depth) {
    constexpr int kDeepest = 8;
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t mark = text.find('&', at);
      result += text.substr(at, mark - at);
      if (mark == text.npos) return true;
      const std::size_t end = text.find(';', mark);
      const auto entity = end == text.npos ? entities_.end()
                                           : entities_.find(text.substr(mark + 1, end - mark - 1));
      if (entity == entities_.end()) {
        result += '&';
        at = mark + 1;
        continue;
      }
      if (depth == kDeepest || entity->second.size() > room_) return false;
      room_ -= entity->second.size();
      if (!append(result, entity->second, depth + 1)) return false;
      at = end + 1;
    }
    return true;
  }

 private:
  const Entities& entities_;
  std::size_t room_;
};

void expand_entities(SvgText& text, std::string_view bytes) {
  const std::string_view given = text.in(bytes);
  const std::size_t type = given.find("<!DOCTYPE");
  if (type == given.npos) return;
  const std::size_t inside = given.find_first_of("[>", type);
  if (inside == given.npos || given[inside] == '>') return;
  const std::size_t end = given.find(']', inside);
  if (end == given.npos) return;
  const Entities entities = entities_of(given.substr(inside, end - inside));
  const bool outside = given.substr(inside, end - inside).find("SYSTEM") != given.npos;
  if (outside) text.notes.emplace_back("entities of files outside are not read");
  if (entities.empty()) return;
  std::string result(given.substr(0, end));
  Expansion expansion(entities, given.size() / 2 + (std::size_t{1} << 20));
  if (expansion.append(result, given.substr(end), 0))
    text.own = std::move(result);
  else
    text.notes.emplace_back("entities of the document type are not expanded: they hold too much");
}

}  // namespace

Result<SvgText> svg_text(std::string_view bytes, std::size_t largest) {
  SvgText text;
  if (bytes.starts_with("\x1F\x8B")) {
    auto plain = uncompressed(bytes, largest);
    if (!plain) return std::unexpected(plain.error());
    text.own = std::move(*plain);
    if (!may_be_xml(text.own))
      return fail(ErrorCode::bad_input, "the compressed file holds no SVG",
                  "unpack it first (gunzip)");
  }
  if (auto done = to_utf8(text, bytes); !done) return std::unexpected(done.error());
  expand_entities(text, bytes);
  return text;
}

std::string compressed_svg(std::string_view text) {
  z_stream stream{};
  constexpr int kGzip = 16 + MAX_WBITS;
  constexpr int kMemory = 8;
  deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, kGzip, kMemory, Z_DEFAULT_STRATEGY);
  std::string bytes(deflateBound(&stream, text.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(bytes.data());
  stream.avail_out = static_cast<uInt>(bytes.size());
  deflate(&stream, Z_FINISH);
  bytes.resize(bytes.size() - stream.avail_out);
  deflateEnd(&stream);
  return bytes;
}

}  // namespace keyline::exchange::detail
