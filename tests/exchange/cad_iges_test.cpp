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
