#include "keyline/fairing/symmetric.h"

#include <numbers>

#include <gtest/gtest.h>

namespace keyline::fairing {
namespace {

TEST(Symmetric, LinesAreReadFromText) {
  const double quarter = std::numbers::pi / 2;
  const auto line = [](const char* text) {
    return Symmetric::from_text(text).value_or(Symmetric{});
  };
  EXPECT_EQ(line("x=3"), (Symmetric{SymmetricMode::line, {3, 0}, quarter}));
  EXPECT_EQ(line("y=-2.5"), (Symmetric{SymmetricMode::line, {0, -2.5}, 0}));
  EXPECT_EQ(line("1,2:90"), (Symmetric{SymmetricMode::line, {1, 2}, quarter}));
  EXPECT_EQ(line("-1,0.5:-45"), (Symmetric{SymmetricMode::line, {-1, 0.5}, -quarter / 2}));
  EXPECT_EQ(line("auto").mode, SymmetricMode::found);
  EXPECT_EQ(line("off").mode, SymmetricMode::off);
}

TEST(Symmetric, OtherTextsAreNone) {
  for (const char* text : {"", "line", "x=", "z=1", "x:1", "1,2", "1:2", "1:2,3", ",2:3", "1,:3",
                           "1,2:", "x=one", "a,b:c"})
    EXPECT_FALSE(Symmetric::from_text(text)) << text;
}

}  // namespace
}  // namespace keyline::fairing
