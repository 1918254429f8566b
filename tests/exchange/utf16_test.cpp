#include "keyline/exchange/text/utf16.h"

#include <string>
#include <string_view>

#include <gtest/gtest.h>

/// UTF-16 as RFC 2781 has it: beyond U+FFFF two halves, D800 to DBFF and DC00 to DFFF.
namespace keyline::exchange::detail {
namespace {

using namespace std::string_view_literals;

TEST(Utf16, EitherOrderBecomesUtf8) {
  EXPECT_EQ(from_utf16("\0a\0b"sv, true), "ab");
  EXPECT_EQ(from_utf16("a\0b\0"sv, false), "ab");
  EXPECT_EQ(from_utf16("\x20\xac"sv, true), "\u20ac");
  EXPECT_EQ(from_utf16("\xac\x20"sv, false), "\u20ac");
  EXPECT_EQ(from_utf16("\xfe\xff\0a"sv, true), "a");
  EXPECT_EQ(from_utf16("\0a\0"sv, true), "a");
  EXPECT_EQ(from_utf16("", true), "");
}

// U+10000 is D800 DC00, U+10FFFF is DBFF DFFF, U+1F697 is D83D DE97.
TEST(Utf16, HalvesAreOneCharacter) {
  EXPECT_EQ(from_utf16("\xd8\x00\xdc\x00"sv, true), "\U00010000");
  EXPECT_EQ(from_utf16("\xdb\xff\xdf\xff"sv, true), "\U0010FFFF");
  EXPECT_EQ(from_utf16("\x3d\xd8\x97\xde"sv, false), "\U0001F697");
  EXPECT_EQ(from_utf16("\xd8\x3d\xde\x97\0a"sv, true), "\U0001F697a");
  EXPECT_EQ(from_utf16("\xe0\x00\0a"sv, true), "\uE000a");
}

TEST(Utf16, MarksAreLeftOut) {
  EXPECT_EQ(without_mark("\xef\xbb\xbf"
                         "a"),
            "a");
  EXPECT_EQ(without_mark("a\xef\xbb\xbf"), "a\xef\xbb\xbf");
  EXPECT_EQ(in_utf8("\xef\xbb\xbf"
                    "a"),
            "a");
  EXPECT_EQ(in_utf8(std::string("\xff\xfe"
                                "a\0"sv)),
            "a");
}

TEST(Utf16, IsWrittenInDigits) {
  EXPECT_EQ(utf16_digits(0x41, "\\U+"), "\\U+0041");
  EXPECT_EQ(utf16_digits(0xFFFF), "FFFF");
  EXPECT_EQ(utf16_digits(0x10000), "D800DC00");
  EXPECT_EQ(utf16_digits(0x1F697, "\\U+"), "\\U+D83D\\U+DE97");
  EXPECT_EQ(utf16_digits(0x10FFFF), "DBFFDFFF");
}

// A first half without its second is no character, and takes none of the next with it.
TEST(Utf16, ALoneHalfTakesNothingWithIt) {
  EXPECT_TRUE(from_utf16("\xd8\x3d\0a"sv, true).ends_with("a"));
  EXPECT_TRUE(from_utf16("\xd8\x3d\xe0\x00"sv, true).ends_with("\uE000"));
}

TEST(Utf16, IsToldByItsMark) {
  EXPECT_TRUE(starts_as_utf16("\xff\xfe"));
  EXPECT_TRUE(starts_as_utf16("\xfe\xff"));
  EXPECT_FALSE(starts_as_utf16("\xff"));
  EXPECT_FALSE(starts_as_utf16("ab"));
  EXPECT_EQ(in_utf8(std::string("\xfe\xff\0a"sv)), "a");
  EXPECT_EQ(in_utf8(std::string("\xff\xfe\x61\0"sv)), "a");
  EXPECT_EQ(in_utf8("plain"), "plain");
}

// In pieces of any size it is the same.
TEST(Utf16, ComesInPieces) {
  const std::string_view bytes = "\0a\xd8\x3d\xde\x97\x20\xac\xd8\x00\xdc\x00\0b"sv;
  for (std::size_t size = 1; size <= bytes.size(); ++size) {
    Utf16Decoder decoder(true);
    std::string text;
    for (std::size_t at = 0; at < bytes.size(); at += size)
      text += decoder.next(bytes.substr(at, size));
    EXPECT_EQ(text, "a\U0001F697\u20ac\U00010000b") << size;
  }
}

}  // namespace
}  // namespace keyline::exchange::detail
