#include "keyline/exchange/text/line_reader.h"

#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/exchange/text/byte_lines.h"

/// Text in lines, from a stream and from memory.
namespace keyline::exchange {
namespace {

struct Read {
  std::vector<std::string> lines;
  std::string failure;  ///< its place
  bool ended_early = false;
};

Read read(const std::string& text, std::size_t longest = 100) {
  std::istringstream in(text);
  LineReader reader(in, "name", longest);
  Read all;
  for (;;) {
    bool end = false;
    const auto line = reader.next(end);
    if (!line) {
      all.failure = line.error().path;
      return all;
    }
    all.ended_early = reader.ended_early();
    if (end) return all;
    all.lines.emplace_back(*line);
    EXPECT_EQ(reader.number(), static_cast<int>(all.lines.size()));
  }
}

using Lines = std::vector<std::string>;

TEST(LineReader, LinesEndAnyWay) {
  EXPECT_EQ(read("a\nb\r\nc\rd").lines, (Lines{"a", "b", "c", "d"}));
  EXPECT_EQ(read("a\n\n\r\rb\n").lines, (Lines{"a", "", "", "", "b"}));
  EXPECT_EQ(read("").lines, Lines{});
  EXPECT_EQ(read("\n").lines, Lines{""});
  EXPECT_EQ(read("\r\n").lines, Lines{""});
}

// A return and a line feed that two chunks of 64 KiB part are one end.
TEST(LineReader, EndsMayBePartedByChunks) {
  const std::string first((1 << 16) - 1, 'x');
  const Read all = read(first + "\r\nsecond", 1 << 17);
  ASSERT_EQ(all.lines.size(), 2U);
  EXPECT_EQ(all.lines[0], first);
  EXPECT_EQ(all.lines[1], "second");
  EXPECT_EQ(read(first + "xy\nz", 1 << 17).lines[0], first + "xy");
}

TEST(LineReader, LongLinesAreRefused) {
  EXPECT_EQ(read(std::string(100, 'x')).lines.size(), 1U);
  EXPECT_EQ(read(std::string(101, 'x')).failure, "name:1");
  EXPECT_EQ(read("a\n" + std::string(101, 'x')).failure, "name:2");
}

TEST(LineReader, MarksAreNoText) {
  EXPECT_EQ(read("\xef\xbb\xbfx").lines, Lines{"x"});
  EXPECT_EQ(read(std::string("\xff\xfe"
                             "x\0\n\0y\0",
                             8))
                .lines,
            (Lines{"x", "y"}));  // UTF-16
  EXPECT_EQ(read(std::string("\xfe\xff\0x", 4)).lines, Lines{"x"});
  EXPECT_EQ(read("x\n\xef\xbb\xbfy").lines[1], "\xef\xbb\xbfy");  // only at the start
}

TEST(LineReader, LinesThatAreNoUtf8AreWindows1252) {
  EXPECT_EQ(read("caf\xe9\ncaf\xc3\xa9").lines, (Lines{"caf\u00e9", "caf\u00e9"}));
}

// Bytes below the blank but for tab, form feed and the ends are binary data.
TEST(LineReader, ControlBytesAreRefused) {
  EXPECT_EQ(read("a\tb\fc\vd").lines.size(), 1U);
  for (const char c : {'\x01', '\x08', '\x0e', '\x1b', '\x1f'})
    EXPECT_EQ(read(std::string("ok\nx") + c).failure, "name:2") << int{c};
  EXPECT_EQ(read(std::string("a\0b", 3)).failure, "name:1");
}

// The end mark of CP/M: what is no text behind it is left out.
TEST(LineReader, EndMarksEndWhatIsNoTextBehindThem) {
  const Read plain = read("a\nb\x1a\n");
  EXPECT_EQ(plain.lines, (Lines{"a", "b\x1a"}));
  EXPECT_FALSE(plain.ended_early);
  const Read early = read(std::string("a\n\x1a\0\0more", 10));
  EXPECT_EQ(early.failure, "");
  EXPECT_TRUE(early.ended_early);
  EXPECT_EQ(early.lines, Lines{"a"});
}

TEST(ByteLines, AreTheSameInMemory) {
  detail::ByteLines lines("a\r\nb\rc\n\nd");
  Lines all;
  std::string_view line;
  std::size_t number = 0;
  while (lines.next(line)) {
    all.emplace_back(line);
    EXPECT_EQ(lines.number(), ++number);
  }
  EXPECT_EQ(all, (Lines{"a", "b", "c", "", "d"}));
  EXPECT_EQ(lines.place(), "line 5");
  EXPECT_EQ(lines.position(), 9U);
  detail::ByteLines first("ab\r\ncd");
  first.next(line);
  EXPECT_EQ(first.position(), 4U);
}

// Files of other programs are called what they are, though most are text with numbers in it.
TEST(LineReader, ForeignFormatsAreNamed) {
  const auto failure = [](const std::string& text) {
    std::istringstream in(text);
    LineReader reader(in, "a", 100);
    bool end = false;
    const auto line = reader.next(end);
    return line ? std::string() : line.error().message + "; " + line.error().hint;
  };
  const std::string mesh = "this is a mesh in OFF; export it as .ply, .obj or .stl";
  for (const char* word : {"OFF", "COFF", "STOFF", "4nOFF"})
    EXPECT_EQ(failure(std::string(word) + "\n3 1 0\n0 0 0\n"), mesh) << word;
  for (const char* title : {"CUTOFF\n", "OFF", "OFF-ROAD\n", "PK\n", "% PDF\n", "AC1027\n"})
    EXPECT_EQ(failure(title), "") << title;
  for (const char* word : {"VECT", "4VECT # of one", "SKEL\t", "QUAD", "CQUAD", "CNMESH 3 2",
                           "ZMESH", "BEZ333", "CBEZ32", "BBP", "AC3Db", "*3DSMAX_ASCIIEXPORT\t200",
                           "HIERARCHY", "ncols 4", "**ABCDEFGHIJKLMNOPQRSTUVWXYZabcdef"})
    EXPECT_TRUE(failure(std::string(word) + "\n1 2 3\n").starts_with("this is ")) << word;
  for (const char* title : {"VECT 12 %\n", "SQUADRON\n", "MESH of the hull\n", "AQUAD\n"})
    EXPECT_EQ(failure(title), "") << title;
  EXPECT_EQ(failure("PK\3\4\x14"),
            "this is a zip archive; unpack it; of a FreeCAD document export STEP, of a "
            "spreadsheet CSV");
  EXPECT_EQ(failure("%PDF-1.4\n%\xe2\xe3\n1 0 obj\n"),
            "this is a PDF file; convert it to SVG, as Inkscape does");
  EXPECT_EQ(failure("%!PS-Adobe-3.0 EPSF-3.0\n"),
            "this is PostScript; convert it to SVG, as Inkscape does");
  EXPECT_EQ(failure(std::string("AC1027\0\0", 8)), "this is a DWG file; save it as DXF");
}

TEST(ByteLines, WordsArePartedByBlanks) {
  std::string_view line = " \tone  two\t";
  EXPECT_EQ(detail::take_word(line), "one");
  EXPECT_EQ(detail::take_word(line), "two");
  EXPECT_EQ(detail::take_word(line), "");
  EXPECT_TRUE(line.empty());
}

}  // namespace
}  // namespace keyline::exchange
