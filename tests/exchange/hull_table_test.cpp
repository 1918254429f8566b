#include "keyline/exchange/points/hull_table.h"

#include <cmath>
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "keyline/exchange/cad/planar_form.h"
#include "keyline/exchange/document_file.h"
#include "keyline/exchange/json/json_hull.h"

#include "tests/shared_data.h"

namespace keyline::exchange {
namespace {

using core::Point3;

constexpr const char* kTable =
    "waterline,0,10,20,30\n"
    "0,,0,0,\n"
    "1,0,1,2,0\n"
    "2,0.5,2,4,1\n";

const curve::Polyline3& line(const document::Document& d, const std::string& name) {
  for (const auto& named : d.space_curves)
    if (named.label.name == name) return std::get<curve::Polyline3>(named.curve.value);
  throw std::runtime_error(name);
}

TEST(HullTable, GivesWaterlinesStationsAndButtocks) {
  const auto table = read_hull_csv(kTable);
  ASSERT_TRUE(table) << table.error().message;
  const auto d = hull_document(*table);
  EXPECT_EQ(line(d, "waterline-2").points.front(), (Point3{0, 0, 1}));
  EXPECT_EQ(line(d, "station-3").points, (std::vector<Point3>{{20, 0, 0}, {20, 2, 1}, {20, 4, 2}}));
  EXPECT_EQ(line(d, "buttock-1").points,
            (std::vector<Point3>{{10, 1, 1}, {20, 1, 0.5}, {30, 1, 2}}));
  EXPECT_EQ(line(d, "buttock-2").points.size(), 2U);
  EXPECT_EQ(d.skipped.size(), 1U);  // the keel and the third buttock
}

TEST(HullTable, RowsMayBeStations) {
  const auto a = read_hull_csv(kTable);
  const auto b = read_hull_csv("station;0;1;2\n0;;0;0,5\n10;0;1;2\n20;0;2;4\n30;;0;1\n");
  ASSERT_TRUE(a && b);
  EXPECT_EQ(hull_document(*a).space_curves.size(), hull_document(*b).space_curves.size());
  EXPECT_EQ(line(hull_document(*a), "buttock-1").points,
            line(hull_document(*b), "buttock-1").points);
}

TEST(HullTable, MistakesHaveTheirPlace) {
  EXPECT_EQ(read_hull_csv("waterline,0,10\n0,1,x\n").error().path, "line 2");
  EXPECT_EQ(read_hull_csv("waterline,0,10\n0,1,2,3\n").error().path, "line 2");
  EXPECT_EQ(read_hull_csv("waterline,0,,10\n0,1,2,3\n").error().path, "line 1");
  auto j = nlohmann::json::parse(R"({"attributes":{"LOA":10,"BOA":4,"Depth":2},
    "halfBreadths":{"waterlines":[0,1],"stations":[0,0.5,1],"table":[[null,0.5,0],[0,1]]}})");
  EXPECT_EQ(hull_from_json(j).error().path, "halfBreadths.table[1]");
  j["halfBreadths"]["table"][1] = {0, 1, 0.5};
  const auto table = hull_from_json(j);
  ASSERT_TRUE(table);
  auto wrong = j;
  wrong["halfBreadths"]["table"][0] = {0, 1, -1e-9};
  EXPECT_EQ(hull_from_json(wrong).error().path, "halfBreadths.table[0][2]");
  wrong["halfBreadths"]["table"][0] = {0, 1e300, 0};
  wrong["attributes"]["BOA"] = 1e300;  // their product is no number
  EXPECT_EQ(hull_from_json(wrong).error().path, "halfBreadths.table[0][1]");
  EXPECT_EQ(line(hull_document(*table), "waterline-2").points[1], (Point3{5, 2, 2}));
}

// Cells that are not there are outside the hull, as empty ones are; that is told.
TEST(HullCsv, RowsCutShortAndRepeatedAreTold) {
  const auto told = [](const std::string& text) {
    const auto table = read_hull_csv(text);
    if (!table) return table.error().path + ": " + table.error().message;
    return table->left_out.empty() ? std::string() : table->left_out.front();
  };
  EXPECT_EQ(told("waterline,0,10,20\n0,1,,\n1,1,2,3\n"), "");
  EXPECT_EQ(told("waterline,0,10,20\n0,1\n1,1,2,3\n"),
            "line 2: 2 cells fewer than in the first line: outside the hull");
  EXPECT_EQ(told("waterline,0,10,20\n"), "line 1: the table has no rows");
  EXPECT_EQ(told("waterline,0,10,20\n0,1,2,3\n1,1,2,3\n0,1,2,4\n"),
            "line 4: a waterline stands twice");
  EXPECT_EQ(told("# yacht\nwaterline,0,10,0\n0,1,2,3\n"), "line 2: a station stands twice");
  EXPECT_EQ(told("station,0,10\n5,1,2\n5,1,2\n"), "line 3: a station stands twice");
}

// The names of waterlines or stations before their numbers: read, and told.
TEST(HullCsv, NumbersMayStandBehindNames) {
  const std::string named = "station [m],WL 0,WL 0.5,wl1\nSt 0,0,0.2,0.4\n2.5,0.1,0.6,0.9\n";
  ASSERT_TRUE(is_hull_csv(named));
  const auto table = read_hull_csv(named);
  ASSERT_TRUE(table) << table.error().message;
  EXPECT_EQ(table->unit, "m");
  EXPECT_EQ(table->stations, (std::vector<double>{0, 2.5}));
  EXPECT_EQ(table->waterlines, (std::vector<double>{0, 0.5, 1}));
  EXPECT_EQ(table->half_breadth, (std::vector<double>{0, 0.1, 0.2, 0.6, 0.4, 0.9}));
  ASSERT_EQ(table->left_out.size(), 1U);
  EXPECT_THAT(table->left_out[0], testing::HasSubstr("\"WL 0\" and its like"));
  const auto below = read_hull_csv("station,WL -0.5,WL .5\n0,0.1,0.2\n1,0.3,0.4\n");
  ASSERT_TRUE(below) << below.error().message;
  EXPECT_EQ(below->waterlines, (std::vector<double>{-0.5, 0.5}));
  EXPECT_TRUE(is_hull_csv("WL;Station 0;Station 2\n1;0;1\n"));
  EXPECT_FALSE(is_hull_csv("station,speed 1,speed 2\n0,1,2\n"));
  EXPECT_FALSE(is_hull_csv("station,st 1,st 2\n0,1,2\n"));
}

TEST(HullCsv, ReadsShipyardsTables) {
  const auto yard = read_hull_csv(
      "# yacht\nunits,ft\nStation\\WL,2-0-0,1-6-0\n1,3-4-4,3-0-6+\n0,-,1/2\n2,--,2 3/4\n");
  ASSERT_TRUE(yard) << yard.error().message;
  EXPECT_EQ(yard->unit, "ft");
  EXPECT_EQ(yard->stations, (std::vector<double>{0, 1, 2}));
  EXPECT_EQ(yard->waterlines, (std::vector<double>{1.5, 2}));
  ASSERT_EQ(yard->half_breadth.size(), 6U);
  EXPECT_DOUBLE_EQ(yard->half_breadth[0], 0.5);
  EXPECT_DOUBLE_EQ(yard->half_breadth[1], 3 + (0 + 6.5 / 8) / 12);
  EXPECT_DOUBLE_EQ(yard->half_breadth[2], 2.75);
  EXPECT_TRUE(std::isnan(yard->half_breadth[3]));
  EXPECT_DOUBLE_EQ(yard->half_breadth[4], 3 + 4.5 / 12);
  const auto metres = read_hull_csv("WL [m]\t0\t5\n0.5\t1\t2\n1\t1.5\t2.5\n");
  ASSERT_TRUE(metres);
  EXPECT_EQ(hull_document(*metres).unit, "m");
  EXPECT_FALSE(read_hull_csv("wl,0,5\n1,1,2\n1,2,3\n"));
  EXPECT_FALSE(is_hull_csv("station,x,y\n1,2,3\n"));
  EXPECT_FALSE(is_hull_csv("x,y\n1,2\n"));
  EXPECT_FALSE(is_hull_csv("1,2\n3,4\n"));
  EXPECT_FALSE(is_hull_csv(";\n1;2\n"));
  EXPECT_TRUE(read_hull_csv(";\nwaterline;0;10\n1;2;3\n2;3;4\n"));
}

TEST(HullCsv, AreInOneUnit) {
  const auto unit = [](const std::string& text) {
    const auto table = read_hull_csv(text + ",0,10\n0,1,2\n1,2,3\n");
    return table ? table->unit : table.error().path + ": " + table.error().message;
  };
  EXPECT_EQ(unit("unit,m\nwaterline [m]"), "m");
  EXPECT_EQ(unit("unit,ft\nwaterline [m]"), "line 2: the table is in two units, one of them m");
}

// What lies beyond the centre plane is no half-breadth; below the base line there is hull.
TEST(HullCsv, HalfBreadthsAreNotNegative) {
  const auto why = [](const std::string& cell) {
    const auto table = read_hull_csv("waterline,-1,1\n-0.5,1,2\n1,0," + cell + "\n");
    return table ? "" : table.error().path + ": " + table.error().message;
  };
  EXPECT_EQ(why("0"), "");
  EXPECT_EQ(why("-"), "");
  EXPECT_EQ(why("-0"), "");
  EXPECT_EQ(why("-0.001"), "line 3: the half-breadth in column 3 is negative");
}

// Twelve inches are a foot and eight eighths an inch: who writes them means something else.
TEST(HullCsv, FeetHaveTwelveInchesOfEightEighths) {
  const auto first = [](const std::string& cell) {
    const auto table = read_hull_csv("units,ft\nStation\\WL,1,2\n0," + cell + ",1\n1,1,1\n");
    return table ? table->half_breadth.front() : -1;
  };
  EXPECT_DOUBLE_EQ(first("3-11-7"), 3 + (11 + 7.0 / 8) / 12);
  EXPECT_DOUBLE_EQ(first("3-11-7+"), 3 + (11 + 7.5 / 8) / 12);
  EXPECT_DOUBLE_EQ(first("3-11-7-"), 3 + (11 + 6.5 / 8) / 12);
  EXPECT_DOUBLE_EQ(first("0-0-1"), 1.0 / 96);
  for (const char* none : {"3-12-0", "3-0-8", "3-11-7*", "3-1", "3--1", "1/0", "1 1/", "1 1/2x"})
    EXPECT_EQ(first(none), -1) << none;
}

// Who writes feet-inches-eighths means feet; of a table in another unit they are none of its
// numbers.
TEST(HullCsv, FeetInchesEighthsAreInFeet) {
  const auto unit = [](const std::string& before, const std::string& cell) {
    const auto table = read_hull_csv(before + "Station,1,2\n0," + cell + ",1\n1,1,1\n");
    return table ? table->unit : table.error().path;
  };
  EXPECT_EQ(unit("", "0-6-0"), "ft");
  EXPECT_EQ(unit("units,ft\n", "0-6-0"), "ft");
  EXPECT_EQ(unit("units,m\n", "0-6-0"), "line 3");
  EXPECT_EQ(unit("", "0.5"), "");
  EXPECT_EQ(unit("units,m\n", "0.5"), "m");
}

TEST(HullTable, LinesAreMadePlanar) {
  auto d = hull_document(read_hull_csv(kTable).value());
  const std::size_t count = d.space_curves.size();
  const std::vector<Laid> planes = flatten(d);
  EXPECT_EQ(d.paths.size(), count);
  EXPECT_EQ(d.paths[0].label.name, "waterline-2");
  EXPECT_EQ(in_words(planes.at(0).plane), "in the plane z = 1; x and y");
  EXPECT_EQ(evaluate(d.paths[0].path, 1), (core::Point2{30, 0}));
  document::Document twisted;
  twisted.space_curves.push_back(
      {{"t", "", ""}, {curve::Polyline3{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 1}}}}});
  flatten(twisted);
  EXPECT_EQ(twisted.space_curves.size(), 1U);
}

TEST(HullTable, ReadsTheSharedHull) {
  const std::filesystem::path file = KEYLINE_SHARED_DATA "/1_profiles/hull/gunnerus.json";
  KEYLINE_NEEDS_SHARED_DATA(std::filesystem::exists(file), file);
  const auto d = read_document(file);
  ASSERT_TRUE(d) << d.error().message;
  // 16 waterlines, 64 stations and 3 buttocks, of which one line has a single point.
  EXPECT_EQ(d->space_curves.size(), 82U);
  EXPECT_EQ(extent(*d) > 36 && extent(*d) < 38, true);
}

}  // namespace
}  // namespace keyline::exchange
