#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/exchange/points/points_reader.h"

namespace keyline::exchange {
namespace {

using acquire::RawCurve;
using core::Point3;

std::vector<RawCurve> curves_of(const std::string& text, const PointsOptions& options = {}) {
  std::istringstream in(text);
  auto read = read_points(in, "data.csv", options);
  EXPECT_TRUE(read) << text << read.error().message;
  return read ? std::move(*read) : std::vector<RawCurve>{};
}

std::string names_of(const std::vector<RawCurve>& curves) {
  std::string all;
  for (const RawCurve& curve : curves)
    all += curve.id + ":" + std::to_string(curve.points.size()) + (curve.has_z ? "z " : " ");
  return all;
}

// Upper and lower y over the same x, whatever they are called: two planar curves.
TEST(PointsSides, AreKnownByTheHeader) {
  for (const auto& [header, names] :
       {std::pair{"x,yu,yl", "yu:3 yl:3 "},
        {"x,y_upper,y_lower", "y_upper:3 y_lower:3 "},
        {"station,upper,lower", "upper:3 lower:3 "},
        {"x/c,y/c upper,y/c lower", "y/c upper:3 y/c lower:3 "},
        {"X [mm],Z top [mm],Z bottom [mm]", "Z top:3 Z bottom:3 "},
        {"x,y (upper),y (lower)", "y (upper):3 y (lower):3 "},
        {"x,yo,yu", "yo:3 yu:3 "},
        {"Station,Oberseite,Unterseite", "Oberseite:3 Unterseite:3 "}}) {
    const auto curves = curves_of(std::string(header) + "\n0,0,0\n0.5,0.1,-0.05\n1,0.01,-0.01\n");
    ASSERT_EQ(names_of(curves), names) << header;
    EXPECT_EQ(curves[0].points[1], (Point3{0.5, 0.1, 0})) << header;
    EXPECT_EQ(curves[1].points[1], (Point3{0.5, -0.05, 0})) << header;
    EXPECT_TRUE(curves[0].left_out.empty()) << header;
  }
}

// The order of the columns is that of the curves; titles stand before their names.
TEST(PointsSides, StandInAnyOrder) {
  const auto curves = curves_of("wing\nyl x yu\n-1 0 1\n-2 1 2\n\n-3 2 3\n");
  ASSERT_EQ(names_of(curves), "wing/yl:3 wing/yu:3 ");
  EXPECT_EQ(curves[0].points[2], (Point3{2, -3, 0}));
  EXPECT_EQ(curves[1].points[2], (Point3{2, 3, 0}));
  EXPECT_EQ(names_of(curves_of("id,x,yu,yl\na,0,1,2\na,1,1,2\nb,0,1,2\nb,1,1,2\n")),
            "a/yu:2 a/yl:2 b/yu:2 b/yl:2 ");
  EXPECT_EQ(names_of(curves_of("# x yu yl\n1 0 0\n2 1 -1\n3 0 0\n")), "yu:3 yl:3 ");
}

// An x for each side; the longer one goes on behind the other's end.
TEST(PointsSides, MayHaveAnXEach) {
  const auto curves = curves_of("xu,yu,xl,yl\n0,0,0,0\n0.4,1,0.6,-1\n1,0,1,0\n2,5,,\n");
  ASSERT_EQ(names_of(curves), "yu:4 yl:3 ");
  EXPECT_EQ(curves[1].points[1], (Point3{0.6, -1, 0}));
  EXPECT_EQ(names_of(curves_of("x_l;y_l;x_u;y_u\n0;0;0;0\n1;1;1;1\n;;2;2\n")), "y_l:2 y_u:3 ");
}

// Of two units the table is refused; other columns beside are told.
TEST(PointsSides, KeepWhatTablesDo) {
  std::istringstream two("x [mm],yu [in],yl [in]\n0,1,2\n1,1,2\n");
  EXPECT_FALSE(read_points(two, "data.csv"));
  const auto curves = curves_of("x,yu,yl,cp\n0,0,0,9\n1,1,-1,9\n2,0,0,9\n");
  ASSERT_EQ(names_of(curves), "yu:3 yl:3 ");
  EXPECT_EQ(curves[0].left_out, std::vector<std::string>{"columns beside: cp"});
  PointsOptions asked;
  asked.columns = {"x", "yl"};
  EXPECT_EQ(names_of(curves_of("x,yu,yl\n0,1,2\n1,1,2\n", asked)), ":2 ");
}

std::string why(const std::string& text) {
  std::istringstream in(text);
  const auto read = read_points(in, "data.csv");
  return read ? "" : read.error().message;
}

// A micrometre beside a millimetre is a second unit, whether documents know it or not.
TEST(PointsUnits, OneThatIsNotKnownBesideAKnownOneIsRefused) {
  const std::string why_two = "the header gives the coordinates two units, mm and um";
  for (const char* header : {"x [mm],z [um]", "z [um],x [mm]", "x,z\nmm,um", "x,z\num,mm",
                             "x,z\n[mm],[um]", "x,z\n(mm),(um)", "x,z\n\"mm\",\"um\""})
    EXPECT_EQ(why(std::string(header) + "\n0,1000\n1,2000\n"), why_two) << header;
  for (const char* header : {"x,y,t\nmm,mm,s", "x,y,z\nmm,mm,-", "x,y,name\nmm,mm,text"})
    EXPECT_EQ(why(std::string(header) + "\n0,1,2\n1,2,3\n"), "") << header;
  const auto round = curves_of("x (mm),z (um)\n0,1000\n1,2000\n");
  EXPECT_EQ(round.at(0).left_out,
            std::vector<std::string>{"line 1: (um) behind the name of column 2, which is none of "
                                     "mm, cm, m, km, in, ft, pt, px"});
}

// In round brackets other words may stand: they are called no unit, and once.
TEST(PointsUnits, AWordInRoundBracketsIsToldOnceAsItStands) {
  EXPECT_EQ(curves_of("x (east),y (east)\n0,1\n1,2\n").at(0).left_out,
            std::vector<std::string>{"line 1: (east) behind the name of column 1, which is none of "
                                     "mm, cm, m, km, in, ft, pt, px"});
}

// "in" is a unit, or the name of a curve whose numbers have decimal commas.
TEST(PointsUnits, ARowOfNumbersIsNoneOfUnits) {
  const auto curves = curves_of("id;x;y\nin;1,5;2,5\nin;2,5;3\nin;3,5;3\n");
  ASSERT_EQ(names_of(curves), "in:3 ");
  EXPECT_EQ(curves[0].points[0], (Point3{1.5, 2.5, 0}));
}

// y with a band about it, prices, words of a title: no sides.
TEST(PointsSides, AreNotGuessed) {
  EXPECT_EQ(names_of(curves_of("x,y,y_upper,y_lower\n0,1,2,0\n1,1,2,0\n")), ":2 ");
  EXPECT_EQ(names_of(curves_of("x,u,l\n0,1,2\n1,1,2\n")), ":2z ");
  EXPECT_EQ(names_of(curves_of("mean,upper,lower\n0,1,2\n1,1,2\n")), ":2z ");
  EXPECT_EQ(names_of(curves_of("x,yu,yl,z\n0,1,2,3\n1,1,2,3\n")), ":2 ");  // x and z
  EXPECT_EQ(curves_of("x upper lower of wing 7\n0 1 2\n1 1 2\n")[0].id, "x upper lower of wing 7");
}

// Rows of more columns than the header has names: told, or refused where a decimal comma makes two
// of one number.
TEST(PointsColumns, WithoutANameAreTold) {
  EXPECT_EQ(curves_of("x,y\n0.5,1,7\n1.5,1,8\n")[0].left_out,
            std::vector<std::string>{"1 further column"});
  for (const char* text : {"x,y\n0,5,1,25\n1,5,2,25\n", "time,value\n0,5,1,25\n1,5,2,25\n",
                           "id,x,y\na,0,5,1,25\na,1,5,2,25\n"}) {
    std::istringstream in(text);
    const auto read = read_points(in, "data.csv");
    ASSERT_FALSE(read) << text;
    EXPECT_EQ(read.error().path, "data.csv:2");
  }
  EXPECT_EQ(names_of(curves_of("x,y\n0,5.0,1,25\n1,5.0,2,25\n")), ":2 ");
}

// A number with a mistake in it is no name of what follows.
TEST(PointsColumns, ARowWithAMistakeNamesNoCurve) {
  std::istringstream in("0.1 0.1\n0.2 0.2\n0.3 0.1\nabc 0.25\n0.5 0.1\n0.6 0.2\n0.7 0.1\n");
  const auto read = read_points(in, "data.dat");
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().path, "data.dat:4");
  EXPECT_EQ(names_of(curves_of("0.1 0.1\n0.2 0.2\n0.3 0.1\nflap 2\n0.5 0.1\n0.6 0.2\n0.7 0.1\n")),
            ":3 flap 2:3 ");
  EXPECT_EQ(names_of(curves_of("0.1 0.1\n0.2 0.2\n0.3 0.1\nt/c 0.25\n")), ":3 ");
}

// Numbers or names of stations, which no two rows share, are none of curves.
TEST(PointsParts, NamesOfPointsMakeOneCurve) {
  for (const char* text : {"name,x,y\nP1,0,0\nP2,1,1\nP3,2,0\n", "P1,0,0\nP2,1,1\nP3,2,0\n",
                           "id;x;y\n7;0;0\n8;1;1\n9;2;0\n"}) {
    const auto curves = curves_of(text);
    EXPECT_EQ(names_of(curves), ":3 ") << text;
    EXPECT_EQ(curves[0].left_out,
              std::vector<std::string>{"column 1, which names the points (--id-column 1 takes it "
                                       "for names of curves)"})
        << text;
  }
  EXPECT_EQ(names_of(curves_of("P1,0,0\nP2,1,1\nP2,2,0\n")), "P1:1 P2:2 ");
  PointsOptions asked;
  asked.id_column = "1";
  EXPECT_EQ(names_of(curves_of("P1,0,0\nP2,1,1\n", asked)), "P1:1 P2:1 ");
}

const std::string kArch = "0 0\n1 1\n2 0\n";

// As gnuplot draws them: a blank line ends a line, two end a data set.
TEST(PointsBlocks, AreCurvesOfTheirOwn) {
  EXPECT_EQ(names_of(curves_of(kArch + "\n0 5\n1 6\n2 5\n")), ":3 :3 ");
  EXPECT_EQ(names_of(curves_of("both\n" + kArch + " \t\n0 5\n1 6\n\n\n7 7\n8 8\n")),
            "both:3 both#2:2 both#3:2 ");
  EXPECT_EQ(names_of(curves_of("x,y\n0,0\n1,1\n,\n0,5\n1,6\n")), ":2 :2 ");
  EXPECT_EQ(names_of(curves_of("0 0 1\n1 1 1\n\n0 0 9\n1 1 9\n")), ":2z :2z ");
  // squares, the next within the last
  const std::string squares = "0 0\n9 0\n9 9\n0 9\n\n1 1\n8 1\n8 8\n1 8\n";
  EXPECT_EQ(names_of(curves_of(squares)), ":4 :4 ");
  EXPECT_EQ(names_of(curves_of("0 0\n9 0\n9 9\n0 0\n\n0 0\n0 9\n-9 9\n")), ":4 :3 ");
  EXPECT_EQ(names_of(curves_of(kArch + "\n\n2 0\n3 0\n4 0\n")), ":3 :3 ");
  // where data are missing
  EXPECT_EQ(names_of(curves_of("0 0\n1 0\n2 0\n\n4 0\n5 0\n")), ":3 :2 ");
  EXPECT_EQ(curves_of(kArch + "\n0 5\n1 6\n")[1].notes[0],
            "blank lines part the rows into 2 curves");
  EXPECT_EQ(curves_of(kArch + "\n0 5\n1 6\n")[1].source_lines, (std::vector<int>{5, 6}));
}

// Rows in groups, the second side of an airfoil from the nose, a last point apart: told.
TEST(PointsBlocks, StayOneCurveThatGoesOn) {
  const auto told = [](const std::string& text) {
    const auto curves = curves_of(text);
    return curves.size() == 1 && curves[0].left_out.size() == 1 ? curves[0].left_out[0] : "";
  };
  EXPECT_EQ(told("0 0\n1 0\n2 1\n\n3 1\n4 0\n5 0\n"),
            "line 4: a blank line among the rows, which are taken for one curve");
  EXPECT_EQ(told("0 0\n1 0\n\n2 1\n3 1\n\n4 0\n5 0\n"),
            "line 3: this and other blank lines among the rows, which are taken for one curve");
  EXPECT_NE(told("foil\n1 0\n0.1 0.3\n0 0\n\n0 0\n0.1 -0.3\n1 0\n"), "");
  EXPECT_NE(told("foil\n1 0\n0.3 0.2\n0 0.1\n\n0 -0.1\n0.3 -0.2\n1 0\n"), "");
  EXPECT_EQ(told(kArch + "\n5 5\n"),
            "line 4: a blank line among the rows, which are taken for one curve, as one stands by "
            "itself");
}

// Of gnuplot's world map, some islands are one point: no reason to draw lines across the sea.
TEST(PointsBlocks, PartLinesAmongWhichSinglePointsStand) {
  const auto curves = curves_of(kArch + "\n5 5\n\n0 5\n1 6\n2 5\n\n7 7\n\n8 9\n8 9\n");
  EXPECT_EQ(names_of(curves), ":3 :3 ");
  EXPECT_EQ(curves[0].left_out,
            std::vector<std::string>{
                "3 points that stand alone among blank lines that part the rows into curves"});
  // what goes on over them is one
  EXPECT_EQ(names_of(curves_of("0 0\n1 0\n\n2 0\n\n3 0\n4 0\n")), ":5 ");
}

// Between all rows, at the ends, or where names or Lednicer's counts say what is what.
TEST(PointsBlocks, MeanNothingElsewhere) {
  for (const auto& [text, names] :
       {std::pair{"0 0\n\n1 1\n\n2 0\n", ":3 "},
        {"\n0 0\n1 1\n2 0\n\n\n", ":3 "},
        {"foil\n\n0 0\n1 1\n2 0\n\nhttp://somewhere\n\n", "foil:3 "},
        {"id,x,y\na,0,0\na,1,1\n\na,7,7\na,8,8\n", "a:4 "},
        {"foil\n3 3\n\n0 0\n0.5 0.1\n1 0\n\n0 0\n0.5 -0.1\n1 0\n", "foil:6 "},
        {"one\n0 0\n1 1\n2 0\n\ntwo\n5 5\n6 6\n7 5\n", "one:3 two:3 "}}) {
    const auto curves = curves_of(text);
    EXPECT_EQ(names_of(curves), names) << text;
  }
  PointsOptions cloud;
  cloud.blank_lines_part = false;
  EXPECT_EQ(names_of(curves_of("0 0 1\n1 1 1\n\n0 0 9\n1 1 9\n", cloud)), ":4z ");
}

// A block that goes back from its first point is no continuation, however near it starts.
TEST(PointsBlocks, ThatGoBackAreOthers) {
  EXPECT_EQ(names_of(curves_of("0 0\n1 0\n2 0\n\n2.9 0\n1.5 0.5\n0 1\n")), ":3 :3 ");
  EXPECT_EQ(names_of(curves_of("0 0\n1 0\n2 0\n\n2.9 0\n4 0.5\n5 1\n")), ":6 ");
}

// The blank lines of Lednicer's order stand before each side.
TEST(PointsBlocks, OfLednicersOrderAreOneCurve) {
  const auto curves = curves_of("3. 3.\n\n0 0\n0.5 0.1\n1 0\n\n0 0\n0.5 -0.1\n1 0\n");
  ASSERT_EQ(names_of(curves), ":6 ");
  EXPECT_TRUE(curves[0].left_out.empty());
}

TEST(PointsParts, TwoNamedPointsAreOneCurveToo) {
  EXPECT_EQ(names_of(curves_of("A,0,0\nB,1,2\n")), ":2 ");
}

// Below names of columns every row is a point.
TEST(PointsParts, MarksPartNothingBelowAHeader) {
  const char* rows = "0,0\n1,0.1\n999,999\n0,1\n1,1\n";
  EXPECT_EQ(names_of(curves_of(std::string("x,y\n") + rows)), ":5 ");
  EXPECT_EQ(names_of(curves_of(rows)), ":2 :2 ");
}

}  // namespace
}  // namespace keyline::exchange
