#include "keyline/exchange/svg/svg_transform.h"

#include <cmath>
#include <numbers>
#include <string>
#include <tuple>

#include <gtest/gtest.h>

#include "keyline/exchange/svg/svg_reader.h"

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

void expect_near(core::Point2 a, core::Point2 b) { EXPECT_LT(distance(a, b), 1e-14); }

// SVG 1.1, 7.6: rotations turn x towards y, about a point where one is given; skewX moves along x.
TEST(SvgTransform, TurnsAndSkewsAsTheStandardSays) {
  const auto at = [](const char* text, core::Point2 p) {
    return apply(*parse_svg_transform(text), p);
  };
  expect_near(at("rotate(90)", {1, 0}), {0, 1});
  expect_near(at("rotate(90)", {0, 1}), {-1, 0});
  expect_near(at("rotate(90 2 1)", {3, 1}), {2, 2});
  expect_near(at("rotate(90 2 1)", {2, 2}), {1, 1});
  expect_near(at("rotate(450)", {1, 0}), {0, 1});
  expect_near(at("skewX(45)", {1, 2}), {3, 2});
  expect_near(at("skewY(45)", {1, 2}), {1, 3});
  expect_near(at("skewX(405)", {0, 2}), {2, 2});
  expect_near(at(" rotate ( 180 ) , scale(2)", {1, 1}), {-2, -2});
}

TEST(SvgTransform, WhatIsNoneOfThemIsRefused) {
  for (const char* none :
       {"scale", "scale 2", "scale(2", "scale(2;3)", "scale()", "scale(1 2 3)", "translate(1 2 3)",
        "rotate(1 2)", "rotate(1 2 3 4)", "skewX(1 2)", "skewY()", "matrix(1 2 3 4 5)",
        "matrix(1 2 3 4 5 6 7)", "turn(3)", "scale(x)"})
    EXPECT_FALSE(parse_svg_transform(none)) << none;
  EXPECT_TRUE(parse_svg_transform(""));
}

TEST(SvgTransform, ViewBoxesHaveAPlaceAndASize) {
  const auto box = parse_svg_view_box(" -1, 2 30,40 ");
  ASSERT_TRUE(box);
  EXPECT_EQ(box->x, -1);
  EXPECT_EQ(box->y, 2);
  EXPECT_EQ(box->width, 30);
  EXPECT_EQ(box->height, 40);
  for (const char* none : {"", "0 0 1", "0 0 1 1 1", "0 0 0 1", "0 0 1 0", "0 0 -1 1", "a 0 1 1"})
    EXPECT_FALSE(parse_svg_view_box(none)) << none;
}

// SVG 2, 8.2: of a box of 10 by 10 in 40 by 20 the smaller scale is 2, and 20 are left over in x;
// slice has 4 and 20 too many in y.
TEST(SvgTransform, TheBoxStandsWhereTheAspectSays) {
  const auto corner = [](const char* aspect) {
    return apply(fit_view_box({5, 6, 10, 10}, 40, 20, aspect), {5, 6});
  };
  EXPECT_EQ(corner("xMinYMin"), (core::Point2{0, 0}));
  EXPECT_EQ(corner("xMidYMid meet"), (core::Point2{10, 0}));
  EXPECT_EQ(corner(""), (core::Point2{10, 0}));
  EXPECT_EQ(corner("xMaxYMax"), (core::Point2{20, 0}));
  EXPECT_EQ(corner("xMinYMin slice"), (core::Point2{0, 0}));
  EXPECT_EQ(corner("xMidYMid slice"), (core::Point2{0, -10}));
  EXPECT_EQ(corner("xMinYMax slice"), (core::Point2{0, -20}));
  EXPECT_EQ(corner("none"), (core::Point2{0, 0}));
  EXPECT_EQ(apply(fit_view_box({5, 6, 10, 10}, 40, 20, "none"), {15, 16}), (core::Point2{40, 20}));
}

// CSS: an inch is 25.4 mm, 72 points, 6 picas; a quarter of a millimetre is a Q.
TEST(SvgTransform, LengthsHaveTheirUnits) {
  for (const auto& [text, value, physical] : {std::tuple{"3", 3.0, false},
                                              {" 3px ", 3.0, false},
                                              {"3mm", 3.0, true},
                                              {"3cm", 30.0, true},
                                              {"3in", 76.2, true},
                                              {"72pt", 25.4, true},
                                              {"6pc", 25.4, true},
                                              {"4Q", 1.0, true},
                                              {"2em", 32.0, false},
                                              {"2rem", 32.0, false},
                                              {"2ex", 16.0, false},
                                              {"1e1mm\n", 10.0, true}}) {
    const auto length = parse_svg_length(text);
    ASSERT_TRUE(length) << text;
    EXPECT_NEAR(length->value, value, 1e-14 * value) << text;
    EXPECT_EQ(length->physical, physical) << text;
  }
  for (const char* none : {"", "mm", "3%", "3 mm x", "3MM", "3m"})
    EXPECT_FALSE(parse_svg_length(none)) << none;
}

// Without a viewBox a px is 1 / 96 inch where the size is one of paper; with one and a single size
// the other follows.
TEST(SvgTransform, ThePageIsAsLargeAsItsSizes) {
  const SvgLength paper{50, true};
  const SvgLength px{50, false};
  const auto plain = outermost_frame(paper, paper, {}, "");
  EXPECT_TRUE(plain.physical);
  ASSERT_TRUE(plain.page);
  EXPECT_NEAR(plain.page->width, 50 * 96 / 25.4, 1e-12);
  EXPECT_NEAR(plain.page->height, 50 * 96 / 25.4, 1e-12);
  expect_near(apply(plain.map, {96, 96}), {25.4, -25.4});
  const auto screen = outermost_frame(px, px, {}, "");
  EXPECT_FALSE(screen.physical);
  EXPECT_EQ(apply(screen.map, {3, 4}), (core::Point2{3, -4}));
  EXPECT_EQ(screen.page->width, 50);
  EXPECT_FALSE(outermost_frame(px, {}, {}, "").page);
  EXPECT_FALSE(outermost_frame({}, px, {}, "").page);
  EXPECT_TRUE(outermost_frame({}, paper, {}, "").physical);
  const SvgViewBox box{0, 0, 100, 200};
  EXPECT_EQ(apply(outermost_frame(paper, {}, box, "").map, {10, 10}), (core::Point2{5, -5}));
  EXPECT_EQ(apply(outermost_frame({}, paper, box, "").map, {20, 20}), (core::Point2{5, -5}));
  EXPECT_EQ(apply(outermost_frame({}, {}, box, "").map, {20, 20}), (core::Point2{20, -20}));
  EXPECT_EQ(outermost_frame({}, paper, box, "").page->width, 100);
}

// 60 by 60 around the middle of a box of 100 by 50: what the page shows of it is 100 by 100.
TEST(SvgTransform, ThePageShowsWhatTheAspectLeaves) {
  const SvgLength size{60, true};
  const auto frame = outermost_frame(size, size, SvgViewBox{10, 20, 100, 50}, "");
  ASSERT_TRUE(frame.page);
  EXPECT_NEAR(frame.page->x, 10, 1e-13);
  EXPECT_NEAR(frame.page->y, -5, 1e-13);
  EXPECT_NEAR(frame.page->width, 100, 1e-13);
  EXPECT_NEAR(frame.page->height, 100, 1e-13);
}

TEST(SvgTransform, WhatCollapsesCannotBeInverted) {
  EXPECT_TRUE(is_invertible({1e-9, 0, 0, 1e-9, 0, 0}));
  EXPECT_TRUE(is_invertible({1, 2, 3, 4, 0, 0}));
  EXPECT_FALSE(is_invertible({1, 2, 2, 4, 0, 0}));
  EXPECT_FALSE(is_invertible({0, 0, 0, 1, 0, 0}));
  EXPECT_FALSE(is_invertible({1, 0, 0, 1, HUGE_VAL, 0}));
  EXPECT_FALSE(is_invertible({1, 0, 0, 1, 0, HUGE_VAL}));
  EXPECT_FALSE(is_invertible({HUGE_VAL, 0, 0, 1, 0, 0}));
}

// A stroke grows by the root of what its area grows by: turned or sheared it stays, stretched in
// one direction by 4 it is twice as wide.
TEST(SvgReader, StrokesGrowWithTheArea) {
  const auto width = [](const std::string& transform) {
    const auto read = read_svg(
        "<svg xmlns='http://www.w3.org/2000/svg' width='10mm' height='10mm' viewBox='0 0 10 10'>"
        "<path stroke='red' stroke-width='3' d='M0 0h1' transform='" +
        transform + "'/></svg>");
    return read && read->curves.size() == 1 ? read->curves[0].stroke_width : -1;
  };
  EXPECT_NEAR(width("rotate(45)"), 3, 1e-12);
  EXPECT_NEAR(width("rotate(30) scale(2)"), 6, 1e-12);
  EXPECT_NEAR(width("skewX(45)"), 3, 1e-12);
  EXPECT_NEAR(width("matrix(1 1 -1 1 0 0)"), 3 * std::numbers::sqrt2, 1e-12);
  EXPECT_NEAR(width("scale(4 1)"), 6, 1e-12);
  EXPECT_NEAR(width("scale(-1 1)"), 3, 1e-12);
}

// SVG 2, 8.13: px of the page, whatever is between; for the element alone that says so.
TEST(SvgReader, StrokesThatDoNotScaleCountPx) {
  const auto width = [](const std::string& page, const std::string& group,
                        const std::string& path) {
    const auto read = read_svg(
        "<svg xmlns='http://www.w3.org/2000/svg' " + page + "><g transform='scale(10)' " + group +
        "><path stroke='red' stroke-width='3' d='M0 0h1' " + path + "/></g></svg>");
    return read && read->curves.size() == 1 ? read->curves[0].stroke_width : -1;
  };
  const std::string effect = "vector-effect='non-scaling-stroke'";
  const std::string paper = "width='10mm' height='10mm' viewBox='0 0 5 5'";
  EXPECT_NEAR(width("", "", ""), 30, 1e-12);
  EXPECT_NEAR(width("", "", effect), 3, 1e-12);
  EXPECT_NEAR(width("", "", "style='vector-effect:non-scaling-stroke'"), 3, 1e-12);
  EXPECT_NEAR(width("", effect, ""), 30, 1e-12);
  EXPECT_NEAR(width("width='50' viewBox='0 0 5 5'", "", effect), 3, 1e-12);
  EXPECT_NEAR(width(paper, "", effect), 3 * 25.4 / 96, 1e-12);
  EXPECT_NEAR(width(paper, "", "vector-effect='none'"), 60, 1e-12);
}

SvgContents turned(const std::string& root, const std::string& d) {
  const auto read =
      read_svg("<svg xmlns='http://www.w3.org/2000/svg' " + root + "><path d='" + d + "'/></svg>");
  EXPECT_TRUE(read);
  return read ? *read : SvgContents{};
}

// CSS Transforms 1, transform-origin: in px, about the middle of the page, before the viewBox.
// Chromium draws this triangle from (200, 100) to (220, 140).
TEST(SvgReader, ATransformOfTheRootMovesThePage) {
  const SvgContents c = turned(
      "width='400' height='200' viewBox='10 0 100 50' "
      "transform='translate(20 0) rotate(90)'",
      "M60 25L70 25L70 30");
  ASSERT_EQ(c.curves.size(), 1U);
  const auto& pieces = c.curves[0].pieces;
  EXPECT_NEAR(core::distance(pieces[0].control[0], {40 + 220, -100}), 0, 1e-12);
  EXPECT_NEAR(core::distance(pieces[1].control[0], {40 + 220, -140}), 0, 1e-12);
  EXPECT_NEAR(core::distance(pieces[1].control[1], {40 + 200, -140}), 0, 1e-12);
  ASSERT_TRUE(c.page);
  EXPECT_NEAR(core::distance(c.page->low, {40 + 120, -300}), 0, 1e-12);
  EXPECT_NEAR(core::distance(c.page->high, {40 + 320, 100}), 0, 1e-12);
  EXPECT_TRUE(c.skipped.empty());
  const SvgContents paper =
      turned("width='9cm' viewBox='0 0 9 9' transform='translate(96)'", "M0 0h1");
  EXPECT_NEAR(paper.curves.at(0).pieces[0].control[0].x, 25.4, 1e-12);
}

TEST(SvgReader, WhatOfTheRootsTransformIsNotFollowedIsTold) {
  const auto told = [](const std::string& root) {
    const SvgContents c = turned(root, "M0 0h10");
    return c.skipped.empty() ? std::string() : c.skipped[0].what;
  };
  EXPECT_EQ(told("transform='translate(3 4)'"), "");
  EXPECT_EQ(told("transform='rotate(90)'"), "svg: turned about the origin, as it has no middle");
  EXPECT_EQ(told("transform='turn'"), "svg: a transform that cannot be read is ignored");
  EXPECT_EQ(told("width='9' height='9' transform='scale(0)'"), "svg: its transform leaves no area");
  EXPECT_EQ(told("style='rotate:9deg'"), "svg: what CSS turns or shifts it by is ignored");
  EXPECT_EQ(told("clip-path='url(#c)'"), "svg: is not clipped, whole here");
  const auto read = turned("transform='rotate(90)'", "M0 0h10");
  EXPECT_NEAR(core::distance(read.curves.at(0).pieces[0].control[1], {0, -10}), 0, 1e-12);
}

}  // namespace
}  // namespace keyline::exchange::detail
