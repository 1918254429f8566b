#include "keyline/exchange/points/points_nodes.h"

#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "keyline/exchange/points/points_reader.h"

namespace keyline::exchange {
namespace {

using core::Point3;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

core::Result<std::vector<acquire::RawCurve>> read(const std::string& text) {
  std::istringstream in(text);
  return read_points(in, "a");
}

std::string why_not(const std::string& text) {
  const auto curves = read(text);
  return curves ? std::string("it is read") : curves.error().message;
}

// Rows as in the manuals of Triangle and TetGen: number, coordinates, attributes, mark.
TEST(Nodes, TheirNumbersAndCountsAreNoCoordinates) {
  const auto box = read("# a box\n4 3 0 0\n1 0 0 0\n2 2 0 0\n3 2 2 0\n4 0 2 5\n");
  ASSERT_TRUE(box) << box.error().message;
  EXPECT_THAT(box->at(0).points,
              ElementsAre(Point3{0, 0, 0}, Point3{2, 0, 0}, Point3{2, 2, 0}, Point3{0, 2, 5}));
  EXPECT_TRUE(box->at(0).has_z);
  EXPECT_EQ(read("2 3 0 0\n1 0 0 0\n2 1 1 1\n")->at(0).points.size(), 2u);
  const auto plan = read("3 2 1 1\n0 1.5 7 9 1\n1 2 -8 9 1\n2 3 6 9 0\n");
  ASSERT_TRUE(plan) << plan.error().message;
  EXPECT_THAT(plan->at(0).points,
              ElementsAre(Point3{1.5, 7, 0}, Point3{2, -8, 0}, Point3{3, 6, 0}));
  EXPECT_FALSE(plan->at(0).has_z);
  EXPECT_THAT(plan->at(0).left_out, Contains("2 further columns"));
}

TEST(Nodes, WhatFollowsThemIsNoPoint) {
  const auto square = read(
      "4 2 0 1\n1 0 0 1\n2 2 0 1\n3 2 2 1\n4 0 2 1\n4 1\n1 1 2 1\n2 2 3 1\n3 3 4 1\n4 4 1 1\n0\n");
  ASSERT_TRUE(square) << square.error().message;
  EXPECT_EQ(square->at(0).points.size(), 4u);
  EXPECT_THAT(square->at(0).left_out, Contains("line 6: what follows the 4 nodes"));
}

TEST(Nodes, ThatAreNotThereAreMissed) {
  EXPECT_THAT(why_not("4 3 0 0\n1 0 0 0\n2 2 0 0\n3 2 2 0\n"), HasSubstr("only 3 of 4 nodes"));
  EXPECT_THAT(why_not("4 3 0 0\n1 0 0 0\n2 2 0 0\n4 2 2 0\n5 1 1 1\n"),
              HasSubstr("node 4 is out of turn"));
}

// A first row that counts nothing is a point: of other dimensions, of one point, before fractions.
TEST(Nodes, OtherRowsOfWholeNumbersArePoints) {
  for (const char* first : {"8 4 0 0", "1 3 0 0", "8 3 1 0", "8 2 0 2", "8.5 3 0 0", "-8 3 0 0"}) {
    const auto rows = read(std::string(first) + "\n1 0 0 0\n2 2 0 0\n3 2 2 0\n");
    ASSERT_TRUE(rows) << first << rows.error().message;
    EXPECT_EQ(rows->at(0).points.size(), 4u) << first;
  }
  EXPECT_EQ(read("8 3 0 0\n7 0 0 0\n2 2 0 0\n")->at(0).points.size(), 3u);
}

// Nodes have one mark or none.
TEST(Nodes, OfTwoMarksAreNone) {
  const auto rows = read("3 2 0 2\n1 0 0 5 6\n2 2 0 5 6\n3 2 2 5 6\n");
  ASSERT_TRUE(rows) << rows.error().message;
  EXPECT_EQ(rows->at(0).points[1], (Point3{2, 2, 0}));
}

// Tecplot's data format guide: variables by name, zones one behind the other.
TEST(Tecplot, VariablesNameTheColumnsAndZonesTheCurves) {
  const std::string rows = "0 0 1\n1 0.5 2\n2 0.7 3\n3 0.6 4\n";
  const auto wing =
      read("TITLE = \"wing\"\nVARIABLES = \"P\", \"X\", \"Y\"\nZONE T=\"upper\", I=4\n" + rows +
           "ZONE T=\"lower\", I=4\n" + rows);
  ASSERT_TRUE(wing) << wing.error().message;
  ASSERT_EQ(wing->size(), 2u);
  EXPECT_THAT(wing->at(1).points, ElementsAre(Point3{0, 1, 0}, Point3{0.5, 2, 0}, Point3{0.7, 3, 0},
                                              Point3{0.6, 4, 0}));
  EXPECT_THAT(wing->at(1).id, HasSubstr("lower"));
  EXPECT_THAT(wing->at(0).left_out, Contains("columns beside: p"));
  EXPECT_EQ(read("variables = x y z\nzone i=4\n" + rows)->at(0).points[3], (Point3{3, 0.6, 4}));
}

// The guide's own examples name one variable to a line, and go on with a zone in further lines.
TEST(Tecplot, RecordsGoOnInTheLinesBehind) {
  const std::string rows = "0 0 1\n1 0.5 2\n2 0.7 3\n3 0.6 4\n";
  for (const char* names : {"VARIABLES = \"P\"\n\"X\"\n\"Y\"\n", "VARIABLES = \"P\" \"X\"\n\"Y\"\n",
                            "VARIABLES=\"P\"\n\"X\", \"Y\"\n"}) {
    const auto wing =
        read(std::string("TITLE = \"a wing\"\n") + names +
             "ZONE T=\"upper side\"\n STRANDID=0, SOLUTIONTIME=0\n I=4, DATAPACKING=POINT\n "
             "DT=(SINGLE SINGLE SINGLE )\n" +
             rows + "ZONE T=\"lower side\"\n I=4\n" + rows);
    ASSERT_TRUE(wing) << names << wing.error().message;
    ASSERT_EQ(wing->size(), 2u);
    EXPECT_EQ(wing->at(0).id, "upper side");
    EXPECT_EQ(wing->at(1).id, "lower side");
    EXPECT_THAT(wing->at(1).points, ElementsAre(Point3{0, 1, 0}, Point3{0.5, 2, 0},
                                                Point3{0.7, 3, 0}, Point3{0.6, 4, 0}));
    EXPECT_THAT(wing->at(0).left_out, Contains("columns beside: p"));
    EXPECT_THAT(wing->at(0).left_out, Contains("line 1: TITLE = \"a wing\""));
  }
  EXPECT_THAT(
      why_not("VARIABLES = \"X\", \"Y\"\nZONE T=\"a\"\n I=2\n DATAPACKING=BLOCK\n0 1\n2 3\n"),
      HasSubstr("no list of points"));
}

// The data format guide: an ordered zone has I times J times K points.
TEST(Tecplot, ZonesHaveThePointsTheyTell) {
  const std::string head = "VARIABLES = \"X\", \"Y\"\n", four = "0 0\n1 1\n2 1.5\n3 1\n";
  const auto why = [&](const std::string& first, const std::string& second) {
    const auto curves = read(head + first + "\n" + four + second + "\n" + four);
    return curves ? std::string() : curves.error().path + ": " + curves.error().message;
  };
  EXPECT_EQ(why("ZONE T=\"a\", I=4", "ZONE T=\"b\" I=4, J=1, K=1"), "");
  EXPECT_EQ(why("ZONE I=2, J=2", "ZONE T=\"b\""), "");
  EXPECT_EQ(why("ZONE T=\"I=9\", I=4", "zone t=\"b\"\n i = 4"), "");
  EXPECT_EQ(why("ZONE T=\"a\", I=5", "ZONE T=\"b\", I=4"),
            "a:2: a zone of 5 points (I, J, K), and 4 rows behind it");
  EXPECT_EQ(why("ZONE T=\"a\", I=4", "ZONE T=\"b\"\n I=2, J=3"),
            "a:7: a zone of 6 points (I, J, K), and 4 rows behind it");
  EXPECT_EQ(why("ZONE T=\"a\", I=3", "ZONE T=\"b\", I=4"),
            "a:2: a zone of 3 points (I, J, K), and 4 rows behind it");
}

TEST(Tecplot, TitlesAreWhatStandsInQuotes) {
  EXPECT_EQ(read("TITLE = \"a wing\"\nVARIABLES = \"X\" \"Y\"\n0 1\n1 2\n2 2\n")->at(0).id,
            "a wing");
  const auto unnamed = read("VARIABLES = \"alpha\" \"cl\"\n0 1\n1 2\n2 2\n");
  EXPECT_EQ(unnamed->at(0).id, "");
  EXPECT_THAT(unnamed->at(0).left_out,
              Contains("VARIABLES = \"alpha\", \"cl\": names no x and y: the first columns taken"));
}

TEST(Tecplot, ZonesOfBlocksAndElementsAreRefused) {
  const std::string rows = "0 1 2 3\n0 0.5 0.7 0.6\n";
  for (const char* zone :
       {"ZONE I=4, DATAPACKING=BLOCK", "zone i=4 f=block", "ZONE I=4, F = BLOCK",
        "ZONE N=4, E=2, F=FEPOINT, ET=TRIANGLE", "ZONE N=4 E=2 ZONETYPE=FEQUADRILATERAL"})
    EXPECT_THAT(why_not(std::string("VARIABLES = \"X\", \"Y\"\n") + zone + "\n" + rows),
                HasSubstr("no list of points"))
        << zone;
  EXPECT_EQ(
      why_not(
          "VARIABLES = \"X\", \"Y\"\nZONE T=\"f=block\", I=3, DATAPACKING=POINT\n0 1\n1 2\n2 2\n"),
      "it is read");
}

}  // namespace
}  // namespace keyline::exchange
