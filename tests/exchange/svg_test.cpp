#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <pugixml.hpp>
#include <sstream>

#include <gtest/gtest.h>

#include "keyline/exchange/svg/svg_reader.h"
#include "keyline/exchange/svg/svg_writer.h"

#include "tests/shared_data.h"

namespace keyline::exchange {
namespace {

using core::Point2;
using curve::Bezier2;

std::string wrap(const std::string& body, const std::string& attributes = "") {
  return "<svg xmlns='http://www.w3.org/2000/svg' xmlns:xlink='http://www.w3.org/1999/xlink' " +
         attributes + ">" + body + "</svg>";
}

SvgContents contents(const std::string& svg) {
  auto result = read_svg(svg);
  EXPECT_TRUE(result) << (result ? "" : result.error().message);
  return result ? *result : SvgContents{};
}

std::vector<SvgLayer> sample_layers() {
  SvgPath spline{"key <line> \"1\"",
                 {{{{0.1, 0.2}, {1.0 / 3, 2}, {5, 1e-7}, {7, -3.3}}, {}},
                  {{{7, -3.3}, {8, -5}, {9.25, 1e3}}, {}},
                  {{{9.25, 1e3}, {0.1, 0.2}}, {}}},
                 true};
  SvgPath apart{"apart", {{{{0, 0}, {1, 1}}, {}}, {{{2, 2}, {3, 3}}, {}}}, false};
  return {{"Faired & co", {spline}}, {"Given", {apart}, "#808080", 0.5}};
}

TEST(SvgWriter, ComesBackExactly) {
  const std::string json = "{\"type\":\"log-aesthetic\",\"x\":\"<&>\\u0001\r\n\t é\"}";
  const auto svg = write_svg(sample_layers(), {.title = "T", .metadata = json});
  ASSERT_TRUE(svg);
  const SvgContents back = contents(*svg);
  EXPECT_EQ(back.unit, "mm");
  EXPECT_EQ(back.metadata, json);
  EXPECT_TRUE(back.skipped.empty());
  ASSERT_EQ(back.curves.size(), 3U);
  EXPECT_EQ(back.curves[0].name, "key <line> \"1\"");
  EXPECT_EQ(back.curves[0].layer, "Faired & co");
  EXPECT_EQ(back.curves[0].pieces, sample_layers()[0].paths[0].pieces);
  EXPECT_TRUE(back.curves[0].closed);
  EXPECT_EQ(back.curves[2].name, "apart#2");
  EXPECT_EQ(back.curves[2].pieces[0].control, (std::vector<Point2>{{2, 2}, {3, 3}}));
}

TEST(SvgWriter, HasTightPageAndRealSize) {
  SvgPath arch{"arch", {{{{0, 0}, {0, 40}, {100, 40}, {100, 0}}, {}}}, false};
  const auto svg = write_svg({{"L", {arch}}}, {.unit = "m", .margin = 0});
  ASSERT_TRUE(svg);
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(svg->c_str()));
  const auto root = document.child("svg");
  EXPECT_STREQ(root.attribute("width").value(), "100000mm");
  EXPECT_STREQ(root.attribute("height").value(), "30000mm");
  EXPECT_STREQ(root.attribute("viewBox").value(), "0 -30 100 30");
  EXPECT_STREQ(root.child("g").attribute("inkscape:label").value(), "L");
  EXPECT_STREQ(root.child("g").child("path").attribute("d").value(), "M0 0C0 -40 100 -40 100 0");
  EXPECT_EQ(*svg, write_svg({{"L", {arch}}}, {.unit = "m", .margin = 0}).value());
  const auto wide = write_svg({{"L", {arch}}}, {.unit = "m", .margin = 0.1});
  EXPECT_NE(wide->find("height=\"50000mm\" viewBox=\"-10 -40 120 50\""), std::string::npos);
}

TEST(SvgWriter, LinesAreAsWideAsTheLayerTimesTheDrawings) {
  const SvgPath line{"l", {{{{0, 0}, {800, 3}}, {}}}, false};
  const auto width_of = [&](double layer, const SvgWriteOptions& options) {
    const auto svg = write_svg({{"L", {line}, "#808080", layer}}, options);
    pugi::xml_document document;
    EXPECT_TRUE(svg && document.load_string(svg->c_str()));
    return document.child("svg").child("g").attribute("stroke-width").as_double();
  };
  EXPECT_DOUBLE_EQ(width_of(3, {.stroke_width = 0.5}), 1.5);
  EXPECT_DOUBLE_EQ(width_of(0.25, {}), 0.25 * 800 / 400);
}

TEST(SvgWriter, RefusesWhatSvgCannotHold) {
  const auto code = [](const SvgPath& path, const SvgWriteOptions& options = {}) {
    return write_svg({{"L", {path}}}, options).error().code;
  };
  const SvgPath line{"", {{{{0, 0}, {1, 1}}, {}}}, false};
  EXPECT_EQ(code({"", {{{{0, 0}, {1, 1}, {2, 0}}, {1, 2, 1}}}}), core::ErrorCode::unsupported);
  EXPECT_EQ(code({"", {{std::vector<Point2>(5), {}}}}), core::ErrorCode::unsupported);
  EXPECT_EQ(code({"", {{{{0, NAN}, {1, 1}}, {}}}}), core::ErrorCode::bad_input);
  EXPECT_EQ(code(line, {.unit = "furlong"}), core::ErrorCode::bad_input);
  EXPECT_EQ(code(line, {.margin = -1}), core::ErrorCode::bad_input);
  EXPECT_EQ(code(line, {.metadata = std::string(1, '\x01')}), core::ErrorCode::bad_input);
  EXPECT_EQ(code(line, {.metadata = "\xFF"}), core::ErrorCode::bad_input);
  EXPECT_EQ(write_svg({{"L", {line}, "red\"/>"}}).error().code, core::ErrorCode::bad_input);
  EXPECT_TRUE(write_svg({}));
  const auto hostile = write_svg({{"\xFF\x01</g>", {line}}});
  ASSERT_TRUE(hostile);
  EXPECT_EQ(contents(*hostile).curves[0].layer, "?\?</g>");
}

TEST(SvgReader, AppliesTransformsInOrder) {
  const SvgContents c =
      contents(wrap("<g transform='translate(10,20) scale(2)'><g id='inner' transform='rotate(90)'>"
                    "<path id='p' d='M1 0L2 0'/></g></g>"));
  ASSERT_EQ(c.curves.size(), 1U);
  EXPECT_EQ(c.unit, "px");
  EXPECT_EQ(c.curves[0].layer, "inner");
  EXPECT_NEAR(c.curves[0].pieces[0].control[0].x, 10, 1e-12);
  EXPECT_NEAR(c.curves[0].pieces[0].control[0].y, -22, 1e-12);
  EXPECT_NEAR(c.curves[0].pieces[0].control[1].y, -24, 1e-12);
}

TEST(SvgReader, ScalesToMillimetresByViewBox) {
  const auto end = [](const std::string& attributes) {
    const SvgContents c = contents(wrap("<line x2='10' y2='-10'/>", attributes));
    return std::pair(c.unit, c.curves.at(0).pieces[0].control[1]);
  };
  EXPECT_EQ(end("width='200mm' height='100mm' viewBox='5 5 400 200'"),
            (std::pair<std::string, Point2>("mm", {5, 5})));
  EXPECT_EQ(end("width='2in'"),
            (std::pair<std::string, Point2>("mm", {10 * 25.4 / 96, 10 * 25.4 / 96})));
  EXPECT_EQ(end("width='100%' height='300mm' viewBox='0 0 600 100'"),
            (std::pair<std::string, Point2>("mm", {30, 30})));
  EXPECT_EQ(end("width='50' height='50' viewBox='0 0 100 100'"),
            (std::pair<std::string, Point2>("px", {5, 5})));
  EXPECT_EQ(end("width='-5' height='0'"), (std::pair<std::string, Point2>("px", {10, 10})));
}

TEST(SvgReader, SaysWhatThePageShows) {
  const auto page = [](const std::string& attributes) {
    const SvgContents c = contents(wrap("<line x2='10' y2='-10'/>", attributes));
    return c.page ? std::array{c.page->low.x, c.page->low.y, c.page->high.x, c.page->high.y}
                  : std::array<double, 4>{};
  };
  using Sides = std::array<double, 4>;
  EXPECT_EQ(page(""), Sides{});
  EXPECT_EQ(page("width='200mm'"), Sides{});
  EXPECT_EQ(page("width='0' height='30'"), Sides{});
  EXPECT_EQ(page("width='40' height='0'"), Sides{});
  EXPECT_EQ(page("width='40' height='30'"), (Sides{0, -30, 40, 0}));
  EXPECT_EQ(page("viewBox='1e308 0 1e308 10'"), Sides{});  // no numbers for its right side
  EXPECT_EQ(page("viewBox='0 1e20 10 1'"), Sides{});       // its height is lost in rounding
  EXPECT_EQ(page("viewBox='5 6 40 20'"), (Sides{5, -26, 45, -6}));
  EXPECT_EQ(page("width='200mm' height='100mm' viewBox='5 6 400 200'"),
            (Sides{2.5, -103, 202.5, -3}));
  // Another aspect shows what lies beside the viewBox: here 50 px above and below, or all below.
  EXPECT_EQ(page("width='100' height='200' viewBox='0 0 100 100'"), (Sides{0, -150, 100, 50}));
  EXPECT_EQ(page("width='100' height='200' viewBox='0 0 100 100' "
                 "preserveAspectRatio='xMidYMin meet'"),
            (Sides{0, -200, 100, 0}));
  EXPECT_EQ(page("width='100' height='200' viewBox='0 0 100 100' preserveAspectRatio='none'"),
            (Sides{0, -200, 100, 0}));
}

TEST(SvgReader, ReadsShapes) {
  const SvgContents c = contents(
      wrap("<rect id='r' x='1' y='2' width='3' height='4'/><rect width='10' height='10' rx='2'/>"
           "<circle cx='5' cy='5' r='2'/><ellipse rx='3' ry='1'/><polyline points='0,0 1,0 1 1'/>"
           "<polygon points='0,0 1,0 1,1'/><line x1='1mm' x2='2mm'/><rect width='0' height='3'/>"
           "<polyline points='0 0 1 1 2'/>"));
  ASSERT_EQ(c.curves.size(), 8U);
  EXPECT_EQ(c.curves[0].pieces.size(), 4U);
  EXPECT_TRUE(c.curves[0].closed);
  EXPECT_EQ(c.curves[1].pieces.size(), 8U);
  EXPECT_EQ(c.curves[2].pieces.size(), 4U);
  EXPECT_NEAR(core::distance(evaluate(c.curves[2].pieces[1], 0.3), {5, -5}), 2, 1e-14);
  EXPECT_EQ(c.curves[4].pieces.size(), 2U);
  EXPECT_EQ(c.curves[5].pieces.size(), 3U);
  EXPECT_NEAR(c.curves[6].pieces[0].control[0].x, 96 / 25.4, 1e-12);
  EXPECT_EQ(c.curves[7].pieces.size(), 1U);
  ASSERT_EQ(c.skipped.size(), 2U);
  EXPECT_NE(c.skipped[1].what.find("pair of numbers"), std::string::npos);
}

// SVG 2, 10.2: a corner is round where neither radius is 0; one that is not given is the other's.
TEST(SvgReader, CornersAreRoundByBothRadii) {
  const SvgContents c = contents(
      wrap("<rect width='9' height='8' rx='0' ry='2'/><rect width='9' height='8' rx='2' ry='0'/>"
           "<rect width='9' height='8' ry='2'/><rect width='9' height='8' rx='20' ry='3'/>"));
  ASSERT_EQ(c.curves.size(), 4U);
  EXPECT_EQ(c.curves[0].pieces.size(), 4U);
  EXPECT_EQ(c.curves[1].pieces.size(), 4U);
  EXPECT_EQ(c.curves[2].pieces.size(), 8U);
  EXPECT_EQ(c.curves[2].pieces[0].control.front(), (Point2{2, 0}));
  EXPECT_EQ(c.curves[3].pieces[0].control.front(), (Point2{4.5, 0}));  // no more than half
}

TEST(SvgReader, FollowsUseSymbolAndNestedSvg) {
  const SvgContents c = contents(
      wrap("<defs><path id='p' d='M0 0L1 0'/><symbol id='s' viewBox='0 0 10 10'>"
           "<path d='M5 5L10 5'/></symbol></defs><use href='#p' x='3'/>"
           "<use xlink:href='#s' width='20' height='20' y='1'/>"
           "<svg x='100' width='50' height='50' viewBox='0 0 5 5'><path d='M0 0L1 0'/></svg>"));
  ASSERT_EQ(c.curves.size(), 3U);
  EXPECT_EQ(c.curves[0].pieces[0].control[0], (Point2{3, 0}));
  EXPECT_EQ(c.curves[1].pieces[0].control[0], (Point2{10, -11}));
  EXPECT_EQ(c.curves[2].pieces[0].control[1], (Point2{110, 0}));
}

TEST(SvgReader, BoundsRecursionAndExplosion) {
  const SvgContents own = contents(
      wrap("<g id='a'><use href='#b'/></g><g id='b'><use href='#a'/><path d='M0 0L1 1'/></g>"));
  EXPECT_EQ(own.curves.size(), 2U);
  EXPECT_FALSE(own.skipped.empty());
  // Each level shows the one below ten times: 10^9 lines if nobody counted.
  std::string bomb = "<path id='l0' d='M0 0L1 1'/>";
  for (int i = 1; i <= 9; ++i) {
    bomb += "<g id='l" + std::to_string(i) + "'>";
    for (int j = 0; j < 10; ++j) bomb += "<use href='#l" + std::to_string(i - 1) + "'/>";
    bomb += "</g>";
  }
  const auto counted = read_svg(wrap(bomb), {.elements = 10000});
  ASSERT_TRUE(counted);
  EXPECT_LE(counted->curves.size(), 10000U);
  EXPECT_NE(counted->skipped.back().what.find("too many"), std::string::npos);
  std::string deep;
  for (int i = 0; i < 100000; ++i) deep += "<g>";
  for (int i = 0; i < 100000; ++i) deep += "</g>";
  EXPECT_EQ(contents(wrap(deep)).curves.size(), 0U);
  EXPECT_FALSE(contents(wrap(deep)).skipped.empty());
}

TEST(SvgReader, TakesStrokesFromAttributesSheetsAndGroups) {
  const SvgContents c = contents(
      "<svg width='20mm' height='20mm' viewBox='0 0 10 10'>"
      "<style>/* x */ .a, #b {stroke:#F00; stroke-width:.5px} line{stroke:none}</style>"
      "<g stroke='rgb(0,128, 100%)' stroke-width='2'><path d='M0 0h1'/>"
      "<path class='x a' d='M0 0h1' transform='scale(3)'/><line x2='1' fill='lime'/>"
      "<path id='b' style='stroke:navy !important' d='M0 0h1'/></g><path d='M0 0h1'/></svg>");
  ASSERT_EQ(c.curves.size(), 5U);
  const auto looks = [&](std::size_t i) {
    return std::pair(c.curves[i].color, c.curves[i].stroke_width);
  };
  using Looks = std::pair<std::string, double>;
  EXPECT_EQ(looks(0), Looks("#0080ff", 4));
  EXPECT_EQ(looks(1), Looks("#ff0000", 3));
  EXPECT_EQ(looks(2), Looks("#00ff00", 0));
  EXPECT_EQ(looks(3), Looks("#000080", 1));
  EXPECT_EQ(looks(4), Looks("", 0));
}

TEST(SvgReader, NamesTheInkscapeLayerNotTheGroupsWithin) {
  const SvgContents c = contents(
      "<svg><g inkscape:groupmode='layer' inkscape:label='Side'><g id='g1'><path d='M0 0h1'/></g>"
      "<g inkscape:groupmode='layer' id='sub'><path d='M0 0h1'/></g></g>"
      "<g id='front'><g><path d='M0 0h1'/></g></g></svg>");
  ASSERT_EQ(c.curves.size(), 3U);
  EXPECT_EQ(c.curves[0].layer, "Side");
  EXPECT_EQ(c.curves[1].layer, "sub");
  EXPECT_EQ(c.curves[2].layer, "front");
}

TEST(SvgReader, FitsNestedViewBoxesAndPercentages) {
  const auto end = [](const std::string& inside) {
    const SvgContents c = contents("<svg viewBox='0 0 200 100'>" + inside + "</svg>");
    EXPECT_EQ(c.curves.size(), 1U) << inside;
    return c.curves.at(0).pieces.back().control.back();
  };
  const std::string line = "<path d='M0 0L10 10'/></svg>";
  const std::string box = "<svg x='50' y='50' width='40' height='20' viewBox='0 0 10 10' ";
  EXPECT_EQ(end(box + ">" + line), (core::Point2{80, -70}));
  EXPECT_EQ(end(box + "preserveAspectRatio='none'>" + line), (core::Point2{90, -70}));
  EXPECT_EQ(end(box + "preserveAspectRatio='xMinYMax slice'>" + line), (core::Point2{90, -70}));
  EXPECT_EQ(end(box + "preserveAspectRatio='xMaxYMid'>" + line), (core::Point2{90, -70}));
  EXPECT_EQ(end("<line x1='1' x2='50%' y2='25%'/>"), (core::Point2{100, -25}));
  EXPECT_EQ(end("<switch><g systemLanguage='de'><path d='M0 0h1'/></g><a requiredExtensions='x'/>"
                "<g><path d='M0 0h2'/></g><path d='M0 0h3'/></switch>"),
            (core::Point2{2, 0}));
}

TEST(SvgReader, ExpandsEntitiesWithinBounds) {
  const std::string shape =
      "<!DOCTYPE svg [<!ENTITY st 'stroke:red'><!ENTITY p \"<path style='&st;' d='M0 0h1'/>\">]>";
  const SvgContents c = contents(shape + "<svg>&p;&p;&amp;&unknown;</svg>");
  ASSERT_EQ(c.curves.size(), 2U);
  EXPECT_EQ(c.curves[1].color, "#ff0000");
  std::string bomb = "<!DOCTYPE svg [<!ENTITY a '0123456789'>";
  for (char e = 'b'; e < 'z'; ++e) {
    const std::string inner = std::string("&") + static_cast<char>(e - 1) + ";";
    bomb += std::string("<!ENTITY ") + e + " '" + inner + inner + inner + inner + "'>";
  }
  const SvgContents none = contents(bomb + "]><svg><text>&y;</text><path d='M0 0h1'/></svg>");
  EXPECT_EQ(none.curves.size(), 1U);
  ASSERT_FALSE(none.skipped.empty());
  EXPECT_NE(none.skipped.back().what.find("too much"), std::string::npos);
}

TEST(SvgReader, ReadsCompressedAndUtf16) {
  // gzip of "<svg><path id='é' d='M0 0h1'/></svg>"
  static constexpr unsigned char kZip[] = {
      0x1f, 0x8b, 0x08, 0x00, 0x00, 0x00, 0x00, 0x00, 0x02, 0x03, 0xb3, 0x29, 0x2e, 0x4b,
      0xb7, 0xb3, 0x29, 0x48, 0x2c, 0xc9, 0x50, 0xc8, 0x4c, 0xb1, 0x55, 0x3f, 0xbc, 0x52,
      0x5d, 0x01, 0x48, 0xf9, 0x1a, 0x28, 0x18, 0x64, 0x18, 0xaa, 0xeb, 0xdb, 0xd9, 0xe8,
      0x83, 0xe4, 0x01, 0xb9, 0xc0, 0x03, 0x2d, 0x25, 0x00, 0x00, 0x00};
  const std::string zip(reinterpret_cast<const char*>(kZip), sizeof kZip);
  ASSERT_EQ(contents(zip).curves.size(), 1U);
  EXPECT_EQ(contents(zip).curves[0].name, "\u00E9");
  const auto broken = read_svg(std::string_view(zip).substr(0, 30));
  ASSERT_FALSE(broken);
  EXPECT_NE(broken.error().message.find("broken"), std::string::npos);
  std::string wide("\xFE\xFF", 2);
  for (const char c : std::string_view("<svg><path id='x' d='M0 0h1'/></svg>")) wide += {'\0', c};
  EXPECT_EQ(contents(wide).curves.at(0).name, "x");
}

TEST(SvgReader, FailsWithReason) {
  const auto code = [](std::string_view bytes) {
    const auto result = read_svg(bytes);
    return result ? std::string("none") : core::code_name(result.error().code);
  };
  EXPECT_EQ(code(""), "bad-input");
  EXPECT_EQ(code("hello"), "bad-input");
  EXPECT_EQ(code("<svg><path d='M0 0'"), "bad-input");
  EXPECT_EQ(code("<html></html>"), "bad-input");
  EXPECT_EQ(code("\x1F\x8B\x08"), "bad-input");
  EXPECT_EQ(code("<?xml version='1.0' encoding='EBCDIC'?><svg>\xEF\xF0</svg>"), "unsupported");
  EXPECT_EQ(code(std::string_view("\xFF\xFE<\0s\0v\0g\0/\0>\0", 14)), "none");
  EXPECT_EQ(code("<?xml version='1.0' encoding='ISO-8859-1'?><svg><text>\xE9</text></svg>"),
            "none");
  EXPECT_EQ(read_svg("<svg>\n<g>\n</svg>").error().path, "line 3");
  EXPECT_EQ(read_svg("<svg/>", {.bytes = 3}).error().code, core::ErrorCode::bad_input);
}

TEST(SvgReader, ReportsWhatItLeavesOut) {
  const SvgContents c =
      contents("<!DOCTYPE svg [<!ENTITY e SYSTEM 'file:///etc/passwd'>]>\n" +
               wrap("&e;<text>a</text><text>b</text><image href='file:///etc/passwd'/>\n"
                    "<path id='bad' d='M0 0L1 1L'/><g transform='scale(0)'><path d='M0 0L1 1'/></g>"
                    "<path transform='wobble(3)' d='M0 0L1e300 1'/><g transform='scale(1e150)'>"
                    "<path d='M0 0L1e200 1'/></g>"));
  EXPECT_EQ(c.curves.size(), 2U);
  std::string all;
  for (const SvgSkipped& s : c.skipped) all += std::to_string(s.line) + ": " + s.what + "\n";
  for (const char* part :
       {"1: entities of files outside", "2: text: 2 elements", "2: image: 1 element",
        "3: path \"bad\": a number is expected", "leaves no area", "cannot be read", "too large"})
    EXPECT_NE(all.find(part), std::string::npos) << part << "\n" << all;
}

std::string file_text(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

TEST(SvgReader, ReadsDrawingsOfOthers) {
  const std::filesystem::path folder = KEYLINE_SHARED_DATA "/4_cad/svg";
  KEYLINE_NEEDS_SHARED_DATA(std::filesystem::exists(folder), folder);
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    SCOPED_TRACE(entry.path().filename().string());
    const SvgContents c = contents(file_text(entry.path()));
    EXPECT_GT(c.curves.size(), 5U);
    for (const SvgSkipped& s : c.skipped)
      EXPECT_EQ(s.what.find("expected"), std::string::npos) << s.line << ": " << s.what;
    for (const SvgCurve& curve : c.curves)
      for (std::size_t i = 1; i < curve.pieces.size(); ++i)
        EXPECT_EQ(curve.pieces[i].control.front(), curve.pieces[i - 1].control.back());
  }
}

TEST(SvgReader, StandsNastyFiles) {
  const std::filesystem::path folder = KEYLINE_SHARED_DATA "/4_cad/nasty/svg";
  KEYLINE_NEEDS_SHARED_DATA(std::filesystem::exists(folder), folder);
  // Curves expected beside the frame every file draws.
  const std::map<std::string, std::size_t> curves = {{"M-L-Z-A", 2},
                                                     {"M-M-implicit-M-implicit", 1},
                                                     {"M-T-T-rel", 1},
                                                     {"control-points-clamping-1", 6},
                                                     {"elements-via-ENTITY-reference-3", 4},
                                                     {"empty", 0},
                                                     {"indirect-recursive-2", 1},
                                                     {"invalid-data-in-L", 2},
                                                     {"missing-coordinate-in-L", 2},
                                                     {"multi-line-data", 2},
                                                     {"negative-size", 1},
                                                     {"no-commawsp-between-and-after-arc-flags", 2},
                                                     {"not-UTF-8-encoding", 0},
                                                     {"self-recursive", 0},
                                                     {"zeroed-matrix", 0}};
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().stem().string();
    SCOPED_TRACE(name);
    const auto result = read_svg(file_text(entry.path()));
    ASSERT_TRUE(result);
    ASSERT_TRUE(curves.contains(name));
    EXPECT_EQ(result->curves.size(), curves.at(name) + 1);
  }
}

}  // namespace
}  // namespace keyline::exchange
