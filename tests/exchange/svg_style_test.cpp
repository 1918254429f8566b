#include "keyline/exchange/svg/svg_style.h"

#include <chrono>
#include <string>

#include <gtest/gtest.h>

#include "keyline/exchange/svg/svg_reader.h"

namespace keyline::exchange::detail {
namespace {

TEST(CssColor, OfEveryNotation) {
  struct Case {
    const char *text, *color;
  };
  for (const Case& c : {
           Case{"#F80", "#ff8800"},
           {"#f80c", "#ff8800"},
           {"#A1b2C3", "#a1b2c3"},
           {"#a1b2c3d4", "#a1b2c3"},
           {"#", ""},
           {"#12", ""},
           {"#12345", ""},
           {"#1234567", ""},
           {"#123456789", ""},
           {"#12g", ""},
           {"rgb(0,128,255)", "#0080ff"},
           {"rgb( 1 2 , 3 )", "#010203"},
           {"rgba(300, -4, 10, 0.5)", "#ff000a"},
           {"rgb(0%, 50%, 100%)", "#0080ff"},
           {"rgb(1,2)", ""},
           {"rgb(a,b,c)", ""},
           {"rgb(254.6,0.4,9.5)", "#ff000a"},
           {"red", "#ff0000"},
           {"NAVY", "#000080"},
           {"Grey", "#808080"},
           {"hsl(210, 65%, 20%)", "#123354"},  // colorsys.hls_to_rgb
           {"hsla(-30 40% 75% / 0.5)", "#d9a6bf"},
           {"HSL(0.25turn,100%,50%)", "#80ff00"},
           {"hsl(100grad 30% 60%)", "#99b87a"},
           {"hsl(2rad 80% 45%)", "#27cf17"},
           {"hsl(-120, 100%, 50%)", "#0000ff"},
           {"hsl(20, 30%)", ""},
           {"RebeccaPurple", "#663399"},
           {"mediumaquamarine", "#66cdaa"},
           {"none", ""},
           {"url(#p)", ""},
           {"", ""},
       })
    EXPECT_EQ(css_color(c.text), c.color) << c.text;
}

TEST(SvgStyles, TellWhatCssMoves) {
  SvgStyles styles;
  styles.add_sheet(".a{transform:rotate(9deg)} .b{transform:none;stroke:red}");
  struct Case {
    const char* attributes;
    bool moves;
  };
  for (const Case& c : {Case{"style='stroke:red;transform: translate(1px,2px)'", true},
                        {"style='rotate:9deg'", true},
                        {"transform-origin='5 5' transform='rotate(9)'", true},
                        {"class='a'", true},
                        {"class='b'", false},
                        {"transform='rotate(9)' style='stroke:red'", false},
                        {"style='transform:none'", false}}) {
    pugi::xml_document xml;
    ASSERT_TRUE(xml.load_string((std::string("<path ") + c.attributes + "/>").c_str()));
    EXPECT_EQ(styles.moves(xml.first_child()), c.moves) << c.attributes;
  }
}

/// Paint of <path attributes/> under a sheet, within one drawn in black, 3 wide.
SvgPaint painted(std::string_view sheet, const std::string& attributes) {
  SvgStyles styles;
  styles.add_sheet(sheet);
  pugi::xml_document xml;
  EXPECT_TRUE(xml.load_string(("<path " + attributes + "/>").c_str()));
  return styles.paint(xml.child("path"), {"#000000", "#ffffff", 3});
}

struct PaintCase {
  const char *sheet, *attributes, *stroke, *fill;
  double width;
};
constexpr PaintCase kPaints[] = {
    {"", "", "#000000", "#ffffff", 3},
    {"", "stroke='red'", "#ff0000", "#ffffff", 3},
    {"", "fill='red'", "#000000", "#ff0000", 3},
    {"", "stroke-width='5'", "#000000", "#ffffff", 5},
    {"", "stroke-width='0'", "#000000", "#ffffff", 0},
    {"", "stroke-width='-1'", "#000000", "#ffffff", 3},
    {"", "stroke-width='wide'", "#000000", "#ffffff", 3},
    {"", "stroke-width='1in'", "#000000", "#ffffff", 96},
    {"", "stroke='inherit' fill='' stroke-width='inherit'", "#000000", "#ffffff", 3},
    {"", "stroke='none' fill='none'", "", "", 3},
    {"", "style='stroke:red;fill:lime;stroke-width:7'", "#ff0000", "#00ff00", 7},
    {"", "style=' stroke : red ; ; fill:lime ; nonsense; '", "#ff0000", "#00ff00", 3},
    {"", "color='red' stroke='currentColor'", "#ff0000", "#ffffff", 3},
    {"", "stroke='url(#p) blue' fill='url(#p)'", "#0000ff", "", 3},
    // The last word: attribute, name, class, id, style.
    {"path{stroke:blue}", "stroke='red'", "#0000ff", "#ffffff", 3},
    {"path{stroke:blue} .a{stroke:lime}", "class='a'", "#00ff00", "#ffffff", 3},
    {".a{stroke:lime}path{stroke:blue}", "class='a'", "#00ff00", "#ffffff", 3},
    {"#i{stroke:navy}.a{stroke:lime}", "class='a' id='i'", "#000080", "#ffffff", 3},
    {"#i{stroke:navy}", "id='i' style='stroke:red'", "#ff0000", "#ffffff", 3},
    {".a{stroke:lime}.b{fill:red}", "class=' b  a '", "#00ff00", "#ff0000", 3},
    {".a{stroke:lime}.b{stroke:red}", "class='c b'", "#ff0000", "#ffffff", 3},
    // Of one selector the later rule; what it leaves out stays.
    {".a{stroke:lime;fill:red}.a{stroke:navy}", "class='a'", "#000080", "#ff0000", 3},
    // A rule ends at its own bracket, a comment at its own end, a list at its comma.
    {".a{stroke:lime}.b{fill:red}", "class='a'", "#00ff00", "#ffffff", 3},
    {".a{stroke:lime;stroke-width:4}.b{fill:red}", "class='a b'", "#00ff00", "#ff0000", 4},
    {"/* .a{fill:red} */.a{stroke:lime}", "class='a'", "#00ff00", "#ffffff", 3},
    {".a{/**/stroke:lime/*;*/;fill:red}", "class='a'", "#00ff00", "#ff0000", 3},
    {".a{stroke:lime}/* .a{fill:red}", "class='a'", "#00ff00", "#ffffff", 3},
    {".x , .a,#i{stroke:lime}", "class='a'", "#00ff00", "#ffffff", 3},
    {".x,.a{stroke:lime}", "class='a'", "#00ff00", "#ffffff", 3},
    // The end of the sheet closes what is open (CSS Syntax 3, 5).
    {".a{stroke:lime", "class='a'", "#00ff00", "#ffffff", 3},
    {".a{stroke:lime/*", "class='a'", "#00ff00", "#ffffff", 3},
    // A string ends at its own quote, not one behind a backslash, else with its line.
    {"text{font-family:\"O\\\"Neil\"} .a{stroke:lime}", "class='a'", "#00ff00", "#ffffff", 3},
    {"text{font-family:O\\'Neil} .a{stroke:lime}", "class='a'", "#00ff00", "#ffffff", 3},
    {".x{font-family:Arial'\n} .a{stroke:lime}", "class='a'", "#00ff00", "#ffffff", 3},
    {"<!-- .a{stroke:lime} -->", "class='a'", "#00ff00", "#ffffff", 3},
    // What is important outranks all that is not (CSS Cascading 4, 6.1); other marks are a mistake.
    {".a{stroke:lime !important}", "class='a'", "#00ff00", "#ffffff", 3},
    {".a{stroke:lime ! IMPORTANT}#p{stroke:blue}", "class='a' id='p' style='stroke:red'", "#00ff00",
     "#ffffff", 3},
    {".a{stroke:lime!important}#p{stroke:blue!important}", "class='a' id='p'", "#0000ff", "#ffffff",
     3},
    {".a{stroke:lime}.a{stroke:red !ie}", "class='a'", "#00ff00", "#ffffff", 3},
    // The more a selector says the more it counts (Selectors 4, 17); of equal ones the later, in
    // whatever order the element names its classes.
    {"path.a{stroke:lime}.a{stroke:red}", "class='a'", "#00ff00", "#ffffff", 3},
    {"path{stroke:lime}*{stroke:red;stroke-width:5}", "", "#00ff00", "#ffffff", 5},
    {".b{stroke:red}.a{stroke:lime}", "class='a b'", "#00ff00", "#ffffff", 3},
    {".b,.a{stroke:red}.b{stroke:lime}", "class='b a'", "#00ff00", "#ffffff", 3},
    {"#i,.a{stroke:lime}path.a{stroke:red}", "class='a' id='i'", "#00ff00", "#ffffff", 3},
    {"g.a{stroke:lime}", "class='a'", "#000000", "#ffffff", 3},
    // What is let pass ends where it ends: a block at its own bracket, a statement behind strings.
    {"@media print{.a{fill:red}}.a{stroke:lime}", "class='a'", "#00ff00", "#ffffff", 3},
    {"@import url(a;b{.css);@import \"c;d{'\";.a{stroke:lime}", "class='a'", "#00ff00", "#ffffff",
     3},
    {".b{fill:red;.a{fill:red}}.a{stroke:lime}", "class='a b'", "#00ff00", "#ffffff", 3},
    {"path#i{stroke:red}.a.b{stroke:red}", "class='a b' id='i'", "#000000", "#ffffff", 3},
    // Selectors of more than one word are let pass.
    {"g .a{stroke:lime} g>path{stroke:lime} path:hover{stroke:lime} path[d]{stroke:lime}",
     "class='a'", "#000000", "#ffffff", 3},
};

TEST(SvgStyles, TheLastWordIsThatOfTheCascade) {
  for (const PaintCase& c : kPaints) {
    SCOPED_TRACE(std::string(c.sheet) + " " + c.attributes);
    const SvgPaint paint = painted(c.sheet, c.attributes);
    EXPECT_EQ(paint.stroke, c.stroke);
    EXPECT_EQ(paint.fill, c.fill);
    EXPECT_DOUBLE_EQ(paint.width, c.width);
  }
}

// A paint that is no colour known is told; none is no such paint.
TEST(SvgStyles, TellPaintsThatAreNoColour) {
  EXPECT_EQ(painted("", "stroke='lab(50% 20 30)'").unknown, "lab(50% 20 30)");
  EXPECT_EQ(painted("", "fill='url(#p)'").unknown, "url(#p)");
  for (const char* known : {"stroke='none'", "stroke='url(#p) none'", "fill='transparent'", ""})
    EXPECT_EQ(painted("", known).unknown, "") << known;
}

// A width that is none leaves that of what is around it, and is told.
TEST(SvgStyles, TellWidthsThatAreNone) {
  for (const char* width : {"3,5", "abc", "-2", "2q", "2.5xx", "1e400"}) {
    const SvgPaint paint = painted("", "stroke-width='" + std::string(width) + "'");
    EXPECT_EQ(paint.unread(), std::vector<std::string>{"the stroke-width \"" + std::string(width) +
                                                       "\" is no length: let pass"});
    EXPECT_EQ(paint.width, 3);
  }
  EXPECT_TRUE(painted("", "stroke-width='1in'").unread().empty());
  EXPECT_EQ(painted("", "stroke-width='1in'").width, 96);
  const auto read = read_svg(
      "<svg xmlns='http://www.w3.org/2000/svg'><path style='stroke-width:3,5' d='M0 0L1 1'/>"
      "<path style='stroke-width:3,5' d='M0 0L1 2'/></svg>");
  ASSERT_TRUE(read);
  EXPECT_EQ(read->skipped.size(), 1U);
}

// What of a style is not followed: once for the sheets, once for a paint, at every clipped shape.
TEST(SvgStyles, AreToldWhereTheyAreLetPass) {
  const auto read = read_svg(
      "<svg xmlns='http://www.w3.org/2000/svg'><style>g > path{stroke:red} path{fill:none}</style>"
      "<g id='a' clip-path='url(#c)'><path stroke='lab(1 2 3)' d='M0 0L1 1'/>"
      "<path stroke='lab(1 2 3)' d='M0 0L1 2'/></g><path clip-path='none' stroke='red' d='M0 0L1 "
      "2'/></svg>");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->curves.size(), 3U);
  ASSERT_EQ(read->skipped.size(), 3U);
  std::string all;
  for (const SvgSkipped& s : read->skipped) all += s.what + "\n";
  for (const char* part : {"1 rule of its style sheets", "g \"a\": is not clipped",
                           "the paint \"lab(1 2 3)\" is no plain colour"})
    EXPECT_NE(all.find(part), std::string::npos) << part << "\n" << all;
  const auto once = read_svg(
      "<svg xmlns='http://www.w3.org/2000/svg'><path stroke='lab(1 2 3)' d='M0 0L1 1'/></svg>");
  ASSERT_TRUE(once);
  EXPECT_EQ(once->skipped.size(), 1U);
}

TEST(SvgStyles, CountWhatTheyLetPass) {
  SvgStyles styles;
  styles.add_sheet(
      "@media print{.b{stroke:red}.c{fill:red}} @import 'a;b.css'; g .a{stroke:red}"
      ".a.b,.c,path#i{fill:red} .x{fill:red;.z{fill:red}} *,path.a,#i{fill:none}");
  EXPECT_EQ(styles.passed(), 6U);
}

// Whatever an open quote or bracket swallows is told; a rule that styles nothing is not let pass.
TEST(SvgStyles, CountWhatIsLostInAnOpenOne) {
  const auto passed = [](std::string_view sheet) {
    SvgStyles styles;
    styles.add_sheet(sheet);
    return styles.passed();
  };
  EXPECT_EQ(passed(".x{font-family:Arial'}\n.a{stroke:red}"), 1U);
  EXPECT_EQ(passed(".x{background:url(foo} .a{stroke:red}"), 1U);
  EXPECT_EQ(passed("path .a"), 1U);
  EXPECT_EQ(passed("@charset \"utf-8\"; @namespace url(http://www.w3.org/2000/svg);"
                   "@font-face{font-family:x} <!-- .a{stroke:red} -->"),
            0U);
}

// One rule may name an element thousands of times: its declarations are read once all the same.
TEST(SvgStyles, ASelectorRepeatedCostsOnce) {
  std::string selectors = "path";
  for (int i = 0; i < 9'000; ++i) selectors += i % 2 == 0 ? ",path" : ",.a" + std::to_string(i);
  std::string names;
  for (int i = 1; i < 9'000; i += 2) names += " a" + std::to_string(i);
  std::string body;
  for (int i = 0; i < 20'000; ++i) body += "stroke:red;";
  const auto begin = std::chrono::steady_clock::now();
  const SvgPaint paint = painted(selectors + "{" + body + "}", "class='" + names + "'");
  EXPECT_EQ(paint.stroke, "#ff0000");
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(2));  // else a minute
}

// As Illustrator and CorelDRAW write it: the sheet is its text and its CDATA together.
TEST(SvgStyles, SheetsStandInCdata) {
  const auto read = read_svg(
      "<svg xmlns='http://www.w3.org/2000/svg'><style type='text/css'>/* <![CDATA[ */ "
      ".st0{stroke:red} /* ]]> */</style><path class='st0' d='M0 0L1 1'/></svg>");
  ASSERT_TRUE(read && read->curves.size() == 1);
  EXPECT_EQ(read->curves[0].color, "#ff0000");
}

TEST(SvgPaint, AnOutlineHasTheColourOfItsStrokeElseOfItsFill) {
  EXPECT_EQ((SvgPaint{"#000001", "#000002", 1}).color(), "#000001");
  EXPECT_EQ((SvgPaint{"", "#000002", 1}).color(), "#000002");
}

}  // namespace
}  // namespace keyline::exchange::detail
