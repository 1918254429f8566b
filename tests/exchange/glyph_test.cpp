#include <cmath>
#include <filesystem>
#include <fstream>

#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "keyline/core/angle.h"
#include "keyline/curve/closest_point.h"
#include "keyline/exchange/document_file.h"
#include "keyline/exchange/font/font.h"
#include "keyline/exchange/font/glif.h"

#include "tests/shared_data.h"

namespace keyline::exchange {
namespace {

namespace fs = std::filesystem;
using core::Point2;
using curve::Bezier2;
using document::Document;
using testing::HasSubstr;

const Bezier2& piece(const Document& d, std::size_t path, std::size_t i) {
  return std::get<Bezier2>(d.paths.at(path).path.curves.at(i).value);
}

TEST(Glif, ComponentsComeFromTheFolderWithTheirTransforms) {
  namespace fs = std::filesystem;
  const fs::path folder =
      fs::temp_directory_path() / ("keyline-glif-" + std::to_string(::getpid()));
  fs::create_directories(folder);
  const auto file = [&](const char* name, const std::string& outline) {
    std::ofstream(folder / name) << "<glyph name='" << name << "'><outline>" << outline
                                 << "</outline></glyph>";
  };
  std::ofstream(folder / "contents.plist")
      << "<plist><dict><key>acute</key><string>../x/acute_.glif</string></dict></plist>";
  file("acute_.glif",
       "<contour><point x='0' y='0' type='move'/><point x='1' y='2' type='line'/>"
       "</contour>");
  file("e.glif", "<component base='acute' xScale='2' xyScale='1' xOffset='10'/>");
  file("loop.glif", "<component base='loop'/><component base='loop'/><component base='none'/>");
  const auto read = read_document(folder / "e.glif");
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->paths.size(), 1U);
  EXPECT_EQ(evaluate(read->paths[0].path, 0), (core::Point2{10, 0}));
  EXPECT_EQ(evaluate(read->paths[0].path, 1), (core::Point2{12, 3}));
  EXPECT_FALSE(read_document(folder / "loop.glif"));
  fs::remove_all(folder);
}

TEST(Glif, ReadsEveryKindOfContour) {
  const auto d = read_glif(R"(<?xml version="1.0"?><glyph name="a" format="2"><outline>
    <contour><point x="0" y="0" type="line"/><point x="10" y="0" type="line"/><point x="10" y="5"/>
      <point x="5" y="10"/><point x="0" y="10" type="curve" smooth="yes"/></contour>
    <contour><point x="0" y="0" type="move"/><point x="1" y="2"/><point x="3" y="2"/>
      <point x="4" y="0" type="qcurve"/></contour>
    <contour><point x="0" y="0"/><point x="2" y="0"/><point x="2" y="2"/><point x="0" y="2"/></contour>
    <contour><point x="1" y="1" type="move" name="top"/></contour>
    <component base="acute"/></outline></glyph>)");
  ASSERT_TRUE(d) << d.error().message;
  ASSERT_EQ(d->paths.size(), 3U);
  EXPECT_EQ(d->paths[1].label.name, "a#2");
  EXPECT_EQ(d->paths[0].path.curves.size(), 3U);  // line, cubic, closing line
  EXPECT_EQ(piece(*d, 0, 1).control.size(), 4U);
  EXPECT_FALSE(d->paths[1].path.closed);
  EXPECT_EQ(piece(*d, 1, 0).control.back(), (Point2{2, 2}));  // implied
  EXPECT_EQ(d->paths[2].path.curves.size(), 4U);
  EXPECT_THAT(d->skipped, testing::ElementsAre(HasSubstr("anchor"), HasSubstr("acute")));
}

// What a contour holds beside what the format means: read as it can be, and told.
TEST(Glif, OddContoursAreTold) {
  const auto told = [](const std::string& points) {
    const auto d =
        read_glif("<glyph name='a'><outline><contour>" + points + "</contour></outline></glyph>");
    return d ? d->skipped : std::vector<std::string>{d.error().message};
  };
  const std::string start = "<point x='0' y='0' type='line'/><point x='9' y='0' type='line'/>";
  const std::string handle = "<point x='9' y='5'/>";
  const std::string up = "<point x='9' y='9' type='";
  EXPECT_TRUE(told(start + handle + handle + up + "curve'/>").empty());
  EXPECT_TRUE(told(start + "<point x='9' y='5' type='offcurve'/>" + up + "qcurve'/>").empty());
  EXPECT_EQ(told(start + handle + up + "line'/>"),
            std::vector<std::string>{"1 handle that no curve of a contour uses"});
  EXPECT_EQ(
      told(start + handle + up + "curve'/>"),
      std::vector<std::string>{"1 curve of one or more than two handles, taken for quadratics"});
  EXPECT_EQ(told(start + handle + "<point x='8' y='8' type='corve'/>" + up + "curve'/>"),
            std::vector<std::string>{"1 point of an unknown type, taken for a handle"});
  EXPECT_EQ(told(start + up + "move'/>"),
            std::vector<std::string>{
                "1 point of type move within a contour, taken for the end of a line"});
  EXPECT_EQ(told("<point x='0' y='0' type='move'/>" + up + "line'/>" + handle + handle),
            std::vector<std::string>{"2 handles that no curve of a contour uses"});
  const auto image = read_glif("<glyph><image fileName='a.png'/><outline><contour>" + start + up +
                               "line'/></contour></outline></glyph>");
  EXPECT_EQ(image.value().skipped, std::vector<std::string>{"an image"});
}

// The glyph that is read is the first outline of the first element, as UFO 3 has it.
TEST(Glif, WhatIsBesideTheOutlineIsTold) {
  const std::string contour =
      "<contour><point x='0' y='0' type='line'/><point x='9' y='0' type='line'/>"
      "<point x='9' y='9' type='line'/></contour>";
  const std::string outline = "<outline>" + contour + "</outline>\n";
  const auto told = [](const std::string& text) { return read_glif(text).value().skipped; };
  using Lines = std::vector<std::string>;
  for (const char* format : {"", " format='1'", " format='2'"})
    EXPECT_EQ(told("<glyph" + std::string(format) + ">\n" + outline + "</glyph>"), Lines{});
  EXPECT_EQ(told("<glyph format='3'>\n" + outline + "</glyph>"),
            Lines{"line 1: what is new in format 3 of glyphs, read as format 2"});
  EXPECT_EQ(told("<glyph>\n" + outline + outline + "</glyph>"), Lines{"line 3: a second outline"});
  EXPECT_EQ(told("<glyph>\n" + outline + "</glyph>\n<glyph>" + outline + "</glyph>"),
            Lines{"line 4: what stands behind the end of <glyph>"});
}

TEST(Glif, BadGlyphsAreFailuresWithTheLine) {
  EXPECT_THAT(read_glif("<glyph>\n<outline>").error().path, HasSubstr("line "));
  EXPECT_EQ(read_glif("<glyph><outline><contour>\n<point x='1'/></contour></outline></glyph>")
                .error()
                .path,
            "line 2");
  EXPECT_FALSE(read_glif("<font/>"));
}

/// A closed outline of log-aesthetic pieces: an egg of four quarter arcs of two radii.
Document egg() {
  lac::Chain chain{{{0, 0}, 0.4}, {}, true};
  for (const double r : {200.0, 80.0, 200.0, 80.0})
    chain.pieces.push_back({-1, r * core::kPi / 2, 1 / r, 1 / r});
  Document d;
  d.paths.push_back({{"O", "", ""}, {{{chain}}, true}, 0});
  return d;
}

TEST(Glif, NodesStandAtExtremaAndTheOutlineIsKept) {
  const Document d = egg();
  const auto written = write_glif(d, {.tolerance = 0.2});
  ASSERT_TRUE(written) << written.error().message;
  EXPECT_LE(written->deviation, 0.2);
  EXPECT_THAT(written->content, HasSubstr("<unicode hex=\"004F\"/>"));
  const auto read = read_glif(written->content);
  ASSERT_TRUE(read) << read.error().message;
  const auto& path = read->paths.at(0).path;
  EXPECT_TRUE(path.closed);
  double high = -HUGE_VAL;
  const auto& exact = std::get<lac::Chain>(d.paths[0].path.curves[0].value);
  for (int i = 0; i <= 2000; ++i) high = std::max(high, evaluate(exact, i / 2000.0).y);
  bool node = false;
  for (std::size_t i = 0; i < path.curves.size(); ++i) {
    const Bezier2& c = piece(*read, 0, i);
    const bool top = std::abs(c.control.back().y - high) < 1e-4;
    node = node || top;
    if (top) {
      EXPECT_EQ(c.control[2].y, c.control[3].y);
    }
    for (int k = 0; k <= 20; ++k)
      EXPECT_LE(curve::closest_point(exact, evaluate(c, k / 20.0)).distance,
                written->deviation + 1e-9);
  }
  EXPECT_TRUE(node);
}

// The quadratic of 0, 3/2 and 1 along a line is 3t - 2t^2 of it: it turns back at 9/8. The
// curvature of others that run along a line changes its sign by rounding alone.
TEST(Glif, StraightCurvesAreLinesBetweenTheirTurns) {
  const auto at = [](double s) { return Point2{7 + 100 * s, -3 + 70 * s}; };
  const curve::BSpline2 spline{2, {0, 0, 0, 1, 2, 2, 2}, {at(0), at(0.3), at(0.6), at(1)}, {}};
  Document d;
  d.paths.push_back({{"a", "", ""}, {{{Bezier2{{at(0), at(1.5), at(1)}, {}}}}, false}, 0});
  d.paths.push_back({{"a", "", ""}, {{{Bezier2{{at(0), at(0.1), at(0.7), at(1)}, {}}}}, false}, 0});
  d.paths.push_back({{"a", "", ""}, {{{spline}}, false}, 0});
  const auto written = write_glif(d, {.tolerance = 0.2});
  ASSERT_TRUE(written) << written.error().message;
  EXPECT_LT(written->deviation, 1e-12);
  const auto read = read_glif(written->content);
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->paths.size(), 3U);
  ASSERT_EQ(read->paths[0].path.curves.size(), 2U);
  EXPECT_LT(core::distance(piece(*read, 0, 0).control.back(), at(1.125)), 1e-12);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto& last = std::get<Bezier2>(read->paths[k].path.curves.back().value);
    EXPECT_EQ(last.control.size(), 2U) << k;
    EXPECT_EQ(last.control.back(), at(1)) << k;
    if (k > 0) {
      EXPECT_EQ(read->paths[k].path.curves.size(), 1U) << k;
    }
  }
}

TEST(Glif, JointsOfG2CurvesStayG2) {
  Document d;
  lac::Chain chain{{{0, 0}, 0.2}, {{-1, 300, 0.001, 0.006}, {1, 250, 0.006, 0.003}}, false};
  d.paths.push_back({{"s", "", ""}, {{{chain}}, false}, 0});
  const auto written = write_glif(d, {.tolerance = 0.5});
  ASSERT_TRUE(written);
  const auto read = read_glif(written->content);
  ASSERT_TRUE(read);
  const auto& curves = read->paths.at(0).path.curves;
  ASSERT_GE(curves.size(), 2U);
  for (std::size_t i = 1; i < curves.size(); ++i)
    EXPECT_NEAR(curvature(jet(curves[i - 1], 1)), curvature(jet(curves[i], 0)), 1e-9);
}

TEST(Glif, TheGridIsKeptAndItsDeviationMeasured) {
  const auto written = write_glif(egg(), {.tolerance = 0.5, .grid = true});
  ASSERT_TRUE(written);
  EXPECT_GT(written->deviation, 0.05);
  EXPECT_LT(written->deviation, 2);
  const auto read = read_glif(written->content);
  ASSERT_TRUE(read);
  for (std::size_t i = 0; i < read->paths[0].path.curves.size(); ++i)
    for (const Point2 p : piece(*read, 0, i).control) {
      EXPECT_EQ(p.x, std::round(p.x));
      EXPECT_EQ(p.y, std::round(p.y));
    }
}

// The space has none; two of the same font are a collection (ISO 14496-22, 4.6.3).
TEST(Font, TellsWhatIsNotRead) {
  std::ifstream in(KEYLINE_SOURCE_DIR "/fuzz/seeds/font_reader_fuzz/plain.ttf", std::ios::binary);
  std::string font{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  const auto alone = read_font(font, "S");
  ASSERT_TRUE(alone) << alone.error().message;
  EXPECT_TRUE(alone->skipped.empty());
  EXPECT_THAT(read_font(font, "S ").value().skipped,
              testing::ElementsAre("the glyph \" \": it has no outline"));
  constexpr unsigned char kHead = 20;
  for (int table = 0; table < font[5]; ++table) {  // their offsets count from the file's start
    unsigned carry = kHead;
    for (std::size_t at = 12 + 16 * static_cast<std::size_t>(table) + 11; carry > 0; --at) {
      carry += static_cast<unsigned char>(font[at]);
      font[at] = static_cast<char>(carry & 255);
      carry >>= 8;
    }
  }
  const std::string head{'t', 't', 'c', 'f', 0, 1,     0, 0, 0, 0,
                         0,   2,   0,   0,   0, kHead, 0, 0, 0, kHead};
  const auto collection = read_font(head + font, "S");
  ASSERT_TRUE(collection) << collection.error().message;
  EXPECT_THAT(collection->skipped, testing::ElementsAre("1 further font of the collection"));
  EXPECT_EQ(collection->paths.size(), alone->paths.size());
}

/// A font with two more tables in its directory.
std::string with_tables(const std::string& font, const std::string& one, const std::string& other) {
  const auto number = [](std::size_t value, int bytes) {
    std::string text;
    for (int i = bytes - 1; i >= 0; --i) text += static_cast<char>(value >> (8 * i) & 255);
    return text;
  };
  const auto at = [](const std::string& text, std::size_t from) {
    std::size_t value = 0;
    for (std::size_t i = from; i < from + 4; ++i)
      value = value << 8 | static_cast<unsigned char>(text[i]);
    return value;
  };
  const std::size_t count = static_cast<unsigned char>(font[5]);
  const std::size_t head = 12 + 16 * count;
  std::string made = font.substr(0, 4) + number(count + 2, 2) + font.substr(6, 6);
  for (std::size_t i = 0; i < count; ++i) {
    const std::string entry = font.substr(12 + 16 * i, 16);
    made += entry.substr(0, 8) + number(at(entry, 8) + 32, 4) + entry.substr(12);
  }
  const std::size_t end = font.size() + 32;
  made += one.substr(0, 4) + number(0, 4) + number(end, 4) + number(one.size() - 4, 4);
  made += other.substr(0, 4) + number(0, 4) + number(end + one.size() - 4, 4) +
          number(other.size() - 4, 4);
  return made + font.substr(head) + one.substr(4) + other.substr(4);
}

// A font whose weight varies (OpenType, tables fvar and gvar) is read as it is by default.
TEST(Font, VariationsAreTold) {
  std::ifstream in(KEYLINE_SOURCE_DIR "/fuzz/seeds/font_reader_fuzz/plain.ttf", std::ios::binary);
  const std::string font{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  using namespace std::string_literals;
  const std::string axis = "wght\0\x64\0\0\x01\x90\0\0\x03\x84\0\0\0\0\x01\0"s;
  const std::string fvar = "fvar\0\x01\0\0\0\x10\0\x02\0\x01\0\x14\0\0\0\x08"s + axis;
  const auto read = read_font(with_tables(font, fvar, "gvar" + std::string(20, '\0')), "S");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_THAT(read->skipped, testing::ElementsAre(HasSubstr("varies")));
}

// Table "post" of format 3, as in most fonts of the web: characters and code points are still read.
TEST(Font, MayNotNameItsGlyphs) {
  std::ifstream in(KEYLINE_SOURCE_DIR "/fuzz/seeds/font_reader_fuzz/composite.ttf",
                   std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  const std::size_t entry = bytes.find("post");
  ASSERT_NE(entry, std::string::npos);
  std::size_t table = 0;
  for (std::size_t i = 8; i < 12; ++i)
    table = table << 8 | static_cast<unsigned char>(bytes[entry + i]);
  ASSERT_TRUE(read_font(bytes, "/a"));
  bytes[table + 1] = 3;
  const auto named = read_font(bytes, "/a");
  ASSERT_FALSE(named);
  EXPECT_EQ(named.error().message, "the font does not name its glyphs");
  EXPECT_TRUE(read_font(bytes, "a"));
  EXPECT_TRUE(read_font(bytes, "U+0061"));
}

// A contour of handles alone, (0,0) (100,0) (100,100) (0,100) by the matrix of fuzz/make_fonts.py:
// (50,600) (100,625) (75,675) (25,650). TrueType's points between stand halfway, at halves of a
// unit.
TEST(Font, ImpliedPointsAreNotRounded) {
  const auto d = read_document(KEYLINE_SOURCE_DIR "/fuzz/seeds/font_reader_fuzz/composite.ttf",
                               {.glyphs = "a"});
  ASSERT_TRUE(d) << d.error().message;
  ASSERT_EQ(d->paths.size(), 2U);
  const auto& curves = d->paths[1].path.curves;
  ASSERT_EQ(curves.size(), 4U);
  std::vector<Point2> ends;
  for (const auto& c : curves) ends.push_back(evaluate(c, 1));
  EXPECT_THAT(ends, testing::UnorderedElementsAre(Point2{50, 612.5}, Point2{62.5, 650},
                                                  Point2{25, 662.5}, Point2{12.5, 625}));
  for (std::size_t i = 1; i < 4; ++i)  // no kink where a handle stands on both sides
    EXPECT_NEAR(core::angle_between(jet(curves[i - 1], 1).first, jet(curves[i], 0).first), 0,
                1e-14);
}

TEST(Font, ReadsTheSharedFonts) {
  const fs::path folder = KEYLINE_SHARED_DATA "/4_cad/font";
  KEYLINE_NEEDS_SHARED_DATA(fs::exists(folder), folder);
  // Contours and points by FreeType's ftdump and fontTools: EB Garamond Italic S has one contour.
  const auto s = read_document(folder / "EBGaramond12-Italic.otf", {.glyphs = "S"});
  ASSERT_TRUE(s) << s.error().message;
  EXPECT_EQ(s->paths.size(), 1U);
  EXPECT_TRUE(s->paths[0].path.closed);
  for (const auto& c : s->paths[0].path.curves)
    EXPECT_NE(std::get<Bezier2>(c.value).control.size(), 3U);
  const auto o = read_document(folder / "Comfortaa-Regular.ttf", {.glyphs = "o8"});
  ASSERT_TRUE(o) << o.error().message;
  EXPECT_EQ(o->paths.size(), 2U + 3U);
  EXPECT_EQ(o->paths[1].label, (document::Label{"o#2", "o", ""}));
  for (const auto& named : o->paths) {
    const auto& curves = named.path.curves;
    for (std::size_t i = 1; i < curves.size(); ++i)
      EXPECT_EQ(evaluate(curves[i - 1], 1), evaluate(curves[i], 0));
    EXPECT_EQ(evaluate(curves.back(), 1), evaluate(curves.front(), 0));
  }
  EXPECT_TRUE(read_document(folder / "Comfortaa-Regular.ttf", {.glyphs = "U+0053"}));
  EXPECT_TRUE(read_document(folder / "EBGaramond12-Italic.otf", {.glyphs = "/ampersand"}));
  const auto none_known = read_document(folder / "EBGaramond12-Italic.otf", {.glyphs = "/.notdef"});
  ASSERT_TRUE(none_known);
  EXPECT_EQ(none_known->paths.size(), 2U);
  for (const char* none : {"\u4e2d", "/no-such-glyph", "U+xyz", ""}) {
    const auto missing = read_document(folder / "Comfortaa-Regular.ttf", {.glyphs = none});
    ASSERT_FALSE(missing) << none;
    EXPECT_EQ(missing.error().code, core::ErrorCode::bad_input);
  }
  EXPECT_FALSE(read_font("no font", "S"));
}

}  // namespace
}  // namespace keyline::exchange
