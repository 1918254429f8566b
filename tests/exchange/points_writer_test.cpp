#include "keyline/exchange/points/points_writer.h"

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/document/document.h"
#include "keyline/exchange/points/csv_writer.h"
#include "keyline/exchange/points/lattice_reader.h"
#include "keyline/exchange/points/points_reader.h"

namespace keyline::exchange {
namespace {

TEST(WritePoints, ReadsBackToTheSameDoubles) {
  std::vector<core::Point2> points;
  for (int i = 0; i < 200; ++i) {
    points.push_back({std::sin(i * 1.7) * std::pow(10.0, i % 40 - 20), 1.0 / (i + 3)});
  }
  std::stringstream text;
  write_points(text, points);
  const auto curves = read_points(text, "written.csv");
  ASSERT_TRUE(curves) << curves.error().message;
  const auto& read = curves->front().points;
  ASSERT_EQ(read.size(), points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(read[i], (core::Point3{points[i].x, points[i].y, 0}));
  }
}

// Rows begin with the names of their curves; a name is none of what lines of tables begin with.
TEST(WriteCsv, NamesReadBackAsTheyAre) {
  const std::vector<std::string> names = {"#1",
                                          "# side",
                                          "%",
                                          "!",
                                          "//",
                                          "/x",
                                          " a",
                                          "a ",
                                          "a",
                                          "",
                                          "\"q\"",
                                          ",",
                                          "sep=;",
                                          "ZONE I=3",
                                          "#N/A",
                                          "a;1;2;3;4;5;6",
                                          "nan",
                                          "1",
                                          "x",
                                          "mm",
                                          "units: mm",
                                          "VARIABLES = x",
                                          "rear 10 20 30 40 50"};
  for (const std::string& first : names) {
    SCOPED_TRACE(first);
    document::Document drawing;
    const auto add = [&](const std::string& name) {
      const double y = static_cast<double>(drawing.paths.size());
      curve::Polyline2 line{{{0, y}, {1.5, y + 1}, {2, y}}};
      drawing.paths.push_back({{name, {}, {}}, {{{std::move(line)}}, false}, 0});
    };
    add(first);
    for (const std::string& name : names)
      if (name != first) add(name);
    const auto written = write_csv(drawing, 3);
    ASSERT_TRUE(written) << written.error().message;
    std::istringstream in(written->content);
    const auto read = read_points(in, "names.csv");
    ASSERT_TRUE(read) << read.error().message << " " << read.error().path;
    ASSERT_EQ(read->size(), names.size());
    for (std::size_t i = 0; i < read->size(); ++i) {
      EXPECT_EQ((*read)[i].id, drawing.paths[i].label.name);
      EXPECT_EQ((*read)[i].points.size(), 3U);
      EXPECT_EQ((*read)[i].points[0].y, static_cast<double>(i));
    }
  }
}

// What the table shows as a blank makes no two names one.
TEST(WriteCsv, NamesThatAreOneOnTheirLineAreNumbered) {
  document::Document drawing;
  for (const char* name : {"a\tb", "a b"})
    drawing.paths.push_back({{name, {}, {}}, {{{curve::Polyline2{{{0, 0}, {1, 2}}}}}, false}, 0});
  const auto written = write_csv(drawing, 3);
  ASSERT_TRUE(written);
  EXPECT_NE(written->content.find("\na b#2,"), std::string::npos) << written->content;
}

TEST(ReadLattice, BothForms) {
  std::istringstream blank("0 0 0\n1 0 0\n2 0 0\n\n0 1 0\n1 1 1\n2 1 0\n");
  const auto a = read_lattice(blank, "blank.xyz");
  ASSERT_TRUE(a) << a.error().message;
  EXPECT_EQ(a->lattice.rows, 2u);
  EXPECT_EQ(a->lattice.columns, 3u);
  std::istringstream headed("3 2\n0 0 0\n1 0 0\n2 0 0\n0 1 0\n1 1 1\n2 1 0\n");
  const auto b = read_lattice(headed, "headed.xyz");
  ASSERT_TRUE(b) << b.error().message;
  EXPECT_EQ(b->lattice.rows, 3u);
  EXPECT_EQ(a->lattice.points, b->lattice.points);
  const auto column = acquire::lattice_column(a->lattice, 1);
  ASSERT_TRUE(column);
  EXPECT_EQ(column->points[1], (core::Point3{1, 1, 1}));
  EXPECT_FALSE(acquire::lattice_row(a->lattice, 2));
}

TEST(ReadLattice, TellsWhatIsWrong) {
  for (const char* text : {"", "0 0 0\n1 1 1\n", "2 2\n0 0 0\n1 1 1\n", "0 0 0\n1 0 0\n\n0 1 0\n",
                           "0 0 0\n1 x 0\n\n0 1 0\n0 1 1\n", "0 0\n1 0.5\n"}) {
    std::istringstream in(text);
    const auto lattice = read_lattice(in, "bad.xyz");
    ASSERT_FALSE(lattice) << text;
    EXPECT_EQ(lattice.error().code, core::ErrorCode::bad_input);
  }
}

TEST(WriteCsv, NamesWithLineBreaksAreTold) {
  const auto notes = [](const std::string& name) {
    document::Document d;
    for (const std::string& one : {name, std::string("b")})
      d.paths.push_back({{one, "", ""}, {{{curve::Polyline2{{{0, 0}, {1, 2}, {3, 1}}}}}, false}});
    return write_csv(d, 10).value().notes;
  };
  EXPECT_EQ(notes("left side"), std::vector<std::string>{});
  for (const char* name : {"left\nside", "left\tside"})
    EXPECT_EQ(notes(name), std::vector<std::string>{
                               "names of curves have blanks in the table for their line breaks and "
                               "tabs"});
}

}  // namespace
}  // namespace keyline::exchange
