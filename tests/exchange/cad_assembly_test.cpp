#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "keyline/exchange/document_file.h"
#include "keyline/exchange/step/cad_file.h"
#include "keyline/lac/chain/chain.h"

#include "cad_fixture.h"
#include "tests/shared_data.h"

namespace keyline::exchange {
namespace {

namespace fs = std::filesystem;
using document::Document;

using CadAssembly = CadTest;

/// A text with every "@k" replaced by the entity n + k, k from 0 to 9.
std::string from(int n, const std::string& text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text[i] == '@')
      result += '#' + std::to_string(n + text[++i] - '0');
    else
      result += text[i];
  return result;
}

/// A product and its shape (entities n to n + 4) of the representation given.
std::string product(int n, const std::string& name, const std::string& representation) {
  return from(n, "@0=SHAPE_DEFINITION_REPRESENTATION(@1," + representation +
                     ");\n@1=PRODUCT_DEFINITION_SHAPE('','',@2);\n"
                     "@2=PRODUCT_DEFINITION('design','',@3,#5);\n"
                     "@3=PRODUCT_DEFINITION_FORMATION('','',@4);\n"
                     "@4=PRODUCT('" +
                     name + "','" + name + "','',(#4));\n");
}

/// A product placed in another (entities n to n + 4), from the axes #11 to others.
std::string placement(int n, const std::string& products, const std::string& shapes,
                      const std::string& axes) {
  return from(n,
              "@0=CONTEXT_DEPENDENT_SHAPE_REPRESENTATION(@1,@3);\n"
              "@1=(REPRESENTATION_RELATIONSHIP('',''," +
                  shapes +
                  ")REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION(@2)"
                  "SHAPE_REPRESENTATION_RELATIONSHIP());\n"
                  "@2=ITEM_DEFINED_TRANSFORMATION('','',#11," +
                  axes +
                  ");\n"
                  "@3=PRODUCT_DEFINITION_SHAPE('','',@4);\n"
                  "@4=NEXT_ASSEMBLY_USAGE_OCCURRENCE('" +
                  std::to_string(n) + "','',''," + products + ",$);\n");
}

std::string axes(int n, const std::string& at, const std::string& x) {
  return from(n, "@0=AXIS2_PLACEMENT_3D('',@1,@2,@3);\n@1=CARTESIAN_POINT('',(" + at +
                     "));\n"
                     "@2=DIRECTION('',(0.,0.,1.));\n@3=DIRECTION('',(" +
                     x + "));\n");
}

/// A red line "Größe" twice in "pair" (turned by a right angle and yellow the second time), which
/// stands twice in "whole" (half a turn and 50 higher the second time); metres.
std::string assembly() {
  return "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\nFILE_NAME('','',(''),(''),'','',''"
         ");\n"
         "FILE_SCHEMA(('AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }'));\nENDSEC;\nDATA;\n"
         "#2=APPLICATION_CONTEXT('core data for automotive mechanical design processes');\n"
         "#4=PRODUCT_CONTEXT('',#2,'mechanical');\n"
         "#5=PRODUCT_DEFINITION_CONTEXT('part definition',#2,'design');\n" +
         axes(11, "0.,0.,0.", "1.,0.,0.") + axes(15, "100.,0.,0.", "0.,1.,0.") +
         axes(19, "0.,0.,50.", "-1.,0.,0.") +
         "#23=(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNIT_ASSIGNED_CONTEXT((#24,#25,#26))"
         "REPRESENTATION_CONTEXT('',''));\n"
         "#24=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT($,.METRE.));\n"
         "#25=(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.));\n"
         "#26=(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT());\n" +
         product(30, "whole", "#36") + "#36=SHAPE_REPRESENTATION('',(#11,#19),#23);\n" +
         product(40, "pair", "#46") + "#46=SHAPE_REPRESENTATION('',(#11,#15),#23);\n" +
         product(50, "Gr\\X2\\00F600DF\\X0\\e", "#56") +
         "#56=GEOMETRICALLY_BOUNDED_WIREFRAME_SHAPE_REPRESENTATION('',(#11,#57),#23);\n"
         "#57=GEOMETRIC_CURVE_SET('',(#58));\n"
         "#58=TRIMMED_CURVE('',#59,(PARAMETER_VALUE(0.)),(PARAMETER_VALUE(2.)),.T.,.PARAMETER.);\n"
         "#59=LINE('',#60,#61);\n#60=CARTESIAN_POINT('',(1.,0.,0.));\n#61=VECTOR('',#62,1.);\n"
         "#62=DIRECTION('',(1.,0.,0.));\n" +
         placement(70, "#42,#52", "#56,#46", "#11") + placement(75, "#42,#52", "#56,#46", "#15") +
         placement(80, "#32,#42", "#46,#36", "#11") + placement(85, "#32,#42", "#46,#36", "#19") +
         "#90=PRESENTATION_LAYER_ASSIGNMENT('rails','',(#57));\n"
         "#91=MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION('',(#92,#96),#23);\n"
         "#92=STYLED_ITEM('',(#93),#57);\n#93=PRESENTATION_STYLE_ASSIGNMENT((#94));\n"
         "#94=CURVE_STYLE('',#100,POSITIVE_LENGTH_MEASURE(0.1),#95);\n"
         "#95=DRAUGHTING_PRE_DEFINED_COLOUR('red');\n"
         "#96=OVER_RIDING_STYLED_ITEM('',(#97),#57,#92);\n"
         "#97=PRESENTATION_STYLE_BY_CONTEXT((#98),#102);\n"
         "#98=CURVE_STYLE('',#100,POSITIVE_LENGTH_MEASURE(0.1),#99);\n"
         "#99=DRAUGHTING_PRE_DEFINED_COLOUR('yellow');\n"
         "#100=DRAUGHTING_PRE_DEFINED_CURVE_FONT('continuous');\n"
         "#101=SHAPE_DEFINITION_REPRESENTATION(#78,#102);\n"
         "#102=SHAPE_REPRESENTATION('',(#15),#23);\nENDSEC;\nEND-ISO-10303-21;\n";
}

/// A text with the first occurrence of a part replaced.
std::string with(std::string text, const std::string& old, const std::string& now) {
  return text.replace(text.find(old), old.size(), now);
}

TEST_F(CadAssembly, EverySchemaAndUnit) {
  const std::string inches =
      "#24=(CONVERSION_BASED_UNIT('INCH',#27)LENGTH_UNIT()NAMED_UNIT(#29));\n"
      "#27=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(25.4),#28);\n"
      "#28=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));\n"
      "#29=DIMENSIONAL_EXPONENTS(1.,0.,0.,0.,0.,0.,0.);\n";
  const std::string metres = "#24=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT($,.METRE.));\n";
  for (const char* schema :
       {"CONFIG_CONTROL_DESIGN", "AUTOMOTIVE_DESIGN",
        "AP242_MANAGED_MODEL_BASED_3D_ENGINEERING_MIM_LF { 1 0 10303 442 1 1 4 }"})
    for (const auto& [unit, entities] : {std::pair{"m", metres}, std::pair{"in", inches}}) {
      SCOPED_TRACE(std::string(schema) + ", " + unit);
      std::string text = with(assembly(), "AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }", schema);
      // The second "pair" lies down: its z along (0, 1, 0), its x along (3, 0, 4) of "whole".
      text = with(with(text, metres, entities),
                  "#21=DIRECTION('',(0.,0.,1.));\n#22=DIRECTION('',(-1.,0.,0.));",
                  "#21=DIRECTION('',(0.,1.,0.));\n#22=DIRECTION('',(3.,0.,4.));");
      std::ofstream(folder_ / "a.step") << text;
      const auto read = read_document(folder_ / "a.step");
      ASSERT_TRUE(read) << read.error().message;
      EXPECT_EQ(read->unit, unit);
      ASSERT_EQ(read->paths.size(), 2U);
      ASSERT_EQ(read->space_curves.size(), 2U);
      EXPECT_LT(distance(evaluate(read->paths[1].path, 1), {100, 3}), 1e-12);
      // x (0.6, 0, 0.8), y = z x x = (0.8, 0, -0.6).
      EXPECT_LT(distance(evaluate(read->space_curves[0].curve, 1), {1.8, 0, 52.4}), 1e-12);
      EXPECT_LT(distance(evaluate(read->space_curves[1].curve, 1), {62.4, 0, 128.2}), 1e-12);
      EXPECT_TRUE(read->skipped.empty());
    }
}

TEST_F(CadAssembly, AFileWithoutUnitIsInMillimetresAndSaysSo) {
  std::ofstream(folder_ / "a.step")
      << with(assembly(), "GLOBAL_UNIT_ASSIGNED_CONTEXT((#24,#25,#26))",
              "GLOBAL_UNIT_ASSIGNED_CONTEXT((#25,#26))");
  const auto read = read_document(folder_ / "a.step");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->unit, "mm");
  EXPECT_LT(distance(evaluate(read->paths.at(1).path, 1), {100, 3}), 1e-12);
  EXPECT_THAT(read->skipped, testing::ElementsAre(testing::HasSubstr("a unit of length")));
}

TEST_F(CadAssembly, ScaledAndMirroredPlacementsAreReported) {
  const std::string mapped =
      "#56=GEOMETRICALLY_BOUNDED_WIREFRAME_SHAPE_REPRESENTATION('',(#11,#110),#23);\n"
      "#109=GEOMETRICALLY_BOUNDED_WIREFRAME_SHAPE_REPRESENTATION('',(#11,#57),#23);\n"
      "#110=MAPPED_ITEM('',#111,#112);\n#111=REPRESENTATION_MAP(#11,#109);\n";
  const std::string plain =
      "#56=GEOMETRICALLY_BOUNDED_WIREFRAME_SHAPE_REPRESENTATION('',(#11,#57),#23);\n";
  for (const auto& [x, scale, rigid] : {std::tuple{"1.", "1.", true},
                                        {"-1.", "1.", false},
                                        {"1.", "2.", false},
                                        {"1.", "0.5", false}}) {
    const std::string map = "#112=CARTESIAN_TRANSFORMATION_OPERATOR_3D('','','',#113,#114,#12," +
                            std::string(scale) + ",#115);\n#113=DIRECTION('',(" + x +
                            ",0.,0.));\n#114=DIRECTION('',(0.,1.,0.));\n"
                            "#115=DIRECTION('',(0.,0.,1.));\n";
    std::ofstream(folder_ / "a.step") << with(assembly(), plain, mapped + map);
    const auto read = read_document(folder_ / "a.step");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->paths.size() + read->space_curves.size(), 4U);
    if (rigid)
      EXPECT_THAT(read->skipped, testing::IsEmpty());
    else
      EXPECT_THAT(read->skipped, testing::ElementsAre(
                                     "the scale or mirroring of 1 placement: parts stand there in "
                                     "their own size and hand"))
          << map;
  }
}

TEST_F(CadAssembly, PlacementsOfSharedPartsKeepNamesAndColours) {
  std::ofstream(folder_ / "a.step") << assembly();
  const auto read = read_document(folder_ / "a.step");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->unit, "m");
  ASSERT_EQ(read->paths.size(), 2U);
  ASSERT_EQ(read->space_curves.size(), 2U);
  for (const document::Label& label : labels(*read)) {
    EXPECT_EQ(label.name, "Größe");
    EXPECT_EQ(label.layer, "rails");
  }
  EXPECT_EQ(read->paths[0].label.color, "#ff0000");
  EXPECT_EQ(read->paths[1].label.color, "#ffff00");
  EXPECT_EQ(read->space_curves[0].label.color, "#ff0000");
  EXPECT_EQ(read->space_curves[1].label.color, "#ffff00");
  EXPECT_LT(distance(evaluate(read->paths[0].path, 0), {1, 0}), 1e-12);
  EXPECT_LT(distance(evaluate(read->paths[1].path, 1), {100, 3}), 1e-12);
  EXPECT_LT(distance(evaluate(read->space_curves[0].curve, 1), {-3, 0, 50}), 1e-12);
  EXPECT_LT(distance(evaluate(read->space_curves[1].curve, 0), {-100, -1, 50}), 1e-12);
}

// What programs write where a thing has no name is none; a name may be broken between lines of the
// file (ISO 10303-21, 5.2: line ends count for nothing).
TEST_F(CadAssembly, NamesAreThoseThatSomebodyGave) {
  const auto name = [this](const std::string& product) {
    std::string text = assembly();
    const std::string old = "Gr\\X2\\00F600DF\\X0\\e";
    for (std::size_t at = text.find(old); at != text.npos; at = text.find(old))
      text.replace(at, old.size(), product);
    std::ofstream(folder_ / "a.step") << text;
    const auto read = read_document(folder_ / "a.step");
    return read ? read->paths.at(0).label.name : read.error().message;
  };
  EXPECT_EQ(name("rail"), "rail");
  EXPECT_EQ(name("long\nrail"), "longrail");
  const std::string none = name("   ");
  EXPECT_NE(none, "   ");
  for (const char* placeholder : {"NONE", "Open CASCADE STEP translator 7.6 1"})
    EXPECT_EQ(name(placeholder), none) << placeholder;
  EXPECT_EQ(name("NONESUCH"), "NONESUCH");
}

TEST_F(CadAssembly, NamesColoursAndLayersComeBack) {
  Document d;
  d.unit = "ft";
  std::string name = "Grat 日本 😀 'x' \\X2\\";
  for (int i = 0; i < 20; ++i) name += " lang und länger";
  d.paths.push_back(
      {{name, "body side", "#12a4ff"},
       {{{curve::BSpline2{2, {0, 0, 0, 1, 1, 1}, {{0, 0}, {1, 2}, {3, 1}}, {}}}}, false},
       0});
  d.paths.push_back(
      {{"plain", "7", "#00ff00"}, {{{curve::Bezier2{{{0, 0}, {4, 0}}, {}}}}, false}, 0});
  surface::BSplineSurface s{{1, 1}, {{{0, 0, 1, 1}, {0, 0, 1, 1}}}, {2, 2, {}}, {}};
  s.net.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1}};
  d.surfaces.push_back({{"skin", "body side", "#000000"}, s, 0});
  for (const char* file : {"b.step", "b.iges"}) {
    SCOPED_TRACE(file);
    ASSERT_TRUE(write_document(d, folder_ / file));
    const auto read = read_document(folder_ / file);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->unit, "ft");
    EXPECT_EQ(labels(*read), labels(d));
  }
}

TEST_F(CadAssembly, ControlCharactersInNamesBreakNoFile) {
  Document d;
  d.unit = "mm";
  for (const char* name : {"a\nb", "c\td",
                           "e\x01\x7f"
                           "f",
                           "g\r\nh"})
    d.paths.push_back(
        {{name, name, ""}, {{{curve::Bezier2{{{0, 0}, {4, 1}, {5, 7}}, {}}}}, false}, 0});
  for (const char* file : {"c.step", "c.iges", "c.dxf"}) {
    SCOPED_TRACE(file);
    ASSERT_TRUE(write_document(d, folder_ / file));
    const auto read = read_document(folder_ / file);
    ASSERT_TRUE(read) << read.error().message;
    ASSERT_EQ(read->paths.size(), 4U);
    EXPECT_EQ(read->paths[0].label.name, "a b");
    EXPECT_EQ(read->paths[2].label.name, "e  f");
  }
  ASSERT_TRUE(write_document(d, folder_ / "c.csv"));
  const auto table = read_document(folder_ / "c.csv");
  ASSERT_TRUE(table) << table.error().message;
  EXPECT_EQ(table->paths.size(), 4U);
}

TEST_F(CadAssembly, TrimLoopsComeWithTheSurface) {
  const fs::path file = KEYLINE_SHARED_DATA "/4_cad/iges/wing.iges";
  KEYLINE_NEEDS_SHARED_DATA(fs::exists(file), file);
  auto read = read_document(file);
  ASSERT_TRUE(read) << read.error().message;
  std::size_t curves = 0;
  for (const auto& named : read->surfaces) {
    EXPECT_EQ(named.trims > 0, !named.trim_loops.empty());
    for (const auto& loop : named.trim_loops) {
      curves += loop.size();
      for (std::size_t i = 0; i < loop.size(); ++i)
        EXPECT_LT(distance(evaluate(loop[i], 1), evaluate(loop[(i + 1) % loop.size()], 0)), 1e-3);
    }
  }
  add_trim_curves(*read);
  EXPECT_EQ(read->space_curves.size(), curves);
}

}  // namespace
}  // namespace keyline::exchange
