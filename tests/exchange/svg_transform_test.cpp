#include "keyline/exchange/svg/svg_transform.h"

#include <gtest/gtest.h>

namespace keyline::exchange::detail {
namespace {

// SVG 1.1, 7.6: matrix(a b c d e f) takes (x, y) to (a x + c y + e, b x + d y + f); of several
// transforms the last is made first.
TEST(SvgTransform, TakesPointsWhereTheStandardSays) {
  const auto at = [](const char* text, core::Point2 p) {
    return apply(*parse_svg_transform(text), p);
  };
  EXPECT_EQ(at("matrix(2 3 5 7 11 13)", {1, 0}), (core::Point2{13, 16}));
  EXPECT_EQ(at("matrix(2,3,5,7,11,13)", {0, 1}), (core::Point2{16, 20}));
  EXPECT_EQ(at("translate(3)", {1, 1}), (core::Point2{4, 1}));
  EXPECT_EQ(at("translate(3 4)", {1, 1}), (core::Point2{4, 5}));
  EXPECT_EQ(at("scale(3)", {1, 2}), (core::Point2{3, 6}));
  EXPECT_EQ(at("scale(3 4)", {1, 2}), (core::Point2{3, 8}));
  EXPECT_EQ(at("translate(1 0) scale(2)", {3, 0}), (core::Point2{7, 0}));
  EXPECT_EQ(at("scale(2) translate(1 0)", {3, 0}), (core::Point2{8, 0}));
}

// SVG 2, 8.2: the smaller scale for both axes, the larger one for slice, each its own for none,
// whatever else is said.
TEST(SvgTransform, ThePageKeepsTheAspectAskedFor) {
  const SvgLength width{200, true};
  const SvgLength height{50, true};
  const auto end = [&](const char* aspect) {
    const auto frame = outermost_frame(width, height, SvgViewBox{0, 0, 100, 100}, aspect);
    return apply(frame.map, {10, -10});
  };
  EXPECT_EQ(end(""), (core::Point2{5, 5}));
  EXPECT_EQ(end("xMinYMax meet"), (core::Point2{5, 5}));
  EXPECT_EQ(end("xMidYMid slice"), (core::Point2{20, 20}));
  EXPECT_EQ(end("none"), (core::Point2{20, 5}));
  EXPECT_EQ(end(" none meet"), (core::Point2{20, 5}));
}

}  // namespace
}  // namespace keyline::exchange::detail
