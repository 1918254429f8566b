#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <unistd.h>

#include <gtest/gtest.h>

#include "keyline/exchange/points/points_reader.h"
#include "keyline/exchange/text/header_unit.h"

namespace keyline::exchange {
namespace {

using acquire::RawCurve;
using core::Point3;

core::Result<std::vector<RawCurve>> parse(const std::string& text,
                                          const PointsOptions& options = {}) {
  std::istringstream in(text);
  return read_points(in, "data.csv", options);
}

PointsOptions asking(std::vector<std::string> columns) {
  PointsOptions options;
  options.columns = std::move(columns);
  return options;
}

RawCurve only(const std::string& text) {
  const auto curves = parse(text);
  EXPECT_TRUE(curves) << text << curves.error().message;
  return curves && curves->size() == 1 ? curves->front() : RawCurve{};
}

// R's write.csv counts the rows in a column without a name, and has every name in quotes.
TEST(PointsHeader, ANameMayBeEmptyInQuotes) {
  for (const char* text :
       {"\"\",\"x\",\"y\"\n\"1\",0,5\n\"2\",1,6\n\"3\",2,5\n", ",x,y\n1,0,5\n2,1,6\n3,2,5\n"}) {
    const RawCurve curve = only(text);
    EXPECT_EQ(curve.points, (std::vector<Point3>{{0, 5, 0}, {1, 6, 0}, {2, 5, 0}})) << text;
  }
  const auto words = parse("\"\",\"y\",\"kind\"\n\"1\",5,\"a\"\n\"2\",6,\"b\"\n");
  ASSERT_FALSE(words);
  EXPECT_EQ(words.error().path, "data.csv:2");  // not the header
}

// Columns kept in line by blanks behind the numbers: " ,750" is no number with a decimal comma.
TEST(PointsHeader, CommasMayStandBehindBlanks) {
  EXPECT_EQ(only("350  ,-90   ,750  \n-55  ,+90   ,156  \n0    ,180   ,0    \n").points,
            (std::vector<Point3>{{350, -90, 750}, {-55, 90, 156}, {0, 180, 0}}));
}

// "0,5, 1,5": commas part the columns, and fractions too.
TEST(PointsHeader, DecimalCommasAmongCommasAreRefused) {
  for (const char* rows : {"0,5, 1,5\n1,25, 2,5\n2,5, 3,75\n", "-0,5, +1,5\n1,25, 2,5\n"}) {
    const auto read = parse(rows);
    ASSERT_FALSE(read) << rows;
    EXPECT_EQ(read.error().path, "data.csv:1");
    EXPECT_EQ(read.error().message, "commas that part columns or fractions");
  }
  EXPECT_EQ(only("1, 2, 3, 4\n5, 6, 7, 8\n").points[1], (Point3{5, 6, 7}));
  EXPECT_EQ(only("1,2,3,4\n5,6,7,8\n").points[1], (Point3{5, 6, 7}));
  EXPECT_EQ(only("1,-2, 3,-4\n5,-6, 7,-8\n").points[1], (Point3{5, -6, 7}));
  EXPECT_EQ(only("x,y,z,i\n1,2, 3,4\n5,6, 7,8\n").points[1], (Point3{5, 6, 7}));
  EXPECT_EQ(only("10,000, 20,000, 30,000.5\n1,2,3,4,5,6\n").points[0].x, 10);
}

// A spreadsheet's error at the start of a row makes no comment of it.
TEST(PointsHeader, ErrorsOfSpreadsheetsAreMissingNumbers) {
  const RawCurve curve = only("x;y\n0;0\n#N/A;1,5\n2;#DIV/0!\n3;2\n");
  ASSERT_EQ(curve.points.size(), 4U);
  EXPECT_TRUE(std::isnan(curve.points[1].x));
  EXPECT_EQ(curve.points[1].y, 1.5);
  EXPECT_TRUE(std::isnan(curve.points[2].y));
  EXPECT_TRUE(std::isnan(only("#N/A 1\n2 3\n4 5\n").points.at(0).x));
}

TEST(HeaderUnit, StandsBehindTheNameInManyWays) {
  for (const auto& [cell, unit] : {std::pair{"x [mm]", "mm"},
                                   {"X(in)", "in"},
                                   {"\"y [m]\"", "m"},
                                   {"z / ft", "ft"},
                                   {"x/cm", "cm"},
                                   {"x_km", "km"},
                                   {"x [Inches]", "in"},
                                   {"x (millimetres)", "mm"},
                                   {"x", ""},
                                   {"x/c", ""},
                                   {"w_tr_right", ""},
                                   {"x [\"]", "in"},
                                   {"\"x [\"\"]\"", "in"},
                                   {"x ('')", "in"},
                                   {"\"y (')\"", "ft"},
                                   {"x ['mm']", "mm"},
                                   {"x [-]", ""}}) {
    EXPECT_EQ(detail::unit_of(cell).known, unit) << cell;
    EXPECT_EQ(detail::unit_of(cell).unknown, "") << cell;
  }
  EXPECT_EQ(detail::unit_of("x [µm]").unknown, "µm");
  EXPECT_EQ(detail::unit_of("x(um)").unknown, "um");
}

/// Of a file of that text.
core::Result<PointsFile> file_of(const std::string& text) {
  const auto path = std::filesystem::temp_directory_path() /
                    ("keyline-header-" + std::to_string(::getpid()) + ".csv");
  std::ofstream(path) << text;
  auto read = read_points_file(path);
  std::filesystem::remove(path);
  return read;
}

TEST(ReadPoints, TheHeaderTellsTheUnit) {
  const std::string rows = "0,0\n1,2\n3,4\n";
  EXPECT_EQ(file_of("x [mm],y [mm]\n" + rows)->unit, "mm");
  EXPECT_EQ(file_of("x_in,y_in\n" + rows)->unit, "in");
  EXPECT_EQ(file_of("x / ft, y / ft\n" + rows)->unit, "ft");
  EXPECT_EQ(file_of("# x_m,y_m,w_m\n0,0,1\n1,2,1\n3,4,1\n")->unit, "m");
  EXPECT_EQ(file_of("x,y\n" + rows)->unit, "");
  // in a line of their own
  EXPECT_EQ(file_of("x,y\nmm,mm\n" + rows)->unit, "mm");
  EXPECT_EQ(file_of("# x,y\n# [m],[m]\n" + rows)->unit, "m");
  EXPECT_EQ(file_of("x;y;w\n\"in\";\"in\";-\n0;0;1\n1;2;1\n3;4;1\n")->unit, "in");
  EXPECT_EQ(file_of("x,y\nmm,mm\n" + rows)->curves[0].points.size(), 3U);
  EXPECT_FALSE(file_of("x,y\nmm,in\n" + rows));
  EXPECT_FALSE(file_of("x,y\nmm,1\n" + rows));
  EXPECT_EQ(file_of("x,y\n[µm],[µm]\n" + rows)->curves[0].left_out[0].substr(0, 20),
            "line 2: the unit µm");
  const auto two = parse("x [mm],y [in]\n" + rows);
  ASSERT_FALSE(two);
  EXPECT_EQ(two.error().path, "data.csv:2");
  // A row of units has no more fields than the header has names.
  EXPECT_EQ(file_of("x,y\nmm,mm,mm,mm,mm,mm,mm,mm\n" + rows)->unit, "");
  EXPECT_EQ(file_of("x [µm],y [µm]\n" + rows)->unit, "");
  const RawCurve unknown = only("x [µm],y [µm]\n" + rows);
  ASSERT_EQ(unknown.left_out.size(), 1U);
  EXPECT_EQ(unknown.left_out[0].substr(0, 20), "line 1: the unit µm");
  EXPECT_EQ(only("x (yd),y (yd)\n" + rows).left_out.size(), 1U);
  // words of sides are none, and a line of text below the header is no line of units
  EXPECT_TRUE(
      file_of("x,y (upper),y (lower)\n0,0,0\n1,2,-2\n3,4,-4\n")->curves[0].left_out.empty());
  EXPECT_FALSE(file_of("x,y\nmeasured (twice),by hand\n" + rows));
}

TEST(ReadPoints, LinesBeforeTheRowsTellTheUnit) {
  const std::string rows = "0 0\n1 2\n3 4\n";
  for (const auto& [line, unit] : {std::pair{"# units: mm", "mm"},
                                   {"Units = inches", "in"},
                                   {"all dimensions in millimetres", "mm"},
                                   {"# Section A, all in cm", "cm"},
                                   {"units,mm", "mm"},
                                   {"# unit m", "m"},
                                   {"NACA 0012 at 3 in", ""},
                                   {"cut in m", ""},
                                   {"a foot", ""},
                                   {"units: furlong", ""}})
    EXPECT_EQ(file_of(std::string(line) + "\n" + rows)->unit, unit) << line;
  // what stands at the columns counts first
  EXPECT_EQ(file_of("# units: mm\nx [in],y [in]\n0,0\n1,2\n3,4\n")->unit, "in");
  EXPECT_EQ(only("units: mm\n" + rows).id, "");
  EXPECT_EQ(only("hull, units: mm\n" + rows).id, "hull, units: mm");
}

// Words around the letter of an axis: without them the numbers of the points would be x.
TEST(ReadPoints, AxesAreKnownByAWordOfTheirNames) {
  for (const char* header : {"Punkt;X-Koordinate [mm];Y-Koordinate [mm]",
                             "no;Position X (mm);Position Y (mm)", "n;x_pos [mm];y_pos [mm]"}) {
    const auto read = file_of(std::string(header) + "\n7;0;1\n8;2;3\n9;4;7\n");
    ASSERT_TRUE(read) << header;
    EXPECT_EQ(read->curves[0].points[2], (Point3{4, 7, 0})) << header;
    EXPECT_FALSE(read->curves[0].has_z);
    EXPECT_EQ(read->unit, "mm");
  }
  // of two columns of one letter neither is meant
  EXPECT_EQ(only("x left,y left,x right,y right\n0,0,5,6\n1,2,5,6\n3,4,5,6\n").left_out.size(), 2U);
  EXPECT_EQ(only("n,x pos,y pos,x coord,y coord\n7,0,0,5,6\n8,1,2,5,6\n9,3,4,5,6\n").points[0].x,
            7);
  // nor is one that has the letter twice
  EXPECT_EQ(only("n,x/x,y/y\n7,0,0\n8,1,2\n9,3,4\n").points[0].x, 7);
  EXPECT_EQ(only("east,north,normal_x,normal_y\n0,0,0,1\n1,2,0,1\n3,4,0,1\n").points[1].x, 1);
  EXPECT_EQ(only("x_err,x,y\n9,0,0\n9,1,2\n9,3,4\n").points[1], (Point3{1, 2, 0}));
}

TEST(ReadPoints, RemarksBehindRowsAreTold) {
  for (const char* mark : {"# a", "! a b", "// 3", "% x"}) {
    const std::string row = std::string(" ") + mark + "\n";
    const RawCurve curve = only("0 0\n1 2" + row + "3 4" + row);
    ASSERT_EQ(curve.points.size(), 3U) << mark;
    EXPECT_EQ(curve.left_out, std::vector<std::string>{"remarks behind 2 rows"});
  }
  EXPECT_EQ(only("Title # 1\n0 0 ! nose\n1 2\n3 4\n").id, "Title # 1");
  // behind a comma it is what stands in a column
  for (const std::string& left : only("x,y,of\n0,0, #1\n1,2, #1\n3,4, #2\n").left_out)
    EXPECT_FALSE(left.starts_with("remarks")) << left;
  const auto named = parse("x,y,id\n0,0, #1\n1,2, #1\n3,4, #2\n");  // names of curves
  ASSERT_TRUE(named);
  EXPECT_EQ(named->size(), 2U);
  EXPECT_EQ(only("sep=;\nx;y\n0;0\n1;2\n3;4\n").id, "");
}

// An entry that is missing must not move those behind it one column to the left.
TEST(ReadPoints, TabsOfAHeaderKeepMissingEntriesInTheirColumn) {
  const RawCurve curve = only("x\ty\tz\tq\n1\t2\t3\t9\n2\t\t3\t4\n3\t4\t5\t6\n");
  ASSERT_EQ(curve.points.size(), 3U);
  EXPECT_EQ(curve.points[1].x, 2);
  EXPECT_TRUE(std::isnan(curve.points[1].y));
  EXPECT_EQ(curve.points[1].z, 3);
  const auto named = parse("id\tx\ty\na b\t1\t2\na b\t3\t4\n");
  ASSERT_TRUE(named) << named.error().message;
  EXPECT_EQ(named->front().id, "a b");
  const auto bare = parse("a b\t1\t2\na b\t3\t4\nc d\t5\t6\nc d\t7\t8\n");
  ASSERT_TRUE(bare) << bare.error().message;
  ASSERT_EQ(bare->size(), 2U);
  EXPECT_EQ(bare->back().id, "c d");
  // tabs that only set rows in line are white space
  EXPECT_EQ(only("x\ty\n1.0\t\t2.0\n3.0\t\t4.0\n5.0\t\t6.0\n").points[1], (Point3{3, 4, 0}));
}

TEST(ReadPoints, ColumnsThatAreNotTakenAreTold) {
  using Lines = std::vector<std::string>;
  EXPECT_EQ(only("0 0 1 5 6\n1 2 1 5 6\n3 4 2 5 6\n").left_out, Lines{"2 further columns"});
  EXPECT_EQ(only("x,y,t\n0,0,1\n1,2,1\n3,4,2\n").left_out, Lines{"columns beside: t"});
  EXPECT_EQ(only("x,y,w\n0,0,1\n1,2,1\n3,4,2\n").left_out, Lines{});
  const auto asked = parse("x,y,t\n0,0,1\n1,2,1\n3,4,2\n", asking({"x", "y"}));
  EXPECT_EQ(asked->front().left_out, Lines{});
}

TEST(ReadPoints, NumbersOfThePointsAreNoCoordinates) {
  const RawCurve plane = only("1 1.0 0.01\n2 0.5 0.06\n3 0.0 0.02\n");
  EXPECT_FALSE(plane.has_z);
  EXPECT_EQ(plane.points[1], (Point3{0.5, 0.06, 0}));
  ASSERT_EQ(plane.left_out.size(), 1U);
  EXPECT_EQ(plane.left_out[0].substr(0, 33), "column 1, which counts the points");
  const RawCurve space = only("1;1.0;0.01;5.5\n2;0.5;0.06;6.5\n3;0.0;0.02;7.5\n");
  EXPECT_TRUE(space.has_z);
  EXPECT_EQ(space.points[2], (Point3{0, 0.02, 7.5}));
  for (const char* text : {"0 1.5 0.01\n1 0.5 0.06\n2 0.5 0.02\n", "1 1 0\n2 4 0\n3 9 1\n",
                           "1.0 1.5 2\n2.0 2 3\n3.0 4 5\n", "1 1.5 2\n2 2.5 3\n4 4.5 5\n"})
    EXPECT_TRUE(only(text).has_z && only(text).left_out.empty()) << text;
  const RawCurve headed = only("#\tx\ty\n1\t1.5\t0.1\n2\t0.5\t0.6\n3\t0.5\t0.2\n");
  EXPECT_EQ(headed.points[1], (Point3{0.5, 0.6, 0}));
  EXPECT_EQ(headed.left_out, std::vector<std::string>{"columns beside: #"});
  const auto asked = parse("1 1.5 0.1\n2 0.5 0.6\n3 0.5 0.2\n", asking({"1", "2", "3"}));
  EXPECT_EQ(asked->front().points[1], (Point3{2, 0.5, 0.6}));
}

// Fortran's F9.6 leaves no blank before a minus sign.
TEST(ReadPoints, NumbersOfFixedColumnsMayTouch) {
  const RawCurve curve = only("E 1\n 1.000000 0.001260\n 0.500000-0.039800\n-0.000100-0.000000\n");
  ASSERT_EQ(curve.points.size(), 3U);
  EXPECT_EQ(curve.points[1], (Point3{0.5, -0.0398, 0}));
  EXPECT_EQ(curve.points[2], (Point3{-0.0001, 0, 0}));
  EXPECT_EQ(only("1.0E-01-2.0E-01\n2.0E-01-3.0E-01\n3.0E-01-3.5E-01\n").points[0],
            (Point3{0.1, -0.2, 0}));
  EXPECT_EQ(only("0 0\n1 1\n2 2\n3-4 5\n").left_out,
            std::vector<std::string>{"line 4: 3-4 5"});  // without fractions: no such columns
}

TEST(ReadPoints, LednicerOfAnyScaleAndNumber) {
  const std::string sides = " 3. 3.\n\n0 0\n50 6\n100 0\n\n0 0\n50 -4\n100 0\n";
  const RawCurve percent = only("in percent\n" + sides);
  ASSERT_EQ(percent.points.size(), 6U);
  EXPECT_EQ(percent.points[0], (Point3{100, 0, 0}));
  EXPECT_EQ(percent.points[2], (Point3{0, 0, 0}));
  const auto two = parse("one\n" + sides + "two\n" + sides);
  ASSERT_TRUE(two) << two.error().message;
  ASSERT_EQ(two->size(), 2U);
  for (const RawCurve& one : *two) EXPECT_EQ(one.points.size(), 6U);
  // a curve of whole numbers that starts so by chance goes on as it is
  EXPECT_EQ(only("3 3\n4 9\n5 6\n7 7\n9 8\n8 9\n1 1\n").points.size(), 7U);
}

TEST(ReadPoints, WordsBehindANumberAreARemark) {
  const RawCurve curve = only("1 0\n0.5 0.1\n0 0\n12.0 % thick\n");
  EXPECT_EQ(curve.points.size(), 3U);
  EXPECT_EQ(curve.left_out, std::vector<std::string>{"line 4: 12.0 % thick"});
  EXPECT_FALSE(parse("1 0\n0.5 0.1\n0 0\n0.5 0.1x thick\n"));
}

/// ASCII as UTF-16 behind its mark.
std::string wide(const std::string& text, bool big) {
  std::string bytes = big ? "\xfe\xff" : "\xff\xfe";
  for (const char c : text) bytes += big ? std::string{'\0', c} : std::string{c, '\0'};
  return bytes;
}

TEST(ReadPoints, Utf16IsText) {
  for (const bool big : {false, true}) {
    const auto curves = parse(wide("E 1\r\n1 0.5\r\n2 0.25\r\n", big));
    ASSERT_TRUE(curves) << curves.error().message;
    EXPECT_EQ(curves->front().id, "E 1");
    ASSERT_EQ(curves->front().points.size(), 2U);
    EXPECT_EQ(curves->front().points[1], (Point3{2, 0.25, 0}));
  }
  // characters that the pieces in which a stream is read cut through
  std::string text;
  for (int i = 0; i < 40000; ++i) text += "1 2\n";
  for (const std::size_t shift : {0, 1, 2, 3}) {
    const auto curves = parse(wide("# " + std::string(shift, 'x') + "\n" + text, false));
    ASSERT_TRUE(curves) << curves.error().message;
    EXPECT_EQ(curves->front().points.size(), 40000U);
  }
}

// A number by itself behind the points is none of them; it is told.
TEST(ReadPoints, ALoneNumberBehindThePointsIsLeftOut) {
  const RawCurve foil = only("FOIL\n1 0\n0.5 0.1\n0 0\n0.5 -0.1\n1 0\n 12.5\n");
  EXPECT_EQ(foil.points.size(), 5U);
  EXPECT_EQ(foil.left_out, std::vector<std::string>{"line 7: 12.5"});
  EXPECT_EQ(only("1 0 2\n0.5 0.1 3\n0 0 1\n7\nend of file\n8\n").left_out.size(), 3U);
  // what may be half a row of a few, or has rows behind it, is refused
  EXPECT_EQ(parse("1 0\n0 0\n7\n").error().path, "data.csv:3");
  EXPECT_EQ(parse("1 0\n0 0\n1 1\n7\n2 2\n3 3\n4 4\n").error().path, "data.csv:4");
  EXPECT_EQ(parse("1 0\n0 0\n1 1\n7\n2 2\n").error().path, "data.csv:4");
  EXPECT_EQ(parse("1 0\n0 0\n1 1\n0.5\n2 2\n3 3\n4 4\n").error().path, "data.csv:4");
  EXPECT_TRUE(parse("1;0\n0;0\n1;1\n7;\n"));  // a missing entry
}

// Counts before the points of each curve, as GPC's and many others' polygons have them.
TEST(ReadPoints, CountsPartCurves) {
  const auto curves =
      parse("4\n0 0\n1 1\n2 1\n3 0\n3\n0 5\n1 6\n2 6\n5\n0 9\n1 9\n2 9\n3 9\n4 9\n");
  ASSERT_TRUE(curves) << curves.error().message;
  ASSERT_EQ(curves->size(), 3U);
  EXPECT_EQ((*curves)[0].points.size(), 4U);
  EXPECT_EQ((*curves)[1].points.size(), 3U);
  EXPECT_EQ((*curves)[2].points.back(), (Point3{4, 9, 0}));
  EXPECT_TRUE((*curves)[2].left_out.empty());
  EXPECT_EQ((*curves)[0].id, "");  // a count is no name
  EXPECT_EQ((*curves)[2].id, "#3");
  EXPECT_EQ(parse("4\n0 0\n1 1\n2 1\n3 0\n4\n0 5\n1 6\n2 6\n").error().path, "data.csv:6");
  EXPECT_EQ(parse("4\n0 0\n1 1\n2 1\n3 0\n4\n0 5\n1 6\n2 6\nend\n").error().path, "data.csv:6");
}

// The first title names the curve, further ones are told; so are names of columns that nobody looks
// for.
TEST(ReadPoints, WhatStandsBeforeTheRowsIsTold) {
  const RawCurve titled = only("E 387\nEppler\nof 1962\n1 0\n0 0\n1 0.1\n");
  EXPECT_EQ(titled.id, "E 387");
  EXPECT_EQ(titled.left_out, (std::vector<std::string>{"line 2: Eppler", "line 3: of 1962"}));
  EXPECT_TRUE(only("E 387\n1 0\n0 0\n1 0.1\n").left_out.empty());
  EXPECT_EQ(only("lat,lon\n1,0\n0,0\n1,0.1\n").left_out,
            std::vector<std::string>{"line 1: lat,lon: names no x and y: the first columns taken"});
  EXPECT_EQ(only("walk\nhome\nlat,lon\n1,0\n0,0\n1,0.1\n").left_out.size(), 2U);
}

// Surveys write northings first: taken for x they would mirror the line.
TEST(ReadPoints, EastingsAndNorthingsAreXAndY) {
  const RawCurve road = only("Northing,Easting,Elevation\n10,1,7\n20,2,8\n30,4,9\n");
  ASSERT_EQ(road.points.size(), 3U);
  EXPECT_EQ(road.points.back(), (Point3{4, 30, 0}));
  EXPECT_EQ(road.left_out, std::vector<std::string>{"columns beside: elevation"});
}

// A single row among what is none: where the others cannot be read tells more than that it is
// alone.
TEST(ReadPoints, ASingleRowIsNamedByWhatHidesTheOthers) {
  EXPECT_EQ(parse("0,0\n1;1\n2 0\n").error().path, "data.csv:3");
}

// Five lines of text are told one by one, the rest are counted.
TEST(ReadPoints, LinesLeftOutAreToldOrCounted) {
  const auto behind = [](int lines) {
    std::string text = "0 0\n1 1\n2 0\n";
    for (int i = 0; i < lines; ++i) text += "remark " + std::string(1, char('a' + i)) + "\n";
    return only(text).left_out;
  };
  EXPECT_EQ(behind(0).size(), 0U);
  ASSERT_EQ(behind(5).size(), 5U);
  EXPECT_EQ(behind(5)[4], "line 8: remark e");
  ASSERT_EQ(behind(6).size(), 6U);
  EXPECT_EQ(behind(6)[4], "line 8: remark e");
  EXPECT_EQ(behind(6)[5], "1 further line");
  ASSERT_EQ(behind(8).size(), 6U);
  EXPECT_EQ(behind(8)[5], "3 further lines");
}

}  // namespace
}  // namespace keyline::exchange
