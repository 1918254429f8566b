#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "keyline/core/angle.h"
#include "keyline/document/units.h"
#include "keyline/exchange/document_file.h"

#include "cad_fixture.h"

namespace keyline::exchange {
namespace {

using core::Point2;
using document::Document;
using testing::HasSubstr;

using Chains = CadTest;

/// Outlines and chains as drawings hold them.
Document outlines() {
  const auto line = [](Point2 a, Point2 b) {
    return document::PlanarCurve{curve::Bezier2{{a, b}, {}}};
  };
  const double w = std::sqrt(0.5);
  const auto corner = [w](Point2 a, Point2 b, Point2 c) {
    return document::PlanarCurve{curve::Bezier2{{a, b, c}, {1, w, 1}}};
  };
  Document d;
  d.unit = "mm";
  d.paths.push_back({{"triangle", "a", "#ff0000"},
                     {{line({0, 0}, {10, 0}), line({10, 0}, {5, 8}), line({5, 8}, {0, 0})}, true},
                     0});
  d.paths.push_back({{"rounded", "a", "#00ff00"},
                     {{line({21, 0}, {29, 0}), corner({29, 0}, {30, 0}, {30, 1}),
                       line({30, 1}, {30, 9}), corner({30, 9}, {30, 10}, {29, 10}),
                       line({29, 10}, {21, 10}), corner({21, 10}, {20, 10}, {20, 9}),
                       line({20, 9}, {20, 1}), corner({20, 1}, {20, 0}, {21, 0})},
                      true},
                     0});
  d.paths.push_back(
      {{"drop", "b", "#0000ff"},
       {{{curve::Bezier2{{{40, 0}, {45, -5}, {55, 5}, {50, 10}}, {}}}, line({50, 10}, {40, 0})},
        true},
       0});
  d.paths.push_back({{"open", "b", "#010203"},
                     {{corner({60, 0}, {61, 0}, {61, 1}),
                       {curve::Bezier2{{{61, 1}, {63, 4}, {66, -3}, {70, 2}}, {}}}},
                      false},
                     0});
  return d;
}

/// Largest distance of places on a path from places on the other, which stand 1e-4 of it apart.
double far_off(const document::Path& path, const document::Path& other) {
  std::vector<Point2> places;
  for (int i = 0; i <= 20000; ++i) places.push_back(evaluate(other, i / 20000.0));
  double most = 0;
  for (int i = 0; i <= 40; ++i) {
    const Point2 p = evaluate(path, i / 40.0);
    double least = HUGE_VAL;
    for (const Point2 q : places) least = std::min(least, distance(p, q));
    most = std::max(most, least);
  }
  return most;
}

// Through every CAD format an outline stays one closed thing of its name, layer and colour.
TEST_F(Chains, ClosedStaysClosedAndChainsStayChains) {
  const Document d = outlines();
  for (const char* name : {"a.dxf", "a.step", "a.iges"}) {
    SCOPED_TRACE(name);
    const auto written = write_document(d, folder_ / name, {.tolerance = 1e-4});
    ASSERT_TRUE(written) << written.error().message;
    EXPECT_LE(written->deviation, 1e-4);
    const auto read = read_document(folder_ / name);
    ASSERT_TRUE(read) << read.error().message;
    ASSERT_EQ(read->paths.size(), d.paths.size());
    EXPECT_TRUE(read->space_curves.empty());
    for (std::size_t i = 0; i < d.paths.size(); ++i) {
      SCOPED_TRACE(d.paths[i].label.name);
      EXPECT_EQ(read->paths[i].label, d.paths[i].label);
      EXPECT_EQ(read->paths[i].path.closed, d.paths[i].path.closed);
      EXPECT_LT(far_off(d.paths[i].path, read->paths[i].path), 3e-3);  // of the places compared
      EXPECT_LT(far_off(read->paths[i].path, d.paths[i].path), 3e-3);
    }
  }
}

// What comes back from STEP and IGES ends a rounding off its start.
TEST_F(Chains, ClosedUpToRoundingStaysClosed) {
  Document d;
  d.unit = "mm";
  const curve::Bezier2 loop{{{40, 0}, {45, -5}, {55, 5}, {50, 10}}, {}};
  d.paths.push_back(
      {{"two", "", ""}, {{{loop}, {curve::Bezier2{{{50, 10}, {40, 7e-15}}, {}}}}, true}, 0});
  d.paths.push_back(
      {{"one", "", ""}, {{{curve::Bezier2{{{0, 0}, {9, -5}, {9, 5}, {-4e-16, 0}}, {}}}}, true}, 0});
  for (const char* name : {"r.dxf", "r.step", "r.iges"}) {
    SCOPED_TRACE(name);
    const auto written = write_document(d, folder_ / name);
    ASSERT_TRUE(written);
    EXPECT_LT(written->deviation, 1e-9);
    const auto read = read_document(folder_ / name);
    ASSERT_TRUE(read);
    ASSERT_EQ(read->paths.size(), 2U);
    EXPECT_TRUE(read->paths[0].path.closed);
    EXPECT_TRUE(read->paths[1].path.closed);
  }
}

// Gaps part what is no chain: nothing is drawn between.
TEST_F(Chains, PartsThatDoNotMeetStayApart) {
  Document d;
  d.unit = "mm";
  d.paths.push_back(
      {{"gap", "", ""},
       {{{curve::Bezier2{{{0, 0}, {1, 0}}, {}}}, {curve::Bezier2{{{2, 0}, {3, 0}}, {}}}}, false},
       0});
  for (const char* name : {"g.dxf", "g.step", "g.iges"}) {
    SCOPED_TRACE(name);
    ASSERT_TRUE(write_document(d, folder_ / name));
    const auto read = read_document(folder_ / name);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->paths.size(), 2u);
  }
}

struct UnitCase {
  const char* unit;
  double millimetres;  ///< SI brochure; CSS Values 3 for pt and px
};

// A thing 254 mm wide stays that wide, whatever the drawing's unit and the file's.
TEST_F(Chains, SizesAreTheSameInEveryPairOfUnitAndFormat) {
  const UnitCase units[] = {{"mm", 1},    {"cm", 10},    {"m", 1000},       {"km", 1e6},
                            {"in", 25.4}, {"ft", 304.8}, {"pt", 25.4 / 72}, {"px", 25.4 / 96}};
  for (const UnitCase& unit : units)
    for (const char* name : {"u.svg", "u.svgz", "u.json", "u.dxf", "u.step", "u.iges"}) {
      SCOPED_TRACE(std::string(unit.unit) + ' ' + name);
      const double wide = 254 / unit.millimetres;
      Document d;
      d.unit = unit.unit;
      d.paths.push_back(
          {{"a", "", ""},
           {{{curve::Bezier2{{{0, 0}, {wide / 3, wide / 9}, {2 * wide / 3, 0}, {wide, 0}}, {}}}},
            false},
           0});
      const auto written = write_document(d, folder_ / name);
      ASSERT_TRUE(written) << written.error().message;
      auto read = read_document(folder_ / name);
      ASSERT_TRUE(read) << read.error().message;
      const std::string& there = read->unit;
      const UnitCase* own = nullptr;
      for (const UnitCase& other : units)
        if (there == other.unit) own = &other;
      ASSERT_NE(own, nullptr) << there;
      const Point2 end = evaluate(read->paths.at(0).path, 1);
      EXPECT_NEAR(end.x * own->millimetres, 254, 1e-9);
    }
}

TEST(Units, OfDxfAreRead) {
  const auto width = [](int code, std::string& unit) {
    const std::string text =
        "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n" + std::to_string(code) +
        "\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n0\nLINE\n10\n0\n20\n0\n11\n2\n21\n0\n"
        "0\nENDSEC\n0\nEOF\n";
    const auto file = std::filesystem::temp_directory_path() / "keyline-unit.dxf";
    std::ofstream(file) << text;
    const auto document = read_document(file);
    std::filesystem::remove(file);
    if (!document) return 0.0;
    unit = document->unit;
    return evaluate(document->paths.at(0).path, 1).x;
  };
  // Autodesk's table of $INSUNITS, lengths in millimetres of two units each.
  const std::pair<int, double> table[] = {{1, 50.8},    {2, 609.6},  {3, 3218688}, {4, 2},
                                          {5, 20},      {6, 2000},   {7, 2e6},     {9, 0.0508},
                                          {10, 1828.8}, {13, 0.002}, {14, 200},    {16, 2e5}};
  for (const auto& [code, millimetres] : table) {
    std::string unit;
    const double value = width(code, unit);
    EXPECT_NEAR(value * document::millimetres(unit), millimetres, 1e-9 * millimetres) << code;
  }
}

// OCCT reads a number it cannot read as 0: such a file is refused with the line.
TEST_F(Chains, NumbersOfCadFilesAreChecked) {
  Document d;
  d.unit = "mm";
  d.paths.push_back(
      {{"a", "", ""}, {{{curve::Bezier2{{{0, 0}, {1, 2.125}, {3, 3}, {4, 0}}, {}}}}, false}, 0});
  for (const char* extension : {".step", ".iges"}) {
    const auto written = format_document(d, extension);
    ASSERT_TRUE(written) << written.error().message;
    const std::string number = "2.1250000000000000E+00";
    const std::size_t at = written->content.find(number);
    ASSERT_NE(at, std::string::npos) << extension;
    for (std::string bad : {"abc", "nan", "1.2.3", "1e400"}) {
      SCOPED_TRACE(extension + bad);
      bad.resize(number.size(), extension == std::string(".step") ? ' ' : '0');
      if (bad.starts_with("1e400") && extension == std::string(".iges"))
        bad = "1e4000000000000000000";
      bad.resize(number.size(), '0');
      std::string text = written->content;
      text.replace(at, number.size(), bad);
      const auto file = folder_ / (std::string("bad") + extension);
      std::ofstream(file, std::ios::binary) << text;
      const auto read = read_document(file);
      ASSERT_FALSE(read);
      EXPECT_THAT(read.error().path, HasSubstr("bad" + std::string(extension) + ":"));
      EXPECT_THAT(read.error().message, HasSubstr("is no value"));
    }
  }
}

// Fields of an IGES directory are eight columns wide (IGES 5.3, 2.2.4.4). OCCT takes one it cannot
// read for 0: a name, a level or a whole entity was lost.
TEST_F(Chains, UnreadableFieldsOfAnIgesDirectoryAreRefused) {
  Document d;
  d.unit = "mm";
  d.paths.push_back(
      {{"a", "front", "#ff0000"}, {{{curve::Bezier2{{{0, 0}, {1, 1}}, {}}}}, false}, 0});
  const std::string sound = format_document(d, ".iges").value().content;
  const std::size_t first = sound.find("D0000001") - 72;
  const std::size_t second = sound.find("D0000002") - 72;
  const auto why = [&](std::size_t at, const std::string& field) {
    std::string text = sound;
    text.replace(at, 8, field);
    std::ofstream(folder_ / "d.iges", std::ios::binary) << text;
    const auto read = read_document(folder_ / "d.iges");
    return read ? std::string() : read.error().path + ": " + read.error().message;
  };
  EXPECT_THAT(why(first + 8, "       x"), HasSubstr("\"x\" is no value"));
  EXPECT_THAT(why(first + 32, "     3,5"), HasSubstr("\"3,5\" is no value"));
  EXPECT_THAT(why(first + 64, "0000000x"), HasSubstr("\"0000000x\" is no value"));
  EXPECT_THAT(why(second + 16, "     1e4"), HasSubstr("\"1e4\" is no value"));
  EXPECT_EQ(why(first + 64, " 0 0 0 0"), "");
  EXPECT_EQ(why(second + 40, "RESERVED"), "");
  EXPECT_EQ(why(second + 56, "   A-1.5"), "");  // a label
  EXPECT_EQ(why(second + 64, "     1.5"), "");  // and what tells it from others
  EXPECT_THAT(why(sound.find("P0000001") - 72, "1x0,    "), HasSubstr("\"1x0\" is no value"));
  std::string longer = sound;  // by a column: the line is of no section
  longer.insert(first + 8, " ");
  std::ofstream(folder_ / "d.iges", std::ios::binary) << longer;
  const auto read = read_document(folder_ / "d.iges");
  const auto line = 1 + std::ranges::count(sound.substr(0, first), '\n');
  ASSERT_FALSE(read);
  EXPECT_THAT(read.error().message,
              HasSubstr("line " + std::to_string(line) + ": it has no letter of a section"));
}

// ISO 10303-21, 6.4: what is left out is written $, letters beyond ASCII stand in strings alone.
TEST_F(Chains, NothingIsNoValueOfAStepFile) {
  Document d;
  d.unit = "mm";
  d.paths.push_back({{"a", "", "#123456"}, {{{curve::Bezier2{{{0, 0}, {1, 2}}, {}}}}, false}, 0});
  const std::string sound = format_document(d, ".step").value().content;
  const auto why = [&](std::size_t at, std::size_t size, const std::string& value) {
    std::string text = sound;
    std::ofstream(folder_ / "d.step", std::ios::binary) << text.replace(at, size, value);
    const auto read = read_document(folder_ / "d.step");
    return read ? std::string() : read.error().message;
  };
  EXPECT_EQ(why(0, 0, ""), "");
  for (const char* owner : {"COLOUR_RGB('',", "CARTESIAN_POINT('',("}) {
    const std::size_t at = sound.find(owner) + std::string_view(owner).size();
    const std::size_t size = sound.find_first_of(",)", at) - at;
    for (const char* none : {"", "  ", "\u00bd", "\u22121.", "\x1a"})
      EXPECT_THAT(why(at, size, none), HasSubstr("is no value")) << owner << none;
    EXPECT_EQ(why(at, size, " 0.5 "), "") << owner;
  }
}

// A decimal comma makes two coordinates of one: OCCT takes the first three, whatever they are.
TEST_F(Chains, PointsOfAStepFileHaveThreeCoordinates) {
  Document d;
  d.unit = "mm";
  d.paths.push_back(
      {{"a", "", ""}, {{{curve::Bezier2{{{0, 0}, {1, 2.125}, {3, 3}, {4, 0}}, {}}}}, false}, 0});
  std::string text = format_document(d, ".step").value().content;
  const std::size_t at = text.find("2.1250000000000000E+00");
  ASSERT_NE(at, std::string::npos);
  text[at + 1] = ',';
  std::ofstream(folder_ / "comma.step", std::ios::binary) << text;
  const auto read = read_document(folder_ / "comma.step");
  ASSERT_FALSE(read);
  EXPECT_THAT(read.error().path, HasSubstr("comma.step:"));
  EXPECT_THAT(read.error().message, HasSubstr("more than three coordinates"));
}

}  // namespace
}  // namespace keyline::exchange
