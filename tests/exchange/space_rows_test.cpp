#include "keyline/exchange/points/space_rows.h"

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "keyline/exchange/mesh/mesh.h"
#include "keyline/exchange/mesh/section_file.h"
#include "keyline/exchange/points/lattice_reader.h"
#include "keyline/exchange/points/points_reader.h"

namespace keyline::exchange {
namespace {

using core::Point3;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

struct Cloud {
  std::vector<Point3> points;
  StreamedPoints beside;
  std::string failure;
};

/// A cloud of that text, as --section streams it.
Cloud cloud(const std::string& text) {
  const auto file = std::filesystem::temp_directory_path() /
                    ("keyline-rows-" + std::to_string(::getpid()) + ".csv");
  std::ofstream(file) << text;
  Cloud cloud;
  auto read = stream_points(file, [&](Point3 p) { cloud.points.push_back(p); });
  std::filesystem::remove(file);
  if (read)
    cloud.beside = std::move(*read);
  else
    cloud.failure = read.error().path.substr(file.string().size()) + " " + read.error().message;
  return cloud;
}

// What a header names x is x; the number of a point is none.
TEST(SpaceRows, ACloudsHeaderNamesItsColumnsAndUnit) {
  const Cloud numbered = cloud("Point,X [m],Y [m],Z [m]\n1,10,0,-1\n2,11,0.5,-0.75\n");
  EXPECT_THAT(numbered.points, ElementsAre(Point3{10, 0, -1}, Point3{11, 0.5, -0.75}));
  EXPECT_EQ(numbered.beside.unit, "m");
  EXPECT_THAT(numbered.beside.left_out, ElementsAre("columns beside: point"));
  EXPECT_THAT(cloud("z,x,y\n-0.5,10,0\n").points, ElementsAre(Point3{10, 0, -0.5}));
  const Cloud comma = cloud("X [m];Y [m];Z [m]\n10;0;-1\n10,5;0;-0,5\n");
  EXPECT_THAT(comma.points, ElementsAre(Point3{10, 0, -1}, Point3{10.5, 0, -0.5}));
  EXPECT_EQ(comma.beside.unit, "m");
  EXPECT_THAT(cloud("3\n// z y x\n// units: mm\n1 2 3\n4 5 6\n7 8 9\n").points[1],
              (Point3{6, 5, 4}));
  EXPECT_EQ(cloud("# units: mm\n1 2 3\n").beside.unit, "mm");
}

TEST(SpaceRows, ACloudTellsColumnsThatItDoesNotTake) {
  EXPECT_THAT(cloud("1 2 3\n4 5 6\n").beside.left_out, IsEmpty());
  EXPECT_THAT(cloud("1 2 3 9 9\n4 5 6 9 9\n").beside.left_out, ElementsAre("2 further columns"));
  EXPECT_THAT(cloud("P1;1;2;3\nP2;4;5;6\n").points, ElementsAre(Point3{1, 2, 3}, Point3{4, 5, 6}));
  EXPECT_THAT(cloud("5 4\n1 2 3\n").beside.left_out,
              ElementsAre("line 1: 2 numbers before the points"));
}

// What would be the first point is none of the file's titles.
TEST(SpaceRows, AFirstRowWithAMistakeIsRefused) {
  const std::string why = "text where a number belongs: '0 0 O.5'";
  EXPECT_EQ(cloud("0 0 O.5\n1 0 2\n2 0 3\n").failure, ":1 " + why);
  EXPECT_EQ(cloud("x y z\n0 0 O.5\n1 0 2\n").failure, ":2 three numbers (x y z) are needed here");
  std::istringstream in("0 0 O.5\n1 0 2\n2 0 3\n\n0 1 2\n1 1 3\n");
  const auto read = read_lattice(in, "file");
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().path + " " + read.error().message, "file:1 " + why);
}

TEST(SpaceRows, TitlesAreTold) {
  EXPECT_THAT(cloud("Hull 7\nscan of May\n1 2 3\n4 5 6\n").beside.left_out,
              ElementsAre("line 1: Hull 7", "line 2: scan of May"));
  EXPECT_THAT(cloud("10 x 20\n1 2 3\n4 5 6\n").beside.left_out, ElementsAre("line 1: 10 x 20"));
  std::istringstream in("the bow\n0 0 1\n1 0 2\n\n0 1 2\n1 1 3\n");
  EXPECT_THAT(read_lattice(in, "file")->left_out, ElementsAre("line 1: the bow"));
}

TEST(SpaceRows, ATableOfThePlaneIsNoCloud) {
  EXPECT_EQ(cloud("0 0\n1 1\n2 4\n3 9\n").failure, ":3 three numbers (x y z) are needed here");
}

TEST(SpaceRows, ACloudsRowsHaveTheColumnsOfTheFirst) {
  EXPECT_EQ(cloud("x y z i\n0 1 2 7\n1 3.5 9\n").failure, ":3 3 columns where the first row has 4");
  EXPECT_EQ(cloud("x\ty\tz\ti\n0\t1\t2\t7\n1\t3.5\t9\t\n").points.size(), 2U);
  EXPECT_THAT(cloud("1 2 3\n4 5 6 7\n8 9 10 11\n").beside.left_out,
              ElementsAre("of 2 rows what stands behind column 3"));
  EXPECT_EQ(cloud("1,2,3\n4,5,6,7\n").failure, ":2 4 columns where the first row has 3");
}

TEST(SpaceRows, ACloudOfDecimalCommasAndCommasIsRefused) {
  const std::string rows = "10,000, 0,000, -0,500\n10,000, 0,000, -0,400\n";
  EXPECT_EQ(cloud(rows).failure, ":1 commas that part columns or fractions");
  EXPECT_EQ(cloud("x,y,z\n" + rows).failure, ":2 6 columns below a header of 3");
}

TEST(SpaceRows, ACloudWhoseHeaderNamesNoZIsRefused) {
  EXPECT_EQ(cloud("x,y,height\n1,2,3\n4,5,6\n").failure,
            ":2 these columns are not x, y and z of points in space");
  EXPECT_THAT(cloud("x [m],y [m],z [mm]\n1,2,3\n").failure, HasSubstr("two units, m and mm"));
}

TEST(SpaceRows, ASectionHasTheUnitOfItsCloud) {
  const auto file = std::filesystem::temp_directory_path() /
                    ("keyline-unit-" + std::to_string(::getpid()) + ".csv");
  std::ofstream(file) << "z [cm],x [cm],y [cm]\n0,0,0\n0,1,0\n0,2,0\n0,3,0\n5,0,9\n";
  const auto cut = section_of_file(file, parse_section("y=0").value());
  std::filesystem::remove(file);
  ASSERT_TRUE(cut) << cut.error().message;
  EXPECT_EQ(cut->unit, "cm");
  EXPECT_EQ(cut->curves.at(0).points.size(), 4U);
}

TEST(SpaceRows, ALatticesHeaderNamesItsColumnsAndUnit) {
  const std::string rows = "0,1,2\n0.5,2,3\n\n0,1,3\n0.5,2,4\n";
  const auto read = [&](const std::string& header, const PointsOptions& options = {}) {
    std::istringstream in(header + rows);
    return read_lattice(in, "file", options);
  };
  const auto named = read("Z [m],X [m],Y [m]\n");
  ASSERT_TRUE(named) << named.error().message;
  EXPECT_THAT(named->lattice.points,
              ElementsAre(Point3{1, 2, 0}, Point3{2, 3, 0.5}, Point3{1, 3, 0}, Point3{2, 4, 0.5}));
  EXPECT_EQ(named->unit, "m");
  EXPECT_EQ(read("2,2\nz,x,y\n")->lattice.points[1], (Point3{2, 3, 0.5}));
  EXPECT_EQ(read("")->lattice.points[1], (Point3{0.5, 2, 3}));
  EXPECT_EQ(read("a,b,c\n")->lattice.points[1], (Point3{0.5, 2, 3}));
  EXPECT_THAT(read("a,b,c\n")->left_out, ElementsAre(HasSubstr("names no x and y")));
  PointsOptions asked;
  asked.columns = {"2", "3", "1"};
  EXPECT_EQ(read("", asked)->lattice.points[1], (Point3{2, 3, 0.5}));
  const auto height = read("x,y,height\n");
  ASSERT_FALSE(height);
  EXPECT_EQ(height.error().path, "file:2");
  EXPECT_EQ(read("x,y,z\n0,0\n").error().message, "row 1 has 2 points, the first row 3");
}

// The matrix of a PTX moves its points by (10, 20, 30); neither it nor the scanner's place and axes
// are points.
TEST(SpaceRows, ScansInPtxAreRefusedByEveryReader) {
  const std::string text =
      "3\n1\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n10 20 30 1\n"
      "0 0 0 0.5\n1 0.5 0 0.5\n2 0.8 0 0.5\n";
  for (const char* name : {"scan.PTX", "scan.xyz", "scan.txt"}) {
    const auto file =
        std::filesystem::temp_directory_path() / ("keyline-" + std::to_string(::getpid()) + name);
    std::ofstream(file) << text;
    const auto curves = read_points(file);
    const auto lattice = read_lattice(file);
    const auto cloud = section_of_file(file, parse_section("z=0").value(), 1);
    std::filesystem::remove(file);
    ASSERT_FALSE(curves) << name;
    ASSERT_FALSE(lattice) << name;
    ASSERT_FALSE(cloud) << name;
    for (const core::Failure& failure : {curves.error(), lattice.error(), cloud.error()}) {
      EXPECT_THAT(failure.message, HasSubstr("PTX"));
      EXPECT_EQ(failure.path, file.string());
      EXPECT_EQ(failure.hint, "convert it to PTS, XYZ or PLY");
    }
  }
}

// Counts and rows of three are the head of a PTX only with its matrix behind them.
TEST(SpaceRows, PointsThatBeginLikeAPtxAreRead) {
  std::istringstream in("3\n1\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0\n0 1 0\n2 0 1\n3 0 1\n");
  EXPECT_TRUE(read_points(in, "scan.xyz"));
}

}  // namespace
}  // namespace keyline::exchange
