#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "keyline/document/document.h"

#include "cad_fixture.h"
#include "iges_text.h"

/// What the directory of an IGES file tells of its entities, by IGES 5.3.
namespace keyline::exchange {
namespace {

using document::Document;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class CadIges : public CadTest {
 protected:
  Document read(const std::vector<IgesEntity>& entities, int unit = 2) const {
    return read_sound("d.iges", iges_file(entities, unit));
  }
};

const std::string kLine = "110,0,0,0,4,3,0";

// 2.2.4.4.13, table 4; 4.77: red, green and blue in percent.
TEST_F(CadIges, ColoursAreNumbersOrDefined) {
  const char* const colors[] = {"",        "#000000", "#ff0000", "#00ff00", "#0000ff",
                                "#ffff00", "#ff00ff", "#00ffff", "#ffffff"};
  std::vector<IgesEntity> lines;
  for (int k = 0; k <= 8; ++k) lines.push_back({.parameters = kLine, .color = k});
  lines.push_back({.parameters = kLine, .color = -21});
  lines.push_back({.parameters = "314,20.,60.,100.", .status = "00000200"});
  const Document d = read(lines);
  ASSERT_EQ(d.paths.size(), 10U);
  for (std::size_t k = 0; k <= 8; ++k) EXPECT_EQ(d.paths[k].label.color, colors[k]) << k;
  EXPECT_EQ(d.paths[9].label.color, "#3399ff");  // 0.2, 0.6 and 1 of 255
}

// 2.2.4.4.5 and 4.99: a level by its number, or the name that a level function on it gives.
TEST_F(CadIges, LevelsAreNamedOrNumbers) {
  std::vector<IgesEntity> lines;
  for (const int level : {0, 1, 2, 5, 6}) lines.push_back({.parameters = kLine, .level = level});
  lines.push_back({.parameters = "406,2,0,4Hbody", .level = 5, .form = 3, .status = "00010000"});
  const Document d = read(lines);
  std::vector<std::string> layers;
  for (const auto& path : d.paths) layers.push_back(path.label.layer);
  EXPECT_THAT(layers, ElementsAre("", "1", "2", "body", "6"));
}

// 2.2.4.4.18: up to eight letters, and a number where several have the same.
TEST_F(CadIges, LabelsAreNames) {
  const Document d = read({{.parameters = kLine, .label = "ROOF"},
                           {.parameters = kLine, .label = "SILL", .subscript = "7"},
                           {.parameters = kLine},
                           {.parameters = kLine + ",0,1,9", .label = "LABEL"},
                           {.parameters = "406,1,9H the arch", .form = 15, .status = "00010000"}});
  std::vector<std::string> names;
  for (const auto& path : d.paths) names.push_back(path.label.name);
  EXPECT_THAT(names, ElementsAre("ROOF", "SILL(7)", "", "the arch"));
}

// 2.2.4.3.14, table 3, with lengths as defined: the statute mile, thousandths of an inch,
// micrometres and millionths of an inch are no units here and come in mm.
TEST_F(CadIges, UnitsAreThoseOfTheFlag) {
  struct Case {
    int flag;
    const char* unit;
    double length;  ///< of one of the file's
  };
  for (const Case& c : {Case{1, "in", 1},
                        {2, "mm", 1},
                        {4, "ft", 1},
                        {5, "mm", 1609344},
                        {6, "m", 1},
                        {7, "km", 1},
                        {8, "mm", 0.0254},
                        {9, "mm", 1e-3},
                        {10, "cm", 1},
                        {11, "mm", 2.54e-5}}) {
    SCOPED_TRACE(c.flag);
    const Document d = read({{.parameters = "110,0,0,0,1000.,0,0"}}, c.flag);
    ASSERT_EQ(d.paths.size(), 1U);
    EXPECT_EQ(d.unit, c.unit);
    EXPECT_NEAR(evaluate(d.paths[0].path, 1).x / (1000 * c.length), 1, 1e-12);
  }
}

// 2.2.4.3.15: with flag 3 the unit is the one that is named, by the names of table 3.
TEST_F(CadIges, UnitsAreThoseOfTheNameWhereTheFlagSaysSo) {
  struct Case {
    const char* name;
    const char* unit;
    double length;
  };
  const std::vector<IgesEntity> line{{.parameters = "110,0,0,0,1000.,0,0"}};
  for (const Case& c : {Case{"IN", "in", 1},
                        {"INCH", "in", 1},
                        {"MM", "mm", 1},
                        {"FT", "ft", 1},
                        {"MI", "mm", 1609344},
                        {"M", "m", 1},
                        {"KM", "km", 1},
                        {"MIL", "mm", 0.0254},
                        {"UM", "mm", 1e-3},
                        {"CM", "cm", 1},
                        {"UIN", "mm", 2.54e-5}}) {
    SCOPED_TRACE(c.name);
    const Document d = read_sound("d.iges", iges_file(line, 3, c.name));
    ASSERT_EQ(d.paths.size(), 1U);
    EXPECT_EQ(d.unit, c.unit);
    EXPECT_NEAR(evaluate(d.paths[0].path, 1).x / (1000 * c.length), 1, 1e-12);
    EXPECT_THAT(d.skipped, IsEmpty());
  }
  const Document d = read_sound("d.iges", iges_file(line, 3, "ELL"));
  EXPECT_EQ(d.unit, "mm");
  EXPECT_THAT(d.skipped, ElementsAre(HasSubstr("the unit \"ELL\", which IGES does not know")));
  EXPECT_EQ(read_sound("d.iges", iges_file(line, 2, "IN")).unit, "mm");  // else the flag counts
}

// 4.74 and 4.78: an instance of a subfigure lies moved; one that is scaled is not read, and told.
TEST_F(CadIges, ScaledInstancesAreTold) {
  const auto with = [this](const std::string& scale) {
    return read({{.parameters = kLine},
                 {.parameters = kLine, .status = "00010000"},
                 {.parameters = "308,0,4Hpart,1,3", .status = "00000200"},
                 {.parameters = "408,5,10.,20.,0.," + scale}});
  };
  const Document moved = with("1.");
  ASSERT_EQ(moved.paths.size(), 2U);
  EXPECT_LT(distance(evaluate(moved.paths[1].path, 1), {14, 23}), 1e-12);
  EXPECT_THAT(moved.skipped, IsEmpty());
  const Document scaled = with("2.");
  EXPECT_EQ(scaled.paths.size(), 1U);
  EXPECT_THAT(scaled.skipped, ElementsAre(HasSubstr("408): scaled instances are not read")));
}

// 2.2.4.4.9: blanked entities, and the uses of entities; of a part of another that one counts.
TEST_F(CadIges, WhatIsNotToBeSeenOrBesideTheDrawingIsTold) {
  const auto told = [this](const std::string& status) {
    return read({{.parameters = kLine}, {.parameters = kLine, .status = status}}).skipped;
  };
  EXPECT_THAT(told("00000000"), IsEmpty());
  EXPECT_THAT(told("01000000"), ElementsAre("nothing, but not to be seen: 1 entity"));
  EXPECT_THAT(told("00000100"), ElementsAre("nothing, but annotation: 1 entity"));
  EXPECT_THAT(told("00000600"), ElementsAre("nothing, but for construction alone: 1 entity"));
  const Document chain = read({{.parameters = "102,2,3,5", .status = "01000000"},
                               {.parameters = kLine, .status = "01010000"},
                               {.parameters = "110,4,3,0,8,0,0", .status = "01010000"}});
  EXPECT_EQ(chain.paths.size(), 1U);
  EXPECT_THAT(chain.skipped, ElementsAre("nothing, but not to be seen: 1 entity"));
}

TEST_F(CadIges, CurvesInParametersOfSurfacesAreNowhereInSpace) {
  const Document d = read(
      {{.parameters = kLine, .label = "IN SPACE"}, {.parameters = kLine, .status = "00000500"}});
  ASSERT_EQ(d.paths.size(), 1U);
  EXPECT_EQ(d.paths[0].label.name, "IN SPACE");
  EXPECT_THAT(d.skipped, ElementsAre("1 curve in the parameters of a surface"));
}

// 4.13: a line from one point through another on and on, and one through both to either side.
TEST_F(CadIges, LinesWithoutEndAreTold) {
  const Document d = read(
      {{.parameters = kLine, .form = 1}, {.parameters = kLine, .form = 2}, {.parameters = kLine}});
  EXPECT_EQ(d.paths.size(), 3U);
  EXPECT_THAT(d.skipped, ElementsAre("what lies beyond the two points of 2 lines without end"));
}

// 4.24: a bilinear square; the last four numbers are its range.
TEST_F(CadIges, PartsOfSurfacesAreTold) {
  const auto told = [this](const std::string& range) {
    const Document d = read({{.parameters = "128,1,1,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,"
                                            "1.,1.,1.,1.,0.,0.,0.,1.,0.,0.,0.,1.,0.,1.,1.,1.," +
                                            range}});
    EXPECT_EQ(d.surfaces.size(), 1U);
    return d.skipped;
  };
  EXPECT_THAT(told("0.,1.,0.,1."), IsEmpty());
  for (const char* part : {"0.5,1.,0.,1.", "0.,0.5,0.,1.", "0.,1.,0.5,1.", "0.,1.,0.,0.5"})
    EXPECT_THAT(told(part), ElementsAre("the range of 1 surface: all that the knots span is here"))
        << part;
}

// 4.21: a matrix turns, moves or mirrors; six digits are a turn.
TEST_F(CadIges, MatricesThatScaleAreTold) {
  const auto told = [this](const std::string& matrix) {
    return read({{.parameters = "100,0.,1.,2.,4.,2.,1.,5.", .matrix = 3},
                 {.parameters = "124," + matrix}})
        .skipped;
  };
  EXPECT_THAT(told("0.707107,-0.707107,0.,1.,0.707107,0.707107,0.,0.,0.,0.,1.,0."), IsEmpty());
  EXPECT_THAT(told("-1.,0.,0.,1.,0.,1.,0.,0.,0.,0.,1.,0."), IsEmpty());
  for (const char* matrix :
       {"2.,0.,0.,0.,0.,2.,0.,0.,0.,0.,2.,0.", "1.,0.1,0.,0.,0.,1.,0.,0.,0.,0.,1.,0."})
    EXPECT_THAT(told(matrix), ElementsAre(HasSubstr("1 matrix that scales or distorts"))) << matrix;
}

// 2.2.4.3.13: the lengths of the model are so many times those of the thing.
TEST_F(CadIges, TheScaleOfTheModelIsTold) {
  std::string text = iges_file({{.parameters = kLine}});
  text.replace(text.find(",1.,2,"), 6, ",.5,2,");
  EXPECT_THAT(read_sound("d.iges", text).skipped,
              ElementsAre("the scale of the model, 0.5: lengths are those of the model"));
}

// 4.23: a spline stays one, whatever the knots within it are.
TEST_F(CadIges, SplinesOfSharpTurnsStayWhole) {
  // By hand: two parabolas that meet at (2, 1, 1) in an angle; the last but five numbers are
  // points.
  const Document d = read({{.parameters = "126,4,2,0,0,1,0,0.,0.,0.,1.,1.,2.,2.,2.,1.,1.,1.,1.,1.,"
                                          "0.,0.,0.,1.,0.,0.,2.,1.,1.,1.,2.,3.,0.,4.,4.,0.,2.,0.,"
                                          "0.,0."}});
  ASSERT_EQ(d.paths.size() + d.space_curves.size(), 1U);
  ASSERT_EQ(d.space_curves.size(), 1U);
  EXPECT_LT(distance(evaluate(d.space_curves[0].curve, 0.5), {2, 1, 1}), 1e-12);
  EXPECT_LT(distance(evaluate(d.space_curves[0].curve, 0.25), {1, 0.25, 0.25}), 1e-12);
  EXPECT_LT(distance(evaluate(d.space_curves[0].curve, 0.75), {1, 2.25, 2.75}), 1e-12);
}

}  // namespace
}  // namespace keyline::exchange
