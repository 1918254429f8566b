#include "keyline/exchange/svg/svg_path.h"

#include <cmath>

#include <gtest/gtest.h>

namespace keyline::exchange {
namespace {

using core::Point2;
using curve::Bezier2;

/// "L 0,0 1,1": degree letter and control points of every piece, "z" after closed subpaths,
/// "|" between subpaths.
std::string text_of(const SvgPathData& data) {
  std::string text;
  for (const SvgSubpath& subpath : data.subpaths) {
    if (!text.empty()) text += " | ";
    for (const Bezier2& piece : subpath.pieces) {
      if (!text.empty() && text.back() != ' ') text += ' ';
      text += std::string("?LQC")[piece.control.size() - 1];
      if (!piece.weights.empty()) text += 'w';
      for (const Point2& p : piece.control) {
        char buffer[64];
        std::snprintf(buffer, sizeof buffer, " %g,%g", p.x, p.y);
        text += buffer;
      }
    }
    if (subpath.closed) text += " z";
  }
  return text;
}

struct PathCase {
  const char* d;
  const char* pieces;
  const char* error;
};

TEST(SvgPath, ReadsEveryCommand) {
  const PathCase cases[] = {
      {"", "", ""},
      {"M1 2", "", ""},
      {"M1 2L3 4", "L 1,2 3,4", ""},
      {"m1 2l3 4", "L 1,2 4,6", ""},
      {" M 1,2 , 3,4 ", "L 1,2 3,4", ""},
      {"M0 0 1 0 1 1", "L 0,0 1,0 L 1,0 1,1", ""},
      {"m1 1 1 0 0 1", "L 1,1 2,1 L 2,1 2,2", ""},
      {"M0 0H5V6h-1v-2", "L 0,0 5,0 L 5,0 5,6 L 5,6 4,6 L 4,6 4,4", ""},
      {"M0 0C1 1 2 1 3 0", "C 0,0 1,1 2,1 3,0", ""},
      {"M1 0c1 1 2 1 3 0s2-1 3 0", "C 1,0 2,1 3,1 4,0 C 4,0 5,-1 6,-1 7,0", ""},
      {"M0 0S1 1 2 0", "C 0,0 0,0 1,1 2,0", ""},
      {"M0 0Q1 1 2 0T4 0", "Q 0,0 1,1 2,0 Q 2,0 3,-1 4,0", ""},
      {"M0 0T2 2t2 0", "Q 0,0 0,0 2,2 Q 2,2 4,4 4,2", ""},
      {"M0 0L1 0L1 1Z", "L 0,0 1,0 L 1,0 1,1 L 1,1 0,0 z", ""},
      {"M0 0L1 0L1 1L0 0z", "L 0,0 1,0 L 1,0 1,1 L 1,1 0,0 z", ""},
      {"M0 0L1 0z m2 2l1 0", "L 0,0 1,0 L 1,0 0,0 z | L 2,2 3,2", ""},
      {"M0 0L1 0zL5 5", "L 0,0 1,0 L 1,0 0,0 z | L 0,0 5,5", ""},
      {"M.5.5L1.5.5-1-1", "L 0.5,0.5 1.5,0.5 L 1.5,0.5 -1,-1", ""},
      {"M1e1-1e-1L+2.+3", "L 10,-0.1 2,3", ""},
      {"M0 0L0 0L1 1", "L 0,0 1,1", ""},
      {"M0 0A5 5 0 0 1 0 0", "", ""},
      {"M0 0A0 5 0 0 1 3 0", "L 0,0 3,0", ""},
      {"L1 1", "", "a path has to start with M"},
      {"M0 0L1 1L2", "L 0,0 1,1", "a number is expected here"},
      {"M0 0L1 1L2#3", "L 0,0 1,1", "a number is expected here"},
      {"M0 0L1 1 X", "L 0,0 1,1", "a path command is expected here"},
      {"M0 0L1 1z5 5", "L 0,0 1,1 L 1,1 0,0 z", "a path command is expected after Z"},
      {"M0 0L1e999 0", "", "a number is expected here"},
      {"M0 0L1e-999 1", "L 0,0 0,1", ""},
      {"M0 0Lnan inf", "", "a number is expected here"},
      {"M0 0A1 1 0 2 1 3 3", "", "a number is expected here"},
      {"M0 0L,,1 1", "", "a number is expected here"},
  };
  for (const PathCase& c : cases) {
    SCOPED_TRACE(c.d);
    const SvgPathData data = parse_svg_path(c.d);
    EXPECT_EQ(text_of(data), c.pieces);
    EXPECT_EQ(data.error, c.error);
  }
}

TEST(SvgPath, ArcsLieExactlyOnTheEllipse) {
  // Quarter, three quarters, and both sweeps of a circle about (100, 100) of radius 25.
  for (const char* d : {"M100 125a25 25 0 0 1-25-25", "M75 100a25 25 0 1125 25",
                        "M75 100a25 25 0 1 1 25 25", "M100 75A25 25 30 0 0 75 100"}) {
    SCOPED_TRACE(d);
    const SvgPathData data = parse_svg_path(d);
    ASSERT_EQ(data.subpaths.size(), 1U);
    EXPECT_EQ(data.error, "");
    for (const Bezier2& piece : data.subpaths[0].pieces)
      for (double t = 0; t <= 1; t += 0.125)
        EXPECT_NEAR(core::distance(evaluate(piece, t), {100, 100}), 25, 1e-12);
  }
}

TEST(SvgPath, LargeArcTakesTheLongWay) {
  const auto short_way = detail::svg_arc({0, 0}, {1, 1}, 1, 1, 0, false, true);
  const auto long_way = detail::svg_arc({0, 0}, {1, 1}, 1, 1, 0, true, true);
  EXPECT_EQ(short_way.size(), 1U);
  EXPECT_EQ(long_way.size(), 3U);
  EXPECT_EQ(long_way.back().control.back(), (Point2{1, 1}));
}

// Half a radian of the unit circle, either way round; its middle lies at a quarter.
TEST(SvgPath, ShortArcsAreOnePiece) {
  for (const double sense : {1.0, -1.0}) {
    const Point2 to{std::cos(0.5), sense * std::sin(0.5)};
    const auto arcs = detail::svg_arc({1, 0}, to, 1, 1, 0, false, sense > 0);
    ASSERT_EQ(arcs.size(), 1U);
    const Point2 middle{std::cos(0.25), sense * std::sin(0.25)};
    EXPECT_LT(core::distance(evaluate(arcs[0], 0.5), middle), 1e-14);
  }
}

// An arc rises c^2 / (4 (r + sqrt(r^2 - c^2 / 4))) above its chord c; an ellipse twice as wide as
// high does so where x is halved.
TEST(SvgPath, SlightArcsLieAtTheirChord) {
  const Point2 from{12.34, 5.67}, to{112.9, 48.1};
  for (const double r : {1e3, 1e5, 1e9, 1e13, 1e15, 1e17, 1e300})
    for (const double wide : {1.0, 2.0})
      for (const bool sweep : {false, true}) {
        const core::Vector2 chord{(to.x - from.x) / wide, to.y - from.y};
        const double quarter = dot(chord, chord) / 4;
        const double rise = quarter / (r + std::sqrt(1 - quarter / r / r) * r);
        core::Vector2 up = core::Vector2{chord.y, -chord.x} / (sweep ? norm(chord) : -norm(chord));
        up.x *= wide;
        const auto arcs = detail::svg_arc(from, to, wide * r, r, 0, false, sweep);
        ASSERT_EQ(arcs.size(), 1U);
        EXPECT_LT(core::distance(evaluate(arcs[0], 0.5), core::mix(from, to, 0.5) + rise * up),
                  6e-14)
            << r;
      }
}

TEST(SvgPath, ArcsWithSmallRadiiAreEnlarged) {
  const auto arcs = detail::svg_arc({0, 0}, {10, 0}, 1, 1, 45, false, true);
  ASSERT_EQ(arcs.size(), 2U);
  for (const Bezier2& piece : arcs)
    EXPECT_NEAR(core::distance(evaluate(piece, 0.5), {5, 0}), 5, 1e-12);
}

TEST(SvgPath, HalfTurnsKeepTheirCentre) {
  const Point2 from{10, 50};
  const Point2 to{150, 151};
  for (const double share : {0.1, 1.0}) {
    const double radius = share * core::distance(from, to) / 2;
    const auto arcs = detail::svg_arc(from, to, radius, radius, 0, false, true);
    ASSERT_EQ(arcs.size(), 2U);
    EXPECT_LT(core::distance(arcs[0].control[2], {130.5, 30.5}), 1e-12);
  }
}

TEST(SvgPath, TurnedEllipseKeepsItsAxes) {
  const auto arcs = detail::svg_arc({0, 0}, {0, 4}, 4, 2, 90, false, true);
  // In the frame turned by 90 degrees the ellipse is (x/2)^2 + (y/4)^2 = 1 about its centre.
  const Point2 center{-std::sqrt(3.0), 2};
  for (const Bezier2& piece : arcs)
    for (double t = 0; t <= 1; t += 0.25) {
      const core::Vector2 v = evaluate(piece, t) - center;
      EXPECT_NEAR(std::hypot(v.x / 2, v.y / 4), 1, 1e-12);
    }
}

}  // namespace
}  // namespace keyline::exchange
