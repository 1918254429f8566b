#include "keyline/exchange/svg/xml_oddities.h"

#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/exchange/svg/svg_reader.h"

/// What XML forbids (XML 1.0, 3.1: no attribute twice; 2.1: one root) and the parser lets pass.
namespace keyline::exchange {
namespace {

std::vector<std::string> told(const std::string& text) {
  const auto read = read_svg(text);
  if (!read) return {read.error().path + ": " + read.error().message};
  std::vector<std::string> lines;
  for (const SvgSkipped& item : read->skipped)
    lines.push_back(std::to_string(item.line) + ": " + item.what);
  return lines;
}

const std::string kRoot = "<svg xmlns='http://www.w3.org/2000/svg' width='9mm' height='9mm'>\n";
const std::string kPath = "<path d='M0 0h1'/>\n";

TEST(XmlOddities, SoundFilesHaveNone) {
  EXPECT_EQ(told(kRoot + kPath + "</svg>\n<!-- the end -->\n"), std::vector<std::string>{});
  EXPECT_EQ(told(kRoot + "<g x='1' y='1'>" + kPath + "</g><g x='1' y='1'/></svg>"),
            std::vector<std::string>{});
}

TEST(XmlOddities, AttributesGivenTwiceAreTold) {
  EXPECT_EQ(told(kRoot + kPath + "<path d='M0 0h1' id='a' d='M0 0h5'/></svg>"),
            std::vector<std::string>{
                "3: 1 element with an attribute twice, the first of which is taken"});
  EXPECT_EQ(told(kRoot + "<g><g id='a' fill='red' id='a'/></g>" + kPath +
                 "<g fill='red' fill='red' fill='red'/></svg>"),
            std::vector<std::string>{
                "2: 2 elements with an attribute twice, the first of which is taken"});
}

TEST(XmlOddities, ElementsBehindTheEndAreTold) {
  EXPECT_EQ(told(kRoot + kPath + "</svg>\n<!-- two -->\n" + kPath + kPath),
            std::vector<std::string>{"5: what stands behind the end of <svg>"});
  EXPECT_EQ(told(kRoot + kPath + "</svg>" + kRoot + kPath + "</svg>"),
            std::vector<std::string>{"3: what stands behind the end of <svg>"});
}

TEST(XmlOddities, StyleSheetsBesideTheFileAreTold) {
  EXPECT_EQ(
      told("<?xml version='1.0'?>\n<?tool x?><?xml-stylesheet href='a.css'?>\n" + kRoot +
           "<?xml-stylesheet href='b.css'?>" + kPath + "</svg>"),
      std::vector<std::string>{"2: a style sheet that <?xml-stylesheet?> names: not followed"});
}

}  // namespace
}  // namespace keyline::exchange
