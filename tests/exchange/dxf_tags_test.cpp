#include "keyline/exchange/dxf/dxf_tags.h"

#include <bit>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

/// Groups of DXF files, ASCII and binary.
namespace keyline::exchange::detail {
namespace {

DxfTag with_text(std::string_view text) { return {.text = text}; }

TEST(DxfTags, NumbersAreFiniteOrNone) {
  EXPECT_EQ(number_of(with_text("  1.5 ")), 1.5);
  EXPECT_EQ(number_of(with_text("\t-2e3")), -2000);
  for (const char* none : {"", "  ", "abc", "1,5", "1e400", "nan", "1 2"})
    EXPECT_FALSE(number_of(with_text(none))) << none;
  DxfTag binary;
  binary.number = 7;
  EXPECT_EQ(number_of(binary), 7);
  EXPECT_EQ(integer_of(with_text("12.7")), 12);
  EXPECT_EQ(integer_of(with_text("-999999999")), -999999999);
  EXPECT_EQ(integer_of(with_text("999999999")), 999999999);
  EXPECT_FALSE(integer_of(with_text("1000000000")));
  EXPECT_FALSE(integer_of(with_text("-1000000000")));
}

// \U+ and four hexadecimal digits are a unit of UTF-16, two such units one character beyond; bytes
// that are no UTF-8 are Latin-1.
TEST(DxfTags, TextsBecomeUtf8) {
  EXPECT_EQ(text_of(with_text("plain")), "plain");
  EXPECT_EQ(text_of(with_text("a\\U+00E9b")), "a\u00e9b");
  EXPECT_EQ(text_of(with_text("\\U+D83D\\U+DE00x")), "\U0001F600x");
  EXPECT_EQ(text_of(with_text("\\U+0020.")), " .");
  EXPECT_EQ(text_of(with_text("\\U+001F.")), "\\U+001F.");
  EXPECT_EQ(text_of(with_text("\\U+00E")), "\\U+00E");
  EXPECT_EQ(text_of(with_text("\\U+00EG")), "\\U+00EG");
  EXPECT_EQ(text_of(with_text("caf\xe9")), "caf\u00e9");
  EXPECT_EQ(text_of(with_text("caf\xc3\xa9")), "caf\u00e9");
}

struct Group {
  int code = 0;
  std::string text;
  std::uint32_t place = 0;
  bool operator==(const Group&) const = default;
};

std::vector<Group> all(const std::string& bytes, bool& sound) {
  DxfTags tags(bytes);
  std::vector<Group> groups;
  for (;;) {
    const auto tag = tags.next();
    sound = tag.has_value();
    if (!sound || !*tag) return groups;
    groups.push_back({(*tag)->code, std::string((*tag)->text), (*tag)->place});
  }
}

std::vector<Group> all(const std::string& bytes) {
  bool sound = false;
  auto groups = all(bytes, sound);
  EXPECT_TRUE(sound);
  return groups;
}

TEST(DxfTags, LinesEndAnyWay) {
  const std::vector<Group> meant{{0, "SECTION", 2}, {10, " 1.5", 4}};
  EXPECT_EQ(all("0\nSECTION\n 10\n 1.5\n"), meant);
  EXPECT_EQ(all("0\r\nSECTION\r\n10\r\n 1.5"), meant);
  EXPECT_EQ(all("0\rSECTION\r10\r 1.5\r"), meant);
  EXPECT_EQ(all("\xef\xbb\xbf"
                "0\nSECTION\n10\n 1.5\n\n \n"),
            meant);
  EXPECT_EQ(all("1\n\n"), (std::vector<Group>{{1, "", 2}}));
}

TEST(DxfTags, WhatIsNoGroupIsNamedByItsLine) {
  for (const char* bad : {"0\nA\nx\nB\n", "0\nA\n1072\nB\n", "0\nA\n-6\nB\n", "0\nA\n1.5\nB\n"}) {
    bool sound = true;
    EXPECT_EQ(all(bad, sound).size(), 1U) << bad;
    EXPECT_FALSE(sound);
    DxfTags tags{bad};
    static_cast<void>(tags.next());
    EXPECT_EQ(tags.next().error().path, "line 3");
  }
  bool sound = true;
  all("0\nA\n1071\nB\n-5\nC\n", sound);
  EXPECT_TRUE(sound);
  all("0\nA\n10", sound);  // a code without its value
  EXPECT_FALSE(sound);
  all("\n0\nA\n", sound);  // empty lines are let pass at the end alone
  EXPECT_FALSE(sound);
}

/// Bytes of a binary file with two-byte codes.
class Binary {
 public:
  Binary() : bytes_("AutoCAD Binary DXF\r\n\x1a\0", 22) {}
  Binary& code(int c) { return number(c, 2); }
  Binary& number(std::int64_t value, int size) {
    for (int i = 0; i < size; ++i)
      bytes_ += static_cast<char>(static_cast<std::uint64_t>(value) >> (8 * i) & 255);
    return *this;
  }
  Binary& real(double value) { return number(std::bit_cast<std::int64_t>(value), 8); }
  Binary& text(const char* value) {
    bytes_ += value;
    bytes_ += '\0';
    return *this;
  }
  Binary& raw(const std::string& more) {
    bytes_ += more;
    return *this;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

// What a code holds by the DXF reference, at the ends of its ranges: reals of 8 bytes, integers of
// 2, 4, 8 and 1, chunks behind their count.
TEST(DxfTags, BinaryGroupsHoldWhatTheirCodesSay) {
  struct Case {
    int low, high, size;
  };
  for (const Case& c : {Case{10, 59, 8},
                        {110, 149, 8},
                        {210, 239, 8},
                        {460, 469, 8},
                        {1010, 1059, 8},
                        {60, 79, 2},
                        {170, 179, 2},
                        {270, 289, 2},
                        {370, 389, 2},
                        {400, 409, 2},
                        {1060, 1070, 2},
                        {90, 99, 4},
                        {420, 429, 4},
                        {440, 459, 4},
                        {1071, 1071, 4},
                        {160, 169, 8},
                        {290, 299, 1}})
    for (const int code : {c.low, c.high}) {
      const bool real = c.size == 8 && !(c.low == 160);
      Binary file;
      file.code(0).text("A").code(code);
      real ? file.real(-2.5) : file.number(-2, c.size);
      file.code(1).text("end");
      DxfTags tags(file.bytes());
      static_cast<void>(tags.next());
      const auto tag = tags.next();
      ASSERT_TRUE(tag && *tag) << code;
      EXPECT_EQ((*tag)->number, real ? -2.5 : -2.0) << code;
      const auto last = tags.next();
      ASSERT_TRUE(last && *last) << code;
      EXPECT_EQ((*last)->text, "end") << code;
      EXPECT_FALSE(*tags.next());
    }
  for (const int code : {0, 9, 100, 109, 150, 300, 309, 330, 390, 410, 430, 470, 999, 1009}) {
    Binary file;
    file.code(0).text("A").code(code).text("word").code(1).text("end");
    const auto groups = all(file.bytes());
    ASSERT_EQ(groups.size(), 3U) << code;
    EXPECT_EQ(groups[1].text, "word") << code;
  }
  for (const int code : {310, 319, 1004}) {
    Binary file;
    file.code(0)
        .text("A")
        .code(code)
        .raw(std::string("\x03"
                         "abc"))
        .code(1)
        .text("end");
    const auto groups = all(file.bytes());
    ASSERT_EQ(groups.size(), 3U) << code;
    EXPECT_EQ(groups[2].text, "end") << code;
  }
}

// R12 writes codes of one byte, and 255 before those of two.
TEST(DxfTags, OldBinaryFilesHaveCodesOfOneByte) {
  Binary file;
  file.number(0, 1).text("SECTION").number(70, 1).number(5, 2).number(255, 1).code(1010).real(1.5);
  DxfTags tags(file.bytes());
  EXPECT_EQ((*tags.next())->text, "SECTION");
  const auto flags = *tags.next();
  EXPECT_EQ(flags->code, 70);
  EXPECT_EQ(flags->number, 5);
  const auto real = *tags.next();
  EXPECT_EQ(real->code, 1010);
  EXPECT_EQ(real->number, 1.5);
  EXPECT_EQ(tags.place(*real), "byte 34");  // 22 + 1 + 8 + 1 + 2
}

TEST(DxfTags, BinaryFilesThatEndEarlySaySo) {
  for (const std::string& bytes : {Binary().code(0).text("A").code(10).number(0, 7).bytes(),
                                   Binary().code(0).text("A").code(1).raw("no end").bytes(),
                                   Binary()
                                       .code(0)
                                       .text("A")
                                       .code(310)
                                       .raw(std::string("\x05"
                                                        "abc"))
                                       .bytes(),
                                   Binary().code(0).text("A").number(1, 1).bytes(),
                                   Binary().code(0).text("A").code(1072).text("x").bytes(),
                                   Binary().code(0).text("A").code(-1).text("x").bytes()}) {
    bool sound = true;
    all(bytes, sound);
    EXPECT_FALSE(sound);
  }
}

}  // namespace
}  // namespace keyline::exchange::detail
