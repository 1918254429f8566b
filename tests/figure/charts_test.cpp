#include <cmath>

#include <gtest/gtest.h>

#include "keyline/core/angle.h"
#include "keyline/core/error.h"
#include "keyline/figure/curve_charts.h"
#include "keyline/figure/rhythm_charts.h"

#include "picture.h"

namespace keyline::figure {
namespace {

using core::Point2;

/// A clothoid through an inflection, in two pieces.
SampledCurve s_curve() {
  SampledCurve curve;
  curve.name = "chain <1>";
  Point2 p;
  constexpr int kSteps = 1000;
  for (int i = 0; i <= kSteps; ++i) {
    const double s = 100.0 * i / kSteps;
    const double theta = 0.0003 * s * s - 0.03 * s;
    curve.arc_length.push_back(s);
    curve.points.push_back(p);
    curve.tangent_angle.push_back(theta);
    curve.curvature.push_back(0.0006 * s - 0.03);
    p = p + (100.0 / kSteps) * core::unit_vector(theta);
  }
  curve.joints = {500};
  return curve;
}

int painted(const Drawing& drawing) {
  const auto png = write_png(drawing, 1);
  EXPECT_TRUE(png);
  return png ? Decoded(*png).count_other_than(0xFFFFFFU) : 0;
}

/// Every piece of text as it stands in the SVG.
bool shows(const Drawing& drawing, const std::string& text) {
  return write_svg(drawing).find(text) != std::string::npos;
}

TEST(CurvaturePlot, ShowsCurvesAndPieces) {
  SampledCurve wild = s_curve();
  wild.name = "spline";
  wild.joints.clear();
  wild.curvature[300] = 1e9;
  const Drawing d = curvature_plot({s_curve(), wild}, {.unit = "mm"});
  EXPECT_TRUE(shows(d, "chain &lt;1&gt;"));
  EXPECT_TRUE(shows(d, "Curvature [1/mm]"));
  EXPECT_TRUE(shows(d, ">0.02</text>"));  // the spike does not set the range
  EXPECT_GT(painted(d), 4000);
}

TEST(CurvatureComb, StatesTheLongestTooth) {
  const Drawing d = curvature_comb(s_curve(), {.unit = "mm"});
  EXPECT_TRUE(shows(d, "curvature 0.03 1/mm, radius 33.3\u00A0mm"));
  EXPECT_GT(painted(d), 4000);
}

TEST(CurvatureComb, TellsAStraightLine) {
  SampledCurve line;
  line.arc_length = {0, 1};
  line.points = {{0, 0}, {1, 0}};
  line.tangent_angle = {0, 0};
  line.curvature = {0, 0};
  EXPECT_TRUE(shows(curvature_comb(line), "straight"));
  EXPECT_GT(painted(evolute_chart(line)), 100);
  EXPECT_GT(painted(curvature_plot({line})), 100);
}

TEST(CurvatureComb, ShowsSmallBesideLarge) {
  SampledCurve nose = s_curve();
  for (std::size_t i = 0; i < nose.curvature.size(); ++i)
    nose.curvature[i] = 0.01 + (i == 700 ? 5 : 0);
  EXPECT_TRUE(shows(curvature_comb(nose), "square root of the curvature"));
  EXPECT_TRUE(shows(curvature_plot({nose}), "Square-root scale"));
  EXPECT_FALSE(shows(curvature_plot({s_curve()}), "Square-root scale"));
}

TEST(Evolute, BreaksAtTheInflection) {
  const Drawing d = evolute_chart(s_curve(), {.unit = "mm"});
  EXPECT_GT(painted(d), 1500);
  EXPECT_LE(d.height, 620);
}

TEST(Evolute, KeepsItsScaleNextToAnInflection) {
  const auto scale_bar = [](const Drawing& d) {
    return std::get<Label>(d.items.back().value).text;
  };
  SampledCurve curve = s_curve();
  const std::string before = scale_bar(evolute_chart(curve));
  curve.curvature[510] = 1e-22 * (curve.curvature[510] < 0 ? -1 : 1);
  EXPECT_EQ(scale_bar(evolute_chart(curve)), before);
}

TEST(Evolute, ReachesOutToWhereItBegins) {
  const auto arc = [](double radius) {
    SampledCurve curve;
    for (int i = 0; i <= 50; ++i) {
      const double angle = i / 50.0 / radius;
      curve.arc_length.push_back(i / 50.0);
      curve.points.push_back({radius * std::sin(angle), radius * (1 - std::cos(angle))});
      curve.tangent_angle.push_back(angle);
      curve.curvature.push_back(1 / (radius + 0.2 * i / 50.0));
    }
    return curve;
  };
  EXPECT_FALSE(shows(evolute_chart(arc(3)), "far outside"));
  EXPECT_GT(evolute_chart(arc(3)).height, 300);  // room for the centres above the flat arc
  EXPECT_TRUE(shows(evolute_chart(arc(30)), "far outside"));
}

TEST(Overlay, StatesDeviationAndExaggeration) {
  Overlay o;
  o.curve = s_curve();
  o.tolerance = 0.1;
  for (std::size_t i = 0; i <= 1000; i += 50) {
    o.feet.push_back(o.curve.points[i]);
    o.points.push_back(o.curve.points[i] + core::Vector2{0, i == 500 ? 0.2 : 0.05});
  }
  const Drawing d = overlay(o, {.unit = "mm"});
  EXPECT_TRUE(
      shows(d, "Largest deviation 0.2\u00A0mm, tolerance 0.1\u00A0mm; deviations drawn 20 times"));
  EXPECT_TRUE(shows(d, "beyond tolerance"));
  o.points.pop_back();
  EXPECT_THROW(overlay(o), core::InvalidInput);
  EXPECT_GT(painted(overlay(Overlay{})), 10);
}

TEST(CurveCharts, RejectBrokenStructsAndStandHostileValues) {
  SampledCurve curve = s_curve();
  curve.joints = {5000};
  EXPECT_THROW(curvature_comb(curve), core::InvalidInput);
  curve.joints = {};
  curve.curvature.pop_back();
  EXPECT_THROW(evolute_chart(curve), core::InvalidInput);
  curve = s_curve();
  for (std::size_t i = 0; i < curve.points.size(); i += 7) {
    curve.curvature[i] = i % 2 ? NAN : INFINITY;
    curve.points[i] = {NAN, 1e308};
    curve.tangent_angle[i] = 1e308;
  }
  EXPECT_GT(painted(curvature_comb(curve)), 100);
  EXPECT_GT(painted(evolute_chart(curve)), 100);
  EXPECT_GT(painted(curvature_plot({curve})), 100);
  EXPECT_GT(painted(curvature_comb(SampledCurve{})), 10);
  EXPECT_GT(painted(evolute_chart(SampledCurve{})), 10);
  EXPECT_GT(painted(curvature_plot({})), 10);
}

TEST(RhythmCharts, LabelTheirSlopes) {
  LcgPiece lcg{.name = "Piece 1", .variance = 1.5e-3};
  for (int i = 0; i < 50; ++i) lcg.points.push_back({0.02 * i, 1 - 0.02 * i});
  lcg.lines = {{0, 1, -1.0004, 1}};
  EXPECT_TRUE(shows(lcg_chart(lcg), "α = −1<"));
  EXPECT_TRUE(shows(lcg_chart(lcg), "variance 0.0015"));
  LddcPiece lddc{.name = "Piece 1", .bars = {{-1, -1.5}, {-0.95, -1.4}, {-0.9, -1.3}}};
  lddc.c_curve = lddc.bars;
  lddc.lines = {{-1, -0.9, 2, 0.5}};
  lddc.point_a = lddc.bars.front();
  lddc.point_b = lddc.bars.back();
  const Drawing d = lddc_chart(lddc);
  EXPECT_TRUE(shows(d, "slope = 2<"));
  EXPECT_TRUE(shows(d, ">A</text>"));
  EXPECT_TRUE(shows(d, ">B</text>"));
  EXPECT_GT(painted(d), 3000);
  EXPECT_GT(painted(lcg_chart({})), 100);
  EXPECT_GT(painted(lddc_chart({})), 100);
}

TEST(RhythmCharts, ABarOfNearlyAllTheLengthIsTheTallest) {
  const LddcPiece nearly_an_arc{.bars = {{-1, -0.02}, {-0.95, -1.3}}, .bin_width = 0.05};
  for (const Item& item : lddc_chart(nearly_an_arc).items) {
    const auto* shape = std::get_if<Shape>(&item.value);
    if (!shape || shape->fill != lighter(palette(0), 0.6) || shape->path.steps.size() < 10)
      continue;
    std::vector<double> tall;
    for (std::size_t i = 0; i + 2 < shape->path.steps.size(); i += 5)
      tall.push_back(
          std::abs(shape->path.steps[i + 2].point[2].y - shape->path.steps[i].point[2].y));
    ASSERT_EQ(tall.size(), 2U);
    EXPECT_GT(tall[0], 3 * tall[1]);  // -0.02 and -1.3 above -1.5 or so
    return;
  }
  FAIL() << "no bars";
}

}  // namespace
}  // namespace keyline::figure
