#include "keyline/exchange/points/scap_reader.h"

#include <sstream>

#include <gtest/gtest.h>

#include "keyline/exchange/points/lattice_reader.h"

/// Strokes and lattices of points.
namespace keyline::exchange {
namespace {

TEST(ScapReader, ReadsCanvasPenAndStrokes) {
  const auto found = read_scap(
      "#800 600\n@2.5\n{\n\t#7 3\n\t@9\n\t1 2 0\r\n\t1 2 0\n\t3 4 0.5\n}\n{\n}\n{\n#8 3\n5 6 1\n}\n"
      "# a note\n");
  ASSERT_TRUE(found);
  EXPECT_EQ(found->width, 800);
  EXPECT_EQ(found->height, 600);
  EXPECT_EQ(found->pen, 2.5);  // not that of a stroke
  ASSERT_EQ(found->strokes.size(), 2U);
  EXPECT_EQ(found->strokes[0].id, 7);
  EXPECT_EQ(found->strokes[0].group, 3);
  EXPECT_EQ(found->strokes[0].points, (std::vector<core::Point2>{{1, 2}, {3, 4}}));
  EXPECT_EQ(found->strokes[1].id, 8);
  EXPECT_EQ(found->left_out, (std::vector<std::string>{"line 10: a stroke without points"}));
}

TEST(ScapReader, LinesMayEndAsTheyDo) {
  for (const char* text : {"\xef\xbb\xbf#800 600\n{\n#1 2\n1 2\n3 4\n}\n",
                           "#800 600\r{\r#1 2\r1 2\r3 4\r}\r", "#800 600\n{\n#1 2\n1 2\n3 4\n}"}) {
    const auto found = read_scap(text);
    ASSERT_TRUE(found) << found.error().path;
    EXPECT_EQ(found->strokes.at(0).points, (std::vector<core::Point2>{{1, 2}, {3, 4}}));
  }
}

TEST(ScapReader, OtherLinesAreNamed) {
  const auto place = [](const char* text) {
    const auto found = read_scap(text);
    return found ? std::string("read") : found.error().path;
  };
  EXPECT_EQ(place("1 2\n"), "line 1");
  EXPECT_EQ(place("{\n{\n"), "line 2");
  EXPECT_EQ(place("}\n"), "line 1");
  EXPECT_EQ(place("{\n1\n}\n"), "line 2");
  EXPECT_EQ(place("{\n1 x\n}\n"), "line 2");
  EXPECT_EQ(place("@0\n"), "line 1");
  EXPECT_EQ(place("@x\n"), "line 1");
  EXPECT_EQ(place("{\n1 1e9\n}\n"), "line 2");
  EXPECT_EQ(place("{\n1 9e8\n}\n"), "read");
  EXPECT_EQ(place("{\n1 2 0.5\n3 0.5\n}\n"), "line 3");  // a lost number, no y of 0.5
  EXPECT_EQ(place("{\n1 2 0.5\n}\n{\n3 4\n5 6\n}\n"), "read");
  EXPECT_EQ(place("{\n1 2 x\n}\n"), "line 2");
  EXPECT_EQ(place("{\n1 2\n}\n{\n3 4\n"), "line 5");  // cut off
  // More than belongs there is a line lost or broken.
  EXPECT_EQ(place("{ 1 2\n3 4\n}\n"), "line 1");
  EXPECT_EQ(place("{\n1 2\n} {\n3 4\n}\n"), "line 3");
  EXPECT_EQ(place("{\n#1 2 3\n1 2\n}\n"), "line 2");
  EXPECT_EQ(place("{\n#1 2\n1 2\n#3 2\n}\n"), "line 4");  // two strokes without a } between them
  EXPECT_EQ(place("{\n#1.5 2\n1 2\n}\n"), "line 2");
  EXPECT_EQ(place("{\n#1 0.5\n1 2\n}\n"), "line 2");
  EXPECT_EQ(place("#800 600 2\n{\n1 2\n}\n"), "line 1");
  EXPECT_EQ(place("@2 5\n{\n1 2\n}\n"), "line 1");
  EXPECT_EQ(place("{\n1 2\n}\n#1 [0, 2) --> #3\n"), "read");
  EXPECT_EQ(place(""), "");
  EXPECT_EQ(place("{\n}\n"), "");
}

core::Result<LatticeFile> lattice(const char* text) {
  std::istringstream in(text);
  return read_lattice(in, "file");
}

TEST(LatticeReader, TakesItsShapeFromTheFirstLineOrFromBlankOnes) {
  const auto given = lattice("2 3\n0 0 1\n0 1 2\n0 2 3\n1 0 4\n1 1 nan\n1 2 6\n");
  ASSERT_TRUE(given);
  EXPECT_EQ(given->lattice.rows, 2U);
  EXPECT_EQ(given->lattice.columns, 3U);
  EXPECT_EQ(given->lattice.points[3], (core::Point3{1, 0, 4}));
  const auto parted = lattice("# a scan\nx y z\n0 0 1\n0 1 2\n\n\n1 0 3\n1 1 4\n\n2 0 5\n2 1 6\n");
  ASSERT_TRUE(parted);
  EXPECT_EQ(parted->lattice.rows, 3U);
  EXPECT_EQ(parted->lattice.columns, 2U);
  EXPECT_EQ(parted->lattice.points[2], (core::Point3{1, 0, 3}));
}

// A decimal comma makes two of a number; blank lines may part other rows than the first line tells.
TEST(LatticeReader, HasThePointsAndRowsItTells) {
  const auto why = [](const char* text) {
    const auto read = lattice(text);
    return read ? std::string() : read.error().path + ": " + read.error().message;
  };
  EXPECT_EQ(why("2 2\n0,0,1\n0,1,2\n1,0,3\n1,1,4\n"), "");
  EXPECT_EQ(why("2 2\n0,0,1\n0,1,2\n1,0,3,5\n1,1,4\n"),
            "file:4: three numbers (x y z) are needed here, not 4");
  const std::string rows = "0 0 1\n0 1 2\n0 2 3\n\n1 0 4\n1 1 5\n1 2 6\n";
  EXPECT_EQ(why(("2 3\n" + rows).c_str()), "");
  EXPECT_EQ(why(("3 2\n" + rows).c_str()),
            "file: blank lines part the points into other rows than the 3 of 2 announced");
}

TEST(LatticeReader, SaysWhatIsNoLattice) {
  const auto why = [](const char* text) {
    const auto found = lattice(text);
    return found ? std::string("read") : found.error().message;
  };
  EXPECT_EQ(why("2 2\n0 0 1\n0 1 2\n1 0 3\n"), "2 x 2 points announced, 3 found");
  EXPECT_EQ(why("0 0 1\n0 1 2\n\n1 0 3\n"), "row 1 has 1 point, the first row 2");
  EXPECT_EQ(why("0 0 1\n0 1 2\n"), "this is no lattice of rows and columns");
  EXPECT_EQ(why("0 0 1\n\n0 1 2\n"), "this is no lattice of rows and columns");
  EXPECT_EQ(why("0 0 1\n0 1\n"), "three numbers (x y z) are needed here");
  EXPECT_EQ(why("0 0 1\n0 1 1e101\n"), "three numbers (x y z) are needed here");
  EXPECT_EQ(why("2 2\n0 0 1\n0 1 1e100\n1 0 0\n1 1 0\n"), "read");
  EXPECT_EQ(why("1 4\n0 0 1\n0 1 2\n0 2 3\n0 3 4\n"), "this is no lattice of rows and columns");
}

}  // namespace
}  // namespace keyline::exchange
