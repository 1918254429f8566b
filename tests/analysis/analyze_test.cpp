#include "keyline/analysis/analyze.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "keyline/curve/bezier.h"
#include "keyline/curve/bspline.h"

#include "spirals.h"

namespace keyline::analysis {
namespace {

TEST(Analyze, FillsEverything) {
  const auto c = testing::clothoid(-1, 3, 2);
  const auto result = analyze(c);
  ASSERT_TRUE(result);
  EXPECT_NEAR(result->length, 2, 1e-12);
  EXPECT_NEAR(result->curvature_min, -1, 1e-9);
  EXPECT_NEAR(result->curvature_max, 3, 1e-9);
  EXPECT_EQ(result->plot.size(), 401u);
  ASSERT_EQ(result->pieces.size(), 2u);
  EXPECT_GT(result->volume, 0);
  for (const PieceAnalysis& p : result->pieces) {
    EXPECT_EQ(p.rhythm, Rhythm::minus);
    EXPECT_NEAR(p.slopes.at(0), -1, 1e-4);
    EXPECT_NEAR(p.lcg.slope, -1, 1e-6);
    EXPECT_NEAR(p.lddc.gradient, -1, 0.1);
    EXPECT_EQ(p.impression, "sharp, forceful, accelerating");
    EXPECT_GT(p.volume, 0);
  }
  EXPECT_EQ(result->monotone.value, MonotoneAnswer::Value::undecided);
}

TEST(Analyze, MonotoneComesFromTheCertificate) {
  AnalyzeOptions options;
  options.certify = [] { return MonotoneAnswer{MonotoneAnswer::Value::yes, 0}; };
  EXPECT_EQ(analyze(testing::clothoid(0, 1, 1), options)->monotone.value,
            MonotoneAnswer::Value::yes);
  const curve::Bezier2 parabola{{{-1, 1}, {0, -1}, {1, 1}}, {}};
  const auto result = analyze(parabola);
  EXPECT_EQ(result->monotone.value, MonotoneAnswer::Value::no);
  EXPECT_NEAR(result->monotone.witness, 0.5, 1e-9);
}

TEST(Analyze, LineArcLine) {
  const auto result = analyze(testing::arcs({0, 2, 0}, {1, 2, 3}));
  ASSERT_TRUE(result);
  ASSERT_EQ(result->pieces.size(), 3u);
  EXPECT_EQ(result->pieces[0].rhythm, Rhythm::straight);
  EXPECT_EQ(result->pieces[1].rhythm, Rhythm::arc);
  EXPECT_EQ(result->pieces[2].rhythm, Rhythm::straight);
}

TEST(Analyze, CubicSplineWithKinkedCurvature) {
  curve::BSpline2 spline{3,
                         {0, 0, 0, 0, 0.3, 0.6, 0.6, 1, 1, 1, 1},
                         {{0, 0}, {1, 0.1}, {2, 0.5}, {3, 1.2}, {3.5, 2}, {3.8, 3}, {3.9, 4}},
                         {}};
  const auto result = analyze(spline);
  ASSERT_TRUE(result);
  double sum = 0;
  for (const PieceAnalysis& p : result->pieces) sum += p.length;
  EXPECT_NEAR(sum, result->length, 1e-9);
  for (const MonotonePiece& p : result->split.pieces) {
    double before = 0;
    double way = 0;
    for (int i = 0; i <= 50; ++i) {
      const double t = p.t.low + (p.t.high - p.t.low) * (0.01 + 0.98 * i / 50);
      const double kappa = curve::curvature(jet(spline, t));
      if (i > 1) {
        EXPECT_GE((kappa - before) * way, -1e-9);
      }
      if (i > 0) way = kappa - before;
      before = kappa;
    }
  }
}

// A clothoid from -1 to 3 has two pieces of monotone curvature (its radius falls, then grows).
TEST(Analyze, AsksBeforeEveryPieceWhetherToGoOn) {
  const auto c = testing::clothoid(-1, 3, 2);
  AnalyzeOptions options;
  options.progress.cancellation = core::CancellationToken::make();
  std::vector<double> told;
  options.progress.sink = [&](double fraction, std::string_view) { told.push_back(fraction); };
  ASSERT_TRUE(analyze(c, options));
  EXPECT_EQ(told, (std::vector<double>{0, 0.5}));
  options.progress.sink = [&](double, std::string_view) {
    options.progress.cancellation.request_stop();
  };
  const auto stopped = analyze(c, options);
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, core::ErrorCode::cancelled);
}

TEST(Analyze, RefusesCurvesWithoutLengthOrNumbers) {
  EXPECT_FALSE(analyze(curve::Bezier2{{{1, 1}, {1, 1}, {1, 1}}, {}}));
  EXPECT_FALSE(analyze(curve::Bezier2{{{0, 0}, {std::nan(""), 1}, {1, 1}}, {}}));
  EXPECT_FALSE(analyze(curve::Bezier2{{{0, 0}, {INFINITY, 1}, {1, 1}}, {}}));
}

// A curve of any size a double holds is the small one made larger.
TEST(Analyze, HugeCurvesAreSmallOnesMadeLarger) {
  const auto small = analyze(curve::Bezier2{{{0, 0}, {1, 1}, {2, 0.1}}, {}});
  const auto huge = analyze(curve::Bezier2{{{0, 0}, {1e150, 1e150}, {2e150, 1e149}}, {}});
  ASSERT_TRUE(small && huge);
  EXPECT_NEAR(huge->length / 1e150, small->length, 1e-9 * small->length);
  EXPECT_EQ(huge->pieces.size(), small->pieces.size());
}

core::Point2 moved(core::Point2 p, double angle, double scale) {
  const core::Vector2 v = scale * core::rotate_ccw({p.x, p.y}, angle);
  return {v.x + 11, v.y - 7};
}

TEST(Analyze, PropertyPoseSizeAndDirectionDoNotMatter) {
  const bool ok = rc::check("cubic analysed anywhere", [] {
    std::vector<core::Point2> control;
    for (int i = 0; i < 4; ++i) {
      const int y = *rc::gen::inRange(-300, 300);
      const int dx = *rc::gen::inRange(-40, 40);
      control.push_back({static_cast<double>(i) + dx / 100.0, y / 100.0});
    }
    const double angle = *rc::gen::inRange(0, 628) / 100.0;
    const double scale = std::pow(10.0, *rc::gen::inRange(-3, 4));
    const bool reverse = *rc::gen::arbitrary<bool>();
    const curve::Bezier2 c{control, {}};
    curve::Bezier2 d = c;
    for (core::Point2& p : d.control) p = moved(p, angle, scale);
    if (reverse) std::ranges::reverse(d.control);
    const Split a = split_monotone(c, {.noise = 1e-4});
    const Split b = split_monotone(d, {.noise = 1e-4 * scale});
    // A wave or lobe within one part in 1e6 of the threshold may go either way.
    for (const MergedWave& w : a.merged) RC_PRE(std::abs(w.displacement - 1e-4) > 1e-7);
    RC_ASSERT(a.pieces.size() == b.pieces.size());
    for (std::size_t i = 0; i < a.pieces.size(); ++i) {
      const MonotonePiece& p = b.pieces[reverse ? b.pieces.size() - 1 - i : i];
      const double low = reverse ? 1 - p.t.high : p.t.low;
      RC_ASSERT(std::abs(a.pieces[i].t.low - low) < 1e-6);
    }
    RC_ASSERT(std::abs(a.pieces.back().arc_length.high * scale - b.pieces.back().arc_length.high) <
              1e-9 * scale * 100);
  });
  EXPECT_TRUE(ok);
}

TEST(Analyze, NoiseGivesFewerPieces) {
  const auto c = testing::wavy(1, 3, 0.5, 0.1, 1);
  AnalyzeOptions options;
  options.noise = 2e-4;
  const auto result = analyze(c, options);
  ASSERT_TRUE(result);
  ASSERT_EQ(result->pieces.size(), 1u);
  EXPECT_EQ(result->split.threshold, 2e-4);
  EXPECT_FALSE(result->split.merged.empty());
}

}  // namespace
}  // namespace keyline::analysis
