#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "keyline/sketch/trace.h"

#include "page.h"

namespace keyline::sketch {
namespace {

using testing::blank_page;

// Dots of 2 x 2 pixels beside a line of 3 x 120: 9 of them are 36 pixels of 396, two are 2 %, one
// is 1 %; in no row. Left out as dirt, they are told; kept, they are not.
TEST(TellPicture, DirtThatIsLeftOut) {
  struct Case {
    int dots;
    int specks;
    std::string told;
  };
  for (const Case& one : {Case{9, 20, "9 % of the ink, 9 pieces of fewer than 20 pixels"},
                          {2, 20, "2 % of the ink, 2 pieces of fewer than 20 pixels"},
                          {0, 20, ""},
                          {9, 0, ""}}) {
    Image page = blank_page(160, 60);
    for (int y = 20; y < 23; ++y)
      for (int x = 20; x < 140; ++x) page.luminance.at(x, y) = 0;
    for (int k = 0; k < one.dots; ++k)
      for (const int x : {20, 21})
        for (const int y : {30, 31}) page.luminance.at(x + 12 * k, y + 3 * (5 * k % 9)) = 0;
    TraceOptions options;
    options.specks = one.specks;
    const auto result = trace(page, options);
    ASSERT_TRUE(result) << result.error().message;
    const auto note = std::ranges::find_if(result->notes, [](const std::string& text) {
      return text.find("left out as dirt") != std::string::npos;
    });
    ASSERT_EQ(note != result->notes.end(), !one.told.empty()) << one.dots << ' ' << one.specks;
    if (!one.told.empty()) {
      EXPECT_EQ(note->find(one.told), 0U) << *note;
    }
  }
}

}  // namespace
}  // namespace keyline::sketch
