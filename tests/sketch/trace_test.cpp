#include "keyline/sketch/trace.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "keyline/core/polygon.h"
#include "keyline/curve/jet.h"
#include "keyline/sketch/calm_quintics.h"

#include "kinds_generator.h"
#include "page.h"

namespace keyline::sketch {
namespace {

using core::Point2;
using testing::blank_page;
using testing::draw_line;

/// White paper with black rings, drawn with soft edges.
Image rings(int size, const std::vector<double>& radii, double width) {
  Image image;
  image.luminance = Raster<std::uint16_t>(size, size);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const double r = std::hypot(x + 0.5 - 0.5 * size, y + 0.5 - 0.5 * size);
      double cover = 0;
      for (const double radius : radii)
        cover = std::max(cover, std::clamp(0.5 + 0.5 * width - std::abs(r - radius), 0.0, 1.0));
      image.luminance.at(x, y) = static_cast<std::uint16_t>(65535 * (1 - 0.9 * cover));
    }
  return image;
}

TEST(Trace, FindsRingsAsClosedStrokes) {
  const auto result = trace(rings(400, {60, 120, 170}, 4));
  ASSERT_TRUE(result) << result.error().message;
  ASSERT_EQ(result->strokes.size(), 3U);
  const double radii[] = {170, 120, 60};
  for (std::size_t i = 0; i < 3; ++i) {
    const Stroke& stroke = result->strokes[i];
    EXPECT_TRUE(stroke.closed);
    EXPECT_NEAR(stroke.width, 4, 0.2);
    for (const curve::Bezier2& piece : stroke.curve)
      for (const double t : {0.0, 0.3, 0.6})
        EXPECT_NEAR(core::distance(evaluate(piece, t), {200, 200}), radii[i], 0.5);
  }
}

// A close cut: beyond the rim of the picture there is paper.
TEST(Trace, LinesAlongTheRimStayInThePicture) {
  Image page = blank_page(300, 200);
  draw_line(page, {150, 2}, {260, 40}, 4);
  draw_line(page, {30, 2}, {150, 2}, 4);
  draw_line(page, {2, 60}, {2, 170}, 4);
  draw_line(page, {60, 198}, {200, 198}, 4);
  const auto result = trace(page);
  ASSERT_TRUE(result);
  EXPECT_GT(result->explained, 0.98);
  ASSERT_EQ(result->strokes.size(), 3U);
  for (const Stroke& stroke : result->strokes)
    for (const Point2 p : stroke.points) {
      if (p.x > 145 && p.y > 100) continue;  // that leaves the rim
      EXPECT_NEAR(std::min({p.x, p.y, 200 - p.y}), 2, 0.3) << p.x << " " << p.y;
    }
}

/// White paper with a line of that width along points, round at corners and ends.
Image drawn_along(const std::vector<Point2>& line, double width) {
  Image page = blank_page(120, 50);
  for (int y = 0; y < page.height(); ++y)
    for (int x = 0; x < page.width(); ++x) {
      double off = HUGE_VAL;
      for (const Point2 p : line) off = std::min(off, core::distance({x + 0.5, y + 0.5}, p));
      const double cover = std::clamp(0.5 + 0.5 * width - off, 0.0, 1.0);
      page.luminance.at(x, y) = static_cast<std::uint16_t>(65535 * (1 - 0.9 * cover));
    }
  return page;
}

/// Largest distance of a curve from points close to each other.
double largest_distance(const Stroke& stroke, double height, const std::vector<Point2>& line) {
  double largest = 0;
  for (const curve::Bezier2& piece : stroke.curve)
    for (int k = 0; k <= 60; ++k) {
      const Point2 p = evaluate(piece, k / 60.0);
      double off = HUGE_VAL;
      for (const Point2 q : line) off = std::min(off, core::distance({p.x, height - p.y}, q));
      largest = std::max(largest, off);
    }
  return largest;
}

// The ends of a thin ellipse turn as sharply as corners, but the ink does not reach to where the
// sides would meet; at the tips of a lens, two arcs that meet at a right angle, it does.
TEST(Trace, RoundEndsHaveNoCornersAndTipsHave) {
  std::vector<Point2> ellipse;  // of 2.4 pixels of radius at its ends
  std::vector<Point2> lens;
  for (int i = 0; i < 400; ++i) {
    const double t = std::numbers::pi * i / 200;
    ellipse.push_back({60.3 + 50 * std::cos(t), 25.2 + 11 * std::sin(t)});
    const double side = i % 2 == 0 ? 1 : -1;
    const double u = 0.25 * (t - std::numbers::pi);
    lens.push_back({60.3 + 60 * std::sin(u),
                    25.2 + 60 * side * (std::cos(u) - std::cos(0.25 * std::numbers::pi))});
  }
  const auto round = trace(drawn_along(ellipse, 2));
  ASSERT_TRUE(round);
  ASSERT_EQ(round->strokes.size(), 1U);
  EXPECT_TRUE(round->strokes[0].corners.empty());
  EXPECT_LT(largest_distance(round->strokes[0], 50, ellipse), 0.8);  // 2 and more with corners
  const auto tipped = trace(drawn_along(lens, 2));
  ASSERT_TRUE(tipped);
  ASSERT_EQ(tipped->strokes.size(), 1U);
  EXPECT_EQ(tipped->strokes[0].corners.size(), 2U);
}

// Along a hairline the grey swells and fades: its dark pixels are no pepper.
TEST(Trace, HairlinesStayWhole) {
  for (const double angle : {0.1, 0.25, 0.4, 0.7}) {
    SCOPED_TRACE(angle);
    Image page = blank_page(300, 260);
    draw_line(page, {20, 20}, {20 + 260 * std::cos(angle), 20 + 260 * std::sin(angle)}, 0.7);
    draw_line(page, {40, 240}, {280, 245}, 5);
    const auto result = trace(page);
    ASSERT_TRUE(result) << result.error().message;
    ASSERT_EQ(result->strokes.size(), 2U);
    EXPECT_NEAR(core::polygon_length(result->strokes[0].points), 260, 4);
  }
}

// Passes as asked for, and of the other kind: plain erosion loses what is thinner than its passes.
TEST(Trace, SmoothsInAsManyPassesAsAskedFor) {
  Image page = blank_page(300, 260);
  draw_line(page, {20, 20}, {270, 90}, 0.9);
  draw_line(page, {40, 240}, {280, 245}, 8);
  for (int x = 60; x < 260; x += 20) draw_line(page, {x + 0.4, 236}, {x + 0.6, 236}, 1);
  std::vector<long> flipped;
  for (const int passes : {0, 1, 2}) {
    TraceOptions options;
    options.smoothing = passes;
    options.specks = 0;
    Raster<std::uint8_t> before;
    options.stage = [&](const Stage& stage) {
      if (stage.name == "binary") before = stage.picture;
      if (stage.name != "smoothed") return;
      long count = 0;
      for (std::size_t i = 0; i < before.data.size(); ++i)
        count += before.data[i] != stage.picture.data[i];
      flipped.push_back(count);
    };
    const auto result = trace(page, options);
    ASSERT_TRUE(result) << result.error().message;
    EXPECT_EQ(result->strokes.size(), 2U);
  }
  ASSERT_EQ(flipped.size(), 3U);
  EXPECT_EQ(flipped[0], 0);
  EXPECT_GT(flipped[1], 0);
  EXPECT_GE(flipped[2], flipped[1]);
  TraceOptions plain;
  plain.smoothing_by = Smoothing::pixels;
  const auto result = trace(page, plain);
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_EQ(result->strokes.size(), 1U);
}

// A line that ends at another one ends there: within its width, on its own way.
TEST(Trace, StemsEndAtTheLineTheyMeet) {
  for (const double angle : {1.57, 1.2, 0.9, 0.6}) {
    for (const double width : {3.0, 6.0, 10.0}) {
      SCOPED_TRACE(std::to_string(angle) + ", " + std::to_string(width));
      Image page = blank_page(320, 240);
      draw_line(page, {20, 200}, {300, 200}, width);
      draw_line(page, {150, 200}, {150 + 140 * std::cos(angle), 200 - 140 * std::sin(angle)},
                width);
      const auto result = trace(page);
      ASSERT_TRUE(result) << result.error().message;
      ASSERT_EQ(result->strokes.size(), 2U);
      const auto& stem = result->strokes[1].points;
      const Point2 foot{150, 40};
      EXPECT_LT(std::min(core::distance(stem.front(), foot), core::distance(stem.back(), foot)),
                0.75 * width + 1);
    }
  }
}

// Where the pen went a little beyond the line it meets, there is no line of its own.
TEST(Trace, OvershootsAreNoLines) {
  Image page = blank_page(320, 160);
  draw_line(page, {20, 100}, {300, 100}, 2);
  draw_line(page, {150, 20}, {150, 103}, 2);
  const auto result = trace(page);
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_EQ(result->strokes.size(), 2U);
}

/// Sharpest curvature of a stroke.
double sharpest(const Stroke& stroke) {
  double most = 0;
  for (const curve::Bezier2& piece : stroke.curve)
    for (int i = 0; i <= 64; ++i) most = std::max(most, std::abs(curvature(jet(piece, i / 64.0))));
  return most;
}

// Driving the curvature improves it, keeps the curve on its line and leaves no spikes.
TEST(Trace, DrivenCurvesStayOnTheirLine) {
  Image page = blank_page(420, 300);
  Point2 last{20, 200};
  for (int i = 1; i <= 190; ++i) {  // a long S with a hand's tremble and a straight foot
    const double x = 20 + 2.0 * i;
    const Point2 next{
        x, 200 - (i < 60 ? 0 : 60 * (1 - std::cos(0.035 * (i - 60)))) + 0.6 * std::sin(0.4 * i)};
    draw_line(page, last, next, 4, 0.5);
    last = next;
  }
  const auto plain = trace(page);
  ASSERT_TRUE(plain) << plain.error().message;
  for (const CurvatureAim aim : {CurvatureAim::smooth, CurvatureAim::rhythm})
    for (const double tolerance : {0.5, 0.0}) {
      TraceOptions options;
      options.curve.aim = aim;
      options.curve.tolerance = tolerance;
      const auto driven = trace(page, options);
      ASSERT_TRUE(driven) << driven.error().message;
      ASSERT_EQ(driven->strokes.size(), plain->strokes.size());
      const Stroke& stroke = driven->strokes[0];
      ASSERT_TRUE(stroke.driven);
      EXPECT_LE(stroke.driven->after, stroke.driven->before);
      if (tolerance > 0) {
        EXPECT_LT(waves_of(stroke.curve), waves_of(plain->strokes[0].curve));
      }
      EXPECT_LT(sharpest(stroke), 0.5);
      for (const curve::Bezier2& piece : stroke.curve)
        for (const double t : {0.0, 0.25, 0.5, 0.75}) {
          double least = HUGE_VAL;
          for (const Point2 p : stroke.points)
            least = std::min(least, core::distance(p, evaluate(piece, t)));
          EXPECT_LT(least, 2.2);
        }
    }
}

/// Curvature halfway along a line less that of its ends' harmonic mean, their arithmetic mean's
/// being 1: 0 of a logarithmic spiral, 1 of a clothoid.
double halfway(const Stroke& stroke) {
  const auto near = [&](double share) {
    const curve::PiecewiseBezier chain{stroke.curve, 0};
    double sum = 0;  // over a stretch: joints
    for (int i = -4; i <= 4; ++i) sum += std::abs(curvature(jet(chain, share + 0.01 * i)));
    return sum / 9;
  };
  const double a = near(0.05);
  const double b = near(0.95);
  const double harmonic = 2 / (1 / a + 1 / b);
  return (near(0.5) - harmonic) / (0.5 * (a + b) - harmonic);
}

/// A stroke with a corner, and one that waves, in some unit.
core::Result<TraceResult> traced_in(double unit) {
  DrawnStroke bent, waving;
  for (int i = 0; i <= 200; ++i) {
    const double t = 0.5 * i;
    bent.points.push_back({unit * t, unit * std::abs(t - 50)});
    waving.points.push_back({unit * t, unit * (80 + 6 * std::sin(0.1 * t))});
  }
  return trace_strokes({bent, waving}, 2 * unit);
}

TEST(Trace, StrokesComeOutTheSameInEveryUnit) {
  const auto one = traced_in(1);
  ASSERT_TRUE(one);
  for (const double unit : {1000.0, 0.001}) {
    SCOPED_TRACE(unit);
    const auto other = traced_in(unit);
    ASSERT_TRUE(other);
    ASSERT_EQ(other->strokes.size(), 2U);
    for (std::size_t k = 0; k < 2; ++k) {
      const Stroke& a = one->strokes[k];
      const Stroke& b = other->strokes[k];
      EXPECT_NEAR(b.width, unit * a.width, 1e-12 * unit);
      EXPECT_EQ(a.corners, b.corners);
      ASSERT_EQ(a.curve.size(), b.curve.size());
      for (std::size_t i = 0; i < a.curve.size(); ++i)
        for (std::size_t c = 0; c < 6; ++c)
          EXPECT_LT(core::distance(b.curve[i].control[c], {unit * a.curve[i].control[c].x,
                                                           unit * a.curve[i].control[c].y}),
                    1e-4 * unit);
    }
  }
}

// A logarithmic spiral (slope 1) is asked to be accelerating (slope -0.5 and less).
TEST(Trace, GivesLinesTheRhythmAskedFor) {
  DrawnStroke spiral;
  for (double turn = 0; turn <= 2; turn += 0.01)
    spiral.points.push_back({100 * std::exp(-0.6 * turn) * std::cos(turn),
                             100 * std::exp(-0.6 * turn) * std::sin(turn)});
  TraceOptions options;
  options.curve.tolerance = 0.5;  // widths
  const auto plain = trace_strokes({spiral}, 0.5, options);
  ASSERT_TRUE(plain);
  options.curve.aim = CurvatureAim::rhythm;
  options.curve.rhythm = fit::WantedRhythm::accelerating;
  const auto given = trace_strokes({spiral}, 0.5, options);
  ASSERT_TRUE(given);
  ASSERT_TRUE(given->strokes[0].driven);
  EXPECT_LT(given->strokes[0].driven->after, given->strokes[0].driven->before);
  EXPECT_LT(given->strokes[0].driven->after, 0.1 * 0.0187);  // of the spiral's mean curvature
  EXPECT_GT(halfway(given->strokes[0]), halfway(plain->strokes[0]) + 0.15);
  for (const curve::Bezier2& piece : given->strokes[0].curve)
    for (const double t : {0.0, 0.3, 0.7}) {
      double least = HUGE_VAL;
      for (const Point2 p : spiral.points)
        least = std::min(least, core::distance(p, evaluate(piece, t)));
      EXPECT_LT(least, 1.5);  // three tolerances, and half the way between points
    }
}

TEST(Trace, SaysThatBlankPicturesHoldNoLine) {
  for (const std::uint16_t level : {0, 30000, 65535}) {
    for (const int size : {1, 2, 50}) {
      Image blank;
      blank.luminance = Raster<std::uint16_t>(size, size, level);
      const auto result = trace(blank);
      ASSERT_FALSE(result);
      EXPECT_EQ(result.error().code, core::ErrorCode::undrawable);
    }
  }
}

// Half of a drawing in deep shade is still a drawing, as its lines show; a shaded ball is none.
TEST(Trace, ADrawingInShadeIsNoPhotograph) {
  const auto doubts = [](const Image& image) {
    const auto result = trace(image);
    EXPECT_TRUE(result) << result.error().message;
    return result && std::ranges::any_of(result->notes, [](const std::string& note) {
             return note.find("is it a drawing?") != std::string::npos;
           });
  };
  Image drawing = rings(400, {60, 120, 170}, 4);
  Image ball = blank_page(400, 400);
  for (int y = 0; y < 400; ++y)
    for (int x = 0; x < 400; ++x) {
      const double shade = 0.4 / (1 + std::exp((190.0 - x) / 40));
      auto& v = drawing.luminance.at(x, y);
      v = static_cast<std::uint16_t>((1 - shade) * v);
      const double r = std::hypot(x - 200.0, y - 200.0) / 150;
      if (r < 1) ball.luminance.at(x, y) = static_cast<std::uint16_t>(40'000 - 30'000 * r);
    }
  EXPECT_FALSE(doubts(drawing));
  EXPECT_TRUE(doubts(ball));
}

// Waves of 2 pixels either way, of a pen of 1.5: taken out as far as wider ink allows they leave
// it.
TEST(Trace, SmoothCurvesKeepToThinInk) {
  Image image = blank_page(240, 80);
  const auto at = [](int x) { return Point2{1.0 * x, 40 + 2 * std::sin(x * M_PI / 40)}; };
  for (int x = 20; x < 220; x += 2) draw_line(image, at(x), at(x + 2), 1.5);
  TraceOptions options;
  options.curve.aim = CurvatureAim::smooth;
  const auto result = trace(std::move(image), options);
  ASSERT_TRUE(result);
  EXPECT_GT(result->explained, 0.99);
}

TEST(Trace, DrawnStrokesSayWhoStandsForThem) {
  std::vector<DrawnStroke> strokes;
  for (int k = 0; k < 3; ++k) strokes.push_back({{{0, 0.5 * k}, {40, 0.5 * k}, {100, 0.5 * k}}});
  strokes.push_back({{{50, 60}, {50.2, 60}}});  // a dot
  strokes.push_back({{{0, 80}, {100, 80}}});
  const auto plain = trace_strokes(strokes, 1, {});
  ASSERT_TRUE(plain);
  ASSERT_EQ(plain->notes.size(), 1U);
  EXPECT_EQ(plain->notes[0],
            "4 strokes look like passes of about 2 lines: consolidate makes one curve of each");
  TraceOptions options;
  options.consolidate = true;
  const auto result = trace_strokes(strokes, 1, options);
  ASSERT_TRUE(result);
  ASSERT_EQ(result->strokes.size(), 2U);
  EXPECT_EQ(result->strokes[0].members, (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_EQ(result->strokes[1].members, (std::vector<std::size_t>{4}));
  EXPECT_EQ(result->left_over, (std::vector<std::size_t>{3}));
  EXPECT_GT(result->explained, 0.99);
}

}  // namespace
}  // namespace keyline::sketch
