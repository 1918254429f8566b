#include "keyline/exchange/svg/svg_reader.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "keyline/exchange/svg/cubic_path.h"
#include "keyline/exchange/svg/svg_style.h"

/// Where SVG 2 says that things stand, and what of a file is told.
namespace keyline::exchange {
namespace {

using core::Point2;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

SvgContents contents(const std::string& body, const std::string& root = "",
                     const SvgReadLimits& limits = {}) {
  auto read =
      read_svg("<svg xmlns='http://www.w3.org/2000/svg' " + root + ">" + body + "</svg>", limits);
  EXPECT_TRUE(read) << body;
  return read ? *read : SvgContents{};
}

std::vector<std::string> told(const SvgContents& c) {
  std::vector<std::string> all;
  for (const SvgSkipped& s : c.skipped) all.push_back(std::to_string(s.line) + ": " + s.what);
  return all;
}

Point2 end_of(const std::string& body) {
  const SvgContents c = contents(body, "viewBox='0 0 200 100'");
  EXPECT_EQ(c.curves.size(), 1U) << body;
  return c.curves.empty() ? Point2{} : c.curves.back().pieces.back().control.back();
}

const std::string kLine = "<path d='M0 0h1'/>";

// SVG 2, 8.2 and 5.7: shares are of the nearest viewport, in its own units.
TEST(SvgFrames, SharesAreOfTheNearestViewport) {
  const std::string half = "<line x2='50%' y2='50%'/></svg>";
  EXPECT_EQ(end_of("<svg width='40' height='20'>" + half), (Point2{20, -10}));
  EXPECT_EQ(end_of("<svg width='40' height='20' viewBox='0 0 10 5'>" + half), (Point2{20, -10}));
  EXPECT_EQ(end_of("<svg width='50%' height='50%'>" + half), (Point2{50, -25}));
}

// SVG 2, 5.5 and 5.6: a symbol is as large as its <use> says, else as itself; it may be turned and
// painted like a group.
TEST(SvgFrames, SymbolsAreSizedByTheirUse) {
  const auto shown = [](const std::string& symbol, const std::string& use) {
    return "<symbol id='s' " + symbol + " viewBox='0 0 10 10'><path d='M0 0L10 10'/></symbol>" +
           "<use href='#s' " + use + "/>";
  };
  EXPECT_EQ(end_of(shown("width='30' height='30'", "")), (Point2{30, -30}));
  EXPECT_EQ(end_of(shown("width='30' height='30'", "width='20' height='20'")), (Point2{20, -20}));
  EXPECT_EQ(end_of(shown("transform='scale(2)' width='30' height='30'", "")), (Point2{60, -60}));
  const SvgContents red = contents(shown("stroke='red'", ""));
  EXPECT_EQ(red.curves.at(0).color, "#ff0000");
}

// SVG 2, 4.2: what is no length is as if it were not there; here it is told, too.
TEST(SvgFrames, PlacesThatAreNoLengthsAreZeroAndTold) {
  for (const char* body :
       {"<svg x='abc'><path d='M0 0h1'/></svg>", "<path id='p' d='M0 0h1' visibility='visible'/>",
        "<svg viewBox='0 0 x 1'><path d='M0 0h1'/></svg>"}) {
    const SvgContents c = contents(body);
    ASSERT_EQ(c.curves.size(), 1U) << body;
    EXPECT_EQ(c.curves[0].pieces[0].control[1], (Point2{1, 0})) << body;
    EXPECT_EQ(c.skipped.size(), std::string(body).find("id=") == std::string::npos ? 1U : 0U);
  }
  const SvgContents used = contents("<path id='p' d='M0 0h1'/><use href='#p' x='abc'/>");
  ASSERT_EQ(used.curves.size(), 2U);
  EXPECT_EQ(used.curves[1].pieces[0].control[1], (Point2{1, 0}));
  EXPECT_THAT(told(used), ElementsAre(HasSubstr("its x is no length")));
  EXPECT_THAT(told(contents(kLine, "width='auto' height='50%'")), IsEmpty());
  EXPECT_THAT(told(contents("<rect width='3' height='2' rx='auto'/>")), IsEmpty());
  EXPECT_EQ(contents(kLine, "stroke='red'").curves.at(0).color, "#ff0000");
  EXPECT_EQ(contents("<a href='x'>" + kLine + "</a>").curves.size(), 1U);
}

// A page of no size is none: what it says of the unit does not count either, and is told.
TEST(SvgFrames, PagesOfNoSizeAreToldAndNone) {
  for (const char* root : {"width='0mm'", "width='-5mm'", "height='0mm'"}) {
    const SvgContents c = contents(kLine, root);
    EXPECT_EQ(c.unit, "px") << root;
    EXPECT_THAT(told(c), ElementsAre(HasSubstr("not positive"))) << root;
  }
  EXPECT_FALSE(contents(kLine, "viewBox='1e20 0 1 10'").page);  // its width is lost in rounding
  EXPECT_TRUE(contents(kLine, "viewBox='1e5 0 1 10'").page);
}

TEST(SvgNotes, StandInTheOrderOfTheirLines) {
  std::string body = "\n<text>a</text>\n<path d='M0 0L1 1L'/>\n<text>b</text>\n<image/>\n";
  const SvgContents c = contents(body);
  EXPECT_THAT(told(c), ElementsAre(HasSubstr("2: text: 2 elements"), HasSubstr("3: path"),
                                   HasSubstr("5: image: 1 element")));
  body.clear();
  for (int i = 0; i < 30; ++i) body += "<path d='M0 0L1 1L'/>\n";
  EXPECT_EQ(contents(body).skipped.size(), 30U);
  EXPECT_THAT(told(contents("<script>a</script><title>b</title>")), IsEmpty());
  const auto twice = contents(
      "<metadata><keyline:document xmlns:keyline='k'>1</keyline:document>"
      "<keyline:document xmlns:keyline='k'>2</keyline:document></metadata>");
  EXPECT_EQ(twice.metadata, "1");
}

// The limits are those that are stated: so many levels and bytes are read, one more is not.
TEST(SvgLimits, AreReachedButNotPassed) {
  const auto groups = [](int n) {
    std::string body = kLine;
    for (int i = 0; i < n; ++i) body = "<g>" + body + "</g>";
    return body;
  };
  EXPECT_EQ(contents(groups(2), "", {.depth = 2}).curves.size(), 1U);
  EXPECT_EQ(contents(groups(3), "", {.depth = 2}).curves.size(), 0U);
  const std::string uses =
      "<path id='a' d='M0 0h1'/><g id='b'><use href='#a'/></g><use href='#b'/>";
  EXPECT_EQ(contents(uses, "", {.use_depth = 2}).curves.size(), 3U);
  EXPECT_EQ(contents(uses, "", {.use_depth = 1}).curves.size(), 2U);
  std::string many;  // 1,000 elements in 8,500 bytes, of which one in four may be one
  for (int i = 0; i < 500; ++i) many += "<g id=''></g><g/>";
  EXPECT_THAT(told(contents(many, "", {.elements = 0})), IsEmpty());
  std::string all = "<g id='a'>" + many + "</g>";
  for (int i = 0; i < 4; ++i) all += "<use href='#a'/>";
  EXPECT_THAT(told(contents(all, "", {.elements = 0})), Contains(HasSubstr("too many elements")));
  EXPECT_TRUE(read_svg("<svg/>", {.bytes = 6}));
  EXPECT_FALSE(read_svg("<svg/>", {.bytes = 5}));
}

/// Paint of an element within one drawn in black.
detail::SvgPaint painted(const std::string& sheet, const std::string& attributes,
                         const detail::SvgPaint& around = {"#000000", "#ffffff", 3}) {
  detail::SvgStyles styles;
  styles.add_sheet(sheet);
  pugi::xml_document xml;
  EXPECT_TRUE(xml.load_string(("<path " + attributes + "/>").c_str()));
  return styles.paint(xml.child("path"), around);
}

// CSS Cascading 4 and Color 4.
TEST(SvgPaints, FollowTheRulesOfCss) {
  EXPECT_EQ(painted("", "color='nonsense' stroke='currentcolor'").stroke, "#000000");
  EXPECT_FALSE(painted("", "stroke='transparent'").stroked);
  EXPECT_TRUE(painted("", "stroke='url(#p)'").stroked);
  EXPECT_FALSE(painted("", "style='display:none !important'").seen());
  EXPECT_FALSE(painted("", "style='visibility:collapse'").seen());
  EXPECT_EQ(painted("/*/ .a{stroke:red} */", "class='a'").stroke, "#000000");
  EXPECT_EQ(painted("", "stroke='inherit'").unknown, "");
  // What another element gave is not told of this one.
  detail::SvgPaint odd{"#000000", "#ffffff", 3};
  odd.unknown = "lab(1 2 3)";
  odd.unknown_width = "wide";
  EXPECT_THAT(painted("", "", odd).unread(), IsEmpty());
  const auto c = contents("<path style='clip-path:url(#c)' d='M0 0h1'/>");
  EXPECT_THAT(told(c), ElementsAre(HasSubstr("is not clipped")));
}

// The bound is the largest of all parts, within the tolerance; what has no curve has no end.
TEST(CubicPaths, DeviateByTheirWorstPart) {
  const curve::Bezier2 line{{{2, 0}, {3, 0}}, {}}, conic{{{0, 0}, {1, 1}, {2, 0}}, {1, 3, 1}};
  for (const double tolerance : {1e-2, 1e-3, 1e-4, 1e-5}) {
    const double alone = cubic_path({{{conic}}, false}, "", tolerance).deviation;
    EXPECT_GT(alone, 0);
    EXPECT_LE(alone, tolerance);
    EXPECT_EQ(cubic_path({{{conic}, {line}}, false}, "", tolerance).deviation, alone);
    EXPECT_EQ(cubic_path({{{conic}, {line}, {conic}}, false}, "", tolerance).deviation, alone);
  }
  EXPECT_THAT(cubic_path({{}, true}, "", 1e-3).path.pieces, IsEmpty());
}

}  // namespace
}  // namespace keyline::exchange
