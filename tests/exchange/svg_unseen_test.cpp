#include "keyline/exchange/svg/svg_unseen.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/exchange/svg/svg_reader.h"

namespace keyline::exchange {
namespace {

struct Seen {
  std::size_t curves = 0;
  std::vector<std::string> skipped;  ///< "line: what"
};

Seen seen(const std::string& body) {
  const auto read = read_svg(R"(<svg xmlns="http://www.w3.org/2000/svg" width="9mm" height="9mm">)"
                             "\n" +
                             body + "</svg>");
  EXPECT_TRUE(read) << body;
  Seen all;
  if (!read) return all;
  all.curves = read->curves.size();
  for (const SvgSkipped& item : read->skipped)
    all.skipped.push_back(std::to_string(item.line) + ": " + item.what);
  return all;
}

const std::string kPath = "<path d=\"M0 0h1\"/>";

std::vector<std::string> hidden(int line, const std::string& count) {
  return {std::to_string(line) + ": " + count +
          " that display, visibility or opacity hides, read like the others"};
}

// SVG 2, 11.5 and 3.2: display and opacity take all within, visibility is inherited.
TEST(SvgUnseen, HiddenShapesAreReadAndCounted) {
  for (const char* how : {"display='none'", "style='display:none'", "visibility='hidden'",
                          "visibility='collapse'", "opacity='0'", "style='opacity:0.0'",
                          "style='opacity: 0%'", "display='inline' style='display:none'"}) {
    const Seen one = seen("<g " + std::string(how) + ">\n" + kPath + kPath + "</g>" + kPath);
    EXPECT_EQ(one.curves, 3U) << how;
    EXPECT_EQ(one.skipped, hidden(3, "2 shapes")) << how;
  }
  EXPECT_EQ(seen("<style>.h{display:none}</style><path class='h' d='M0 0h1'/>").skipped,
            hidden(2, "1 shape"));
}

// What is visible again within is shown; nothing is within what is not displayed or transparent.
TEST(SvgUnseen, VisibilityIsOverridden) {
  const std::string again = "<g visibility='visible'><path d='M0 0h1'/></g></g>";
  EXPECT_TRUE(seen("<g visibility='hidden'>" + again).skipped.empty());
  EXPECT_EQ(seen("<g display='none'>" + again).skipped, hidden(2, "1 shape"));
  EXPECT_EQ(seen("<g opacity='0'>" + again).skipped, hidden(2, "1 shape"));
  EXPECT_EQ(seen("<g display='none'><g display='inline'><path d='M0 0h1'/></g></g>").skipped,
            hidden(2, "1 shape"));
  EXPECT_TRUE(seen("<g opacity='0.01' display='block' visibility='visible'>" + kPath + "</g>")
                  .skipped.empty());
  EXPECT_TRUE(seen("<g display='none' style='display:inline'>" + kPath + "</g>").skipped.empty());
  EXPECT_TRUE(seen("<g opacity='0,5'>" + kPath + "</g>").skipped.empty());  // no number: ignored
}

// SVG 2, 13: what is neither filled nor stroked leaves the page blank. A gradient paints, and so
// does a fill that nobody gives.
TEST(SvgUnseen, ShapesWithoutPaintAreReadAndCounted) {
  for (const char* how : {"fill='none'", "style='fill:none'", "fill='none' stroke='none'",
                          "fill='transparent'", "style='fill:none;stroke:none'", "fill-opacity='0'",
                          "fill='none' stroke='red' stroke-width='0'",
                          "style='fill:none;stroke:red;stroke-opacity:0%'"}) {
    const Seen one = seen("<g " + std::string(how) + ">\n" + kPath + kPath + "</g>" + kPath);
    EXPECT_EQ(one.curves, 3U) << how;
    EXPECT_EQ(one.skipped, (std::vector<std::string>{
                               "3: 2 shapes that neither stroke nor fill paints, read like the "
                               "others"}))
        << how;
  }
  for (const char* how :
       {"fill='none' stroke='red'", "stroke='none'", "fill='currentColor'",
        "fill='none' style='fill:blue'", "stroke-width='0'", "fill-opacity='0' stroke='red'",
        "fill-opacity='.5'", "fill='none' stroke='red' stroke-opacity='1'"})
    EXPECT_TRUE(seen("<g " + std::string(how) + ">" + kPath + "</g>").skipped.empty()) << how;
  EXPECT_EQ(seen("<g fill='none' display='none'>" + kPath + "</g>").skipped, hidden(2, "1 shape"));
}

// SVG 2, 5.8: a switch shows the first child whose conditions hold, and nothing of the others.
TEST(SvgUnseen, AlternativesOfASwitchAreTold) {
  const Seen all = seen("<switch>\n<g systemLanguage='de'>" + kPath + "</g>" + kPath + "\n<g>" +
                        kPath + kPath + "</g><text>a</text></switch>");
  EXPECT_EQ(all.curves, 1U);
  EXPECT_EQ(all.skipped,
            std::vector<std::string>{"3: 3 shapes of alternatives that a switch does not show"});
  EXPECT_TRUE(seen("<switch><foreignObject requiredExtensions='x'/><g>" + kPath + "</g></switch>")
                  .skipped.empty());
}

// Shapes of definitions are not read unless something brings them in: told, in one line.
TEST(SvgUnseen, DefinitionsThatNothingShowsAreTold) {
  const Seen all = seen(
      "<defs>\n<path id='a' d='M0 0h1'/><path id='b' d='M0 0h1'/>\n"
      "<clipPath><rect width='1' height='1'/></clipPath></defs>\n"
      "<symbol id='s'><g><circle r='1'/><circle r='2'/></g></symbol>\n"
      "<use href='#a'/>" +
      kPath);
  EXPECT_EQ(all.curves, 2U);
  EXPECT_EQ(all.skipped,
            std::vector<std::string>{
                "3: 4 shapes of definitions (clipPath, defs, symbol) that nothing draws"});
  EXPECT_TRUE(seen("<symbol id='s'><circle r='1'/></symbol><use href='#s'/>").skipped.empty());
  EXPECT_TRUE(seen("<defs><linearGradient id='g'/></defs>" + kPath).skipped.empty());
}

}  // namespace
}  // namespace keyline::exchange
