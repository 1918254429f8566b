#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "keyline/document/document.h"
#include "keyline/exchange/document_file.h"

#include "cad_fixture.h"

/// What stands in the STEP and IGES files written, by their standards, and comes back of it.
namespace keyline::exchange {
namespace {

using document::Document;
using testing::HasSubstr;
using testing::Not;

class CadText : public CadTest {
 protected:
  static std::string text_of(const Document& d, const char* extension) {
    const auto written = format_document(d, extension);
    return written ? written->content : written.error().message;
  }

  Document read_back(const Document& d, const std::string& name) const {
    EXPECT_TRUE(write_document(d, folder_ / name));
    return read_document(folder_ / name).value_or(Document{});
  }
};

const curve::Bezier2 kArch{{{0, 0}, {10, 12.5}, {30, 0.25}, {40, 20}}, {}};

void add_arch(Document& d, const document::Label& label) {
  d.paths.push_back({label, {{{kArch}}, false}, 0});
}

void add_patch(Document& d, const document::Label& label) {
  surface::BSplineSurface s{{1, 1}, {{{0, 0, 1, 1}, {0, 0, 1, 1}}}, {2, 2, {}}, {}};
  s.net.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1}};
  d.surfaces.push_back({label, s, 0});
}

std::size_t count_of(std::string_view part, std::string_view text) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++count;
  return count;
}

// A curve without a name is read back without one.
TEST_F(CadText, WhatHasNoNameGetsNone) {
  Document d;
  d.unit = "mm";
  add_arch(d, {});
  d.paths.push_back(
      {{},
       {{{curve::Bezier2{{{0, 0}, {4, 0}}, {}}}, {curve::Bezier2{{{4, 0}, {4, 3}}, {}}}}, false},
       0});
  d.space_curves.push_back({{}, {curve::Bezier3{{{0, 0, 0}, {1, 2, 3}, {4, 4, 5}}, {}}}});
  for (const char* name : {"a.step", "a.iges"}) {
    SCOPED_TRACE(name);
    const Document read = read_back(d, name);
    ASSERT_EQ(read.paths.size(), 2U);
    ASSERT_EQ(read.space_curves.size(), 1U);
    for (const auto& path : read.paths) EXPECT_EQ(path.label.name, "");
    EXPECT_EQ(read.space_curves[0].label.name, "");
  }
  EXPECT_THAT(text_of(d, ".step"), HasSubstr("PRODUCT('','','',"));
}

// ISO 10303-42, composite_curve: the transition at the last segment's end is discontinuous where
// the curve is open.
TEST_F(CadText, CompositeCurvesEndOpenOrGoOn) {
  for (const bool closed : {false, true}) {
    Document d;
    d.unit = "mm";
    const auto line = [](core::Point2 a, core::Point2 b) {
      return document::PlanarCurve{curve::Bezier2{{a, b}, {}}};
    };
    document::Path path{{line({0, 0}, {4, 0}), line({4, 0}, {4, 3})}, closed};
    if (closed) path.curves.push_back(line({4, 3}, {0, 0}));
    d.paths.push_back({{"a", "", ""}, path, 0});
    const std::string text = text_of(d, ".step");
    EXPECT_EQ(count_of("COMPOSITE_CURVE_SEGMENT(.CONTINUOUS.", text), closed ? 3U : 1U);
    EXPECT_EQ(count_of("COMPOSITE_CURVE_SEGMENT(.DISCONTINUOUS.", text), closed ? 0U : 1U);
  }
}

// ISO 10303-46: curves have the colour of a curve style, faces that of a surface style; names are
// those of products and items, on one line however long (ISO 10303-21, 6.4.3: \X2\ up to U+FFFF).
TEST_F(CadText, StepNamesAndColoursAreWhereTheyBelong) {
  Document curve, patch;
  curve.unit = patch.unit = "mm";
  add_arch(curve, {"\u93e1", "", "#336699"});
  add_patch(patch, {"hood", "", "#336699"});
  EXPECT_THAT(text_of(curve, ".step"), HasSubstr("CURVE_STYLE("));
  EXPECT_THAT(text_of(curve, ".step"), Not(HasSubstr("SURFACE_STYLE_USAGE(")));
  EXPECT_THAT(text_of(patch, ".step"), HasSubstr("SURFACE_STYLE_USAGE("));
  EXPECT_THAT(text_of(patch, ".step"), Not(HasSubstr(" CURVE_STYLE(")));
  EXPECT_THAT(text_of(patch, ".step"), HasSubstr("PRODUCT('hood','hood',"));
  EXPECT_THAT(text_of(curve, ".step"), HasSubstr("PRODUCT('\\X2\\93E1\\X0\\','\\X2\\93E1\\X0\\',"));
  patch.surfaces[0].label.name = std::string(200, 'x');
  EXPECT_THAT(text_of(patch, ".step"), HasSubstr("'" + patch.surfaces[0].label.name + "'"));
}

// IGES 5.3, 2.2.4.4.5: levels are numbers. A layer that is one keeps it and needs no name (type
// 406, form 3); others, "007" and "0" among them, get names, each a number of its own.
TEST_F(CadText, IgesLevelsAreTheLayers) {
  Document d;
  d.unit = "mm";
  const std::vector<std::string> layers{"body", "1", "0", "007", "1000", "1001", "-3", "body", "7"};
  for (const std::string& layer : layers) add_arch(d, {"a", layer, ""});
  const Document read = read_back(d, "a.iges");
  std::vector<std::string> back;
  for (const auto& path : read.paths) back.push_back(path.label.layer);
  EXPECT_EQ(back, layers);
  Document numbers;
  numbers.unit = "mm";
  add_arch(numbers, {"", "7", ""});
  add_arch(numbers, {"", "1000", ""});
  EXPECT_THAT(text_of(numbers, ".iges"), Not(HasSubstr("1H7;")));
  EXPECT_THAT(text_of(numbers, ".iges"), Not(HasSubstr("4H1000;")));
  EXPECT_THAT(text_of(d, ".iges"), HasSubstr("4Hbody;"));
}

// IGES 5.3, 4.21: level and colour are no fields of a matrix, such as an arc to the right has.
TEST_F(CadText, IgesMatricesHaveNeitherLevelNorColour) {
  Document d;
  d.unit = "mm";
  const lac::Chain arc{{{0, 0}, 1}, {{-1, 2, -0.7, -0.7}}, false};
  d.paths.push_back({{"a", "7", "#336699"}, {{{arc}}, false}, 0});
  const std::string text = text_of(d, ".iges");
  const std::size_t first = text.find("\n     124") + 1, second = text.find('\n', first) + 1;
  ASSERT_NE(first, 0U) << text;
  EXPECT_EQ(text.substr(first + 32, 8), "       0");
  EXPECT_EQ(text.substr(second + 16, 8), "       0");
}

// By hand: a parabola's middle, the corners of a polygon with a point twice, the ends of a
// quadratic spline with knots 0, 1 ... 5, midway between its control points.
TEST_F(CadText, SpaceCurvesComeBackAsTheyWere) {
  Document d;
  d.unit = "mm";
  d.space_curves.push_back({{}, {curve::Bezier3{{{0, 0, 0}, {1, 2, 3}, {4, 4, 5}}, {}}}});
  d.space_curves.push_back({{}, {curve::Polyline3{{{0, 0, 0}, {3, 4, 0}, {3, 4, 0}, {3, 4, 12}}}}});
  d.space_curves.push_back(
      {{}, {curve::BSpline3{2, {0, 1, 2, 3, 4, 5}, {{0, 0, 1}, {2, 0, 0}, {2, 2, 0}}, {}}}});
  for (const char* name : {"a.step", "a.iges"}) {
    SCOPED_TRACE(name);
    const Document read = read_back(d, name);
    ASSERT_EQ(read.space_curves.size(), 3U);
    const auto spline = [&](std::size_t i) {
      return std::get<curve::BSpline3>(read.space_curves[i].curve.value);
    };
    EXPECT_EQ(spline(0).knots, (std::vector<double>{0, 0, 0, 1, 1, 1}));
    EXPECT_LT(distance(evaluate(spline(0), 0.5), {1.5, 2, 2.75}), 1e-14);
    EXPECT_EQ(spline(1).control, (std::vector<core::Point3>{{0, 0, 0}, {3, 4, 0}, {3, 4, 12}}));
    EXPECT_EQ(spline(1).knots, (std::vector<double>{0, 0, 5, 17, 17}));
    EXPECT_LT(distance(spline(2).control.front(), {1, 0, 0.5}), 1e-14);
    EXPECT_LT(distance(spline(2).control.back(), {2, 1, 0}), 1e-14);
  }
}

// By hand: on a circle of radius 2 four radians to the right and to the left of (2, 0).
TEST_F(CadText, LinesAndArcsEndWhereTheyDid) {
  Document d;
  d.unit = "mm";
  const auto add = [&d](const document::PlanarCurve& c) {
    d.paths.push_back({{}, {{c}, false}, 0});
  };
  const double quarter = std::numbers::pi / 2;
  add({lac::Chain{{{2, 0}, -quarter}, {{-1, 8, -0.5, -0.5}}, false}});
  add({lac::Chain{{{2, 0}, quarter}, {{-1, 8, 0.5, 0.5}}, false}});
  add({curve::Bezier2{{{0, 0}, {12.5, 3.75}}, {}}});
  for (const char* name : {"a.step", "a.iges"}) {
    SCOPED_TRACE(name);
    const Document read = read_back(d, name);
    ASSERT_EQ(read.paths.size(), 3U);
    const core::Point2 right{2 * std::cos(4.0), -2 * std::sin(4.0)}, left{right.x, -right.y};
    EXPECT_LT(distance(evaluate(read.paths[0].path, 1), right), 1e-14);
    EXPECT_LT(distance(evaluate(read.paths[1].path, 1), left), 1e-14);
    EXPECT_LT(distance(evaluate(read.paths[2].path, 1), {12.5, 3.75}), 1e-14);
  }
}

// A file without a unit is in mm, whatever the numbers stand for.
TEST_F(CadText, NumbersWithoutAUnitStayWhatTheyAre) {
  Document d;
  add_arch(d, {"a", "", ""});
  for (const char* name : {"a.step", "a.iges"}) {
    const Document read = read_back(d, name);
    ASSERT_EQ(read.paths.size(), 1U) << name;
    EXPECT_EQ(evaluate(read.paths[0].path, 1), (core::Point2{40, 20})) << name;
  }
}

}  // namespace
}  // namespace keyline::exchange
