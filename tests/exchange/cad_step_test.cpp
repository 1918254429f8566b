#include <cmath>
#include <numbers>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "keyline/document/document.h"

#include "cad_fixture.h"
#include "step_text.h"

/// What the entities of a STEP file mean, by ISO 10303-42.
namespace keyline::exchange {
namespace {

using core::Point2;
using core::Point3;
using core::Vector3;
using document::Document;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class CadStep : public CadTest {
 protected:
  Document read(const std::string& curves, const std::string& body) const {
    return read_sound("d.step", step_curves(curves, body));
  }
};

std::string direction_text(Vector3 d) {
  return "DIRECTION('',(" + digits_of(d.x) + ',' + digits_of(d.y) + ',' + digits_of(d.z) + "));\n";
}

Point3 end_of(const Document& d, double t) {
  if (!d.space_curves.empty()) return evaluate(d.space_curves[0].curve, t);
  const Point2 p = d.paths.empty() ? Point2{NAN, NAN} : evaluate(d.paths[0].path, t);
  return {p.x, p.y, 0};
}

// build_axes and first_proj_axis: x is what (1, 0, 0) has across z, (0, 1, 0) where z is along it.
TEST_F(CadStep, PlacementsWithoutDirectionsHaveThoseOfTheStandard) {
  struct Case {
    const char* what;
    Vector3 axis;
    Vector3 x;  ///< by hand
  };
  const double half = std::numbers::sqrt2 / 2;
  for (const Case& c : {Case{"z", {0, 0, 1}, {1, 0, 0}},
                        {"-z", {0, 0, -2}, {1, 0, 0}},
                        {"y", {0, 3, 0}, {1, 0, 0}},
                        {"x", {1, 0, 0}, {0, 1, 0}},
                        {"-x", {-1, 0, 0}, {0, 1, 0}},
                        {"between x and z", {1, 0, 1}, {half, 0, -half}},
                        {"next to x", {1, 1e-9, 0}, {1e-9, -1, 0}}}) {
    SCOPED_TRACE(c.what);
    const Document d = read("#21",
                            "#22=CIRCLE('',#23,2.);\n#23=AXIS2_PLACEMENT_3D('',#15,#24,$);\n"
                            "#24=" +
                                direction_text(c.axis) + trimmed_text(21, "#22", 0, 1));
    EXPECT_LT(distance(end_of(d, 0), Point3{} + 2 * c.x), 1e-12);
    const Vector3 y = cross(c.axis / norm(c.axis), c.x);
    EXPECT_LT(distance(end_of(d, 1), Point3{} + 2 * std::cos(1.) * c.x + 2 * std::sin(1.) * y),
              1e-12);
  }
}

TEST_F(CadStep, PlacementsWithoutAnAxisStandUpright) {
  for (const auto& [reference, x] : {std::pair{"#16", Point3{0, 2, 0}}, {"$", {2, 0, 0}}}) {
    const Document d =
        read("#21", "#22=CIRCLE('',#23,2.);\n#23=AXIS2_PLACEMENT_3D('',#15,$," +
                        std::string(reference) + ");\n" + trimmed_text(21, "#22", 0, 1));
    EXPECT_LT(distance(end_of(d, 0), x), 1e-12) << reference;
  }
}

TEST_F(CadStep, MappedThingsStandWhereTheirPlacementHasThem) {
  const Document d = read_sound(
      "d.step",
      step_file("SHAPE", "#20",
                "#20=MAPPED_ITEM('',#21,#22);\n#21=REPRESENTATION_MAP(#14,#25);\n"
                "#22=AXIS2_PLACEMENT_3D('',#23,#16,$);\n#23=CARTESIAN_POINT('',(10.,0.,0.));\n"
                "#25=GEOMETRICALLY_BOUNDED_WIREFRAME_SHAPE_REPRESENTATION('',(#26,#14),#4);\n"
                "#26=GEOMETRIC_CURVE_SET('',(#27));\n#28=LINE('',#15,#29);\n"
                "#29=VECTOR('',#19,1.);\n" +
                    trimmed_text(27, "#28", 0, 5)));
  EXPECT_LT(distance(end_of(d, 0), {10, 0, 0}), 1e-12);
  EXPECT_LT(distance(end_of(d, 1), {15, 0, 0}), 1e-12);
}

// A parabola is C + f (u^2 x + 2 u y): here f = 2, C = (1, 2), x along (0.6, 0.8).
class Parabola : public CadStep {
 protected:
  Document trimmed(const std::string& first, const std::string& last,
                   const std::string& rest) const {
    return read("#21", "#21=TRIMMED_CURVE('',#22,(" + first + "),(" + last + ")," + rest +
                           ");\n#22=PARABOLA('',#23,2.);\n#23=AXIS2_PLACEMENT_3D('',#24,#18,#25);\n"
                           "#24=CARTESIAN_POINT('',(1.,2.,0.));\n#25=DIRECTION('',(0.6,0.8,0.));\n"
                           "#26=CARTESIAN_POINT('',(5.4,1.2,0.));\n"
                           "#27=CARTESIAN_POINT('',(-1.1,9.2,0.));\n");
  }
  static constexpr Point3 kFirst{5.4, 1.2, 0};  // u = -1
  static constexpr Point3 kLast{-1.1, 9.2, 0};  // u = 1.5
};

TEST_F(Parabola, IsTrimmedByItsOwnParameter) {
  const std::string first = "PARAMETER_VALUE(-1.)", last = "PARAMETER_VALUE(1.5)";
  for (const char* master : {".PARAMETER.", ".UNSPECIFIED."}) {
    const Document d = trimmed(first, last, ".T.," + std::string(master));
    EXPECT_LT(distance(end_of(d, 0), kFirst), 1e-12) << master;
    EXPECT_LT(distance(end_of(d, 1), kLast), 1e-12) << master;
    ASSERT_EQ(d.paths.size(), 1U);
    // Where u = 0.25, half way in a parameter that is linear in u.
    const Point2 middle = evaluate(d.paths[0].path, 0.5);
    EXPECT_LT(distance(middle, {1 + 0.6 * 0.125 - 0.8, 2 + 0.8 * 0.125 + 0.6}), 1e-12) << master;
  }
  const Document back = trimmed(last, first, ".F.,.PARAMETER.");
  EXPECT_LT(distance(end_of(back, 0), kLast), 1e-12);
  EXPECT_LT(distance(end_of(back, 1), kFirst), 1e-12);
}

TEST_F(Parabola, PointsAtItsEndsCountWhereTheyAreGiven) {
  for (const char* wrong : {"", ",PARAMETER_VALUE(0.)"}) {
    const Document d = trimmed("#26" + std::string(wrong), "#27", ".T.,.PARAMETER.");
    EXPECT_LT(distance(end_of(d, 0), kFirst), 1e-12) << wrong;
    EXPECT_LT(distance(end_of(d, 1), kLast), 1e-12) << wrong;
  }
}

// In a unit that becomes millimetres: f and its points alike.
TEST_F(Parabola, MayBeInAnyUnit) {
  std::string text =
      step_curves("#21", "#22=PARABOLA('',#14,2000.);\n" + trimmed_text(21, "#22", 0, 1.5));
  const std::string milli = ".MILLI.";
  text.replace(text.find(milli), milli.size(), ".MICRO.");
  const Document d = read_sound("d.step", text);
  ASSERT_EQ(d.unit, "mm");
  EXPECT_LT(distance(end_of(d, 1), {4.5, 6, 0}), 1e-12);
}

TEST_F(CadStep, UnboundedLinesAreToldAndTheOthersRead) {
  const Document d =
      read("#21,#22", "#21=LINE('',#15,#23);\n#23=VECTOR('',#19,1.);\n" +
                          trimmed_text(22, "#24", 0, 1) + "#24=CIRCLE('',#14,2.);\n");
  EXPECT_EQ(d.paths.size(), 1U);
  EXPECT_THAT(d.skipped, ElementsAre(HasSubstr("an unbounded curve")));
}

/// Two lines, #21 and #22, the first of them green by #30.
std::string styled_lines(const std::string& more) {
  return step_curves("#21,#22", trimmed_text(21, "#23", 0, 5) + trimmed_text(22, "#23", 7, 9) +
                                    "#23=LINE('',#15,#24);\n#24=VECTOR('',#19,1.);\n"
                                    "#30=STYLED_ITEM('',(#31),#21);\n"
                                    "#31=PRESENTATION_STYLE_ASSIGNMENT((#32));\n"
                                    "#32=CURVE_STYLE('',#33,POSITIVE_LENGTH_MEASURE(0.1),#34);\n"
                                    "#33=DRAUGHTING_PRE_DEFINED_CURVE_FONT('continuous');\n"
                                    "#34=DRAUGHTING_PRE_DEFINED_COLOUR('green');\n" +
                                    more);
}

const std::string kShown =
    "#35=MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION('',(#30),#4);\n";

// ISO 10303-46, invisibility: of a style, of all of a presentation, of a layer.
TEST_F(CadStep, WhatIsNotToBeSeenIsReadAndTold) {
  const std::string layer = "#40=PRESENTATION_LAYER_ASSIGNMENT('aids','',(#21,#22));\n";
  const auto told = [&](const std::string& items) {
    const Document d =
        read_sound("d.step", styled_lines(kShown + layer + "#41=INVISIBILITY((" + items + "));\n"));
    EXPECT_EQ(d.paths.size(), 2U);
    return d.skipped;
  };
  EXPECT_THAT(told("#30"), ElementsAre("nothing, but not to be seen: 1 entity"));
  EXPECT_THAT(told("#35"), ElementsAre("nothing, but not to be seen: 1 entity"));
  EXPECT_THAT(told("#40"), ElementsAre("nothing, but not to be seen: layer aids, 2 entities"));
  EXPECT_THAT(told("#30,#40"), ElementsAre("nothing, but not to be seen: 1 entity",
                                           "nothing, but not to be seen: layer aids, 2 entities"));
  EXPECT_THAT(read_sound("d.step", styled_lines(kShown + layer)).skipped, IsEmpty());
}

// ISO 10303-46, over_riding_styled_item: wherever it stands, and over another one.
TEST_F(CadStep, AStyleThatGoesOverAnotherCounts) {
  const auto style = [](int n, const std::string& over, const std::string& color) {
    const auto id = [n](int k) { return '#' + std::to_string(n + k); };
    return id(0) + "=OVER_RIDING_STYLED_ITEM('',(" + id(1) + "),#21," + over + ");\n" + id(1) +
           "=PRESENTATION_STYLE_ASSIGNMENT((" + id(2) + "));\n" + id(2) +
           "=CURVE_STYLE('',#33,POSITIVE_LENGTH_MEASURE(0.1)," + id(3) + ");\n" + id(3) +
           "=DRAUGHTING_PRE_DEFINED_COLOUR('" + color + "');\n";
  };
  const std::string red = style(50, "#30", "red"), blue = style(60, "#50", "blue");
  const auto shown = [](const std::string& items) {
    return "#35=MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION('',(" + items + "),#4);\n";
  };
  const auto color = [&](const std::string& more) {
    const Document d = read_sound("d.step", styled_lines(more));
    EXPECT_EQ(d.paths.size(), 2U);
    return d.paths.empty() ? std::string() : d.paths[0].label.color;
  };
  EXPECT_EQ(color(kShown), "#00ff00");
  EXPECT_EQ(color(red + kShown), "#ff0000");
  EXPECT_EQ(color(red + shown("#30,#50")), "#ff0000");
  EXPECT_EQ(color(red + blue + shown("#30,#50,#60")), "#0000ff");
}

}  // namespace
}  // namespace keyline::exchange
