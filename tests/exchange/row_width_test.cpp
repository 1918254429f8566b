#include "keyline/exchange/points/row_width.h"

#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "keyline/exchange/points/lattice_reader.h"
#include "keyline/exchange/points/points_reader.h"

namespace keyline::exchange {
namespace {

std::string why(const std::string& text) {
  std::istringstream in(text);
  const auto read = read_points(in, "file");
  return read ? "" : read.error().path + " " + read.error().message;
}

// Which of its columns a shorter row has not, nobody knows: 9 may be z, or what is behind it.
TEST(RowWidth, ARowWithFewerColumnsIsRefused) {
  EXPECT_EQ(why("x,y,z,i\n0,1,2,7\n1,3.5,9\n2,4,5,8\n"),
            "file:3 3 columns where the first row has 4");
  EXPECT_EQ(why("x y z i\n0 1 2 7\n1 3.5 9\n2 4 5 8\n"),
            "file:3 3 columns where the first row has 4");
  EXPECT_EQ(why("0 1 2 7\n1 2 3 8\n1 3.5 9\n3 4 5 8\n"),
            "file:3 3 columns where the first row has 4");
  EXPECT_EQ(why("x\ty\tw\n0\t1\t2\n\t1\t3.5\n2\t4\t5\n"),
            "file:3 2 columns where the first row has 3");
  EXPECT_EQ(why("x,y,z,i,k\n1,3.5,9\n0,1,2,7\n2,4,5,8\n"),
            "file:3 4 columns where the first row has 3");
}

// Cells without a number are cells; words behind the numbers may be missing.
TEST(RowWidth, ARowWithEmptyCellsIsNoShorterOne) {
  EXPECT_EQ(why("x,y,z,i\n0,1,2,7\n1,3.5,9,\n2,4,,\n"), "");
  EXPECT_EQ(why("x,y,z,i\n1,3.5,9,\n0,1,2,7\n"), "");
  EXPECT_EQ(why("x\ty\tz\ti\n0\t1\t2\t7\n1\t3.5\t9\t\n2\t4\t5\t8\n"), "");
  EXPECT_EQ(why("x\ty\tz\ti\n1\t3.5\t9\t\n0\t1\t2\t7\n"), "");
  EXPECT_EQ(why("0 1 2 start\n1 3 4\n2 4 5 end\n"), "");
  EXPECT_EQ(why("x,y,z,i\n0,1,2\n1,3.5,9\n2,4,5\n"), "");
  EXPECT_EQ(why("xu,yu,xl,yl\n0,0,0,0\n0.5,1,0.5,-1\n1,0\n"), "");  // the lower side is at its end
}

// Every column of the header is there: nothing can have been shifted.
TEST(RowWidth, ARowWithTheHeadersColumnsIsTakenBelowAShorterFirst) {
  const auto read = [](const std::string& text) {
    std::istringstream in(text);
    return read_points(in, "file");
  };
  for (const std::string text :
       {"x,y,remark\n1,2\n2,3\n3,5,17\n", "x y remark\n1 2\n2 3\n3 5 17\n"}) {
    const auto curves = read(text);
    ASSERT_TRUE(curves) << curves.error().message;
    EXPECT_THAT(
        curves->at(0).points,
        testing::ElementsAre(core::Point3{1, 2, 0}, core::Point3{2, 3, 0}, core::Point3{3, 5, 0}));
  }
}

// Of two sides the shorter ends early; longer than the header no row can be.
TEST(RowWidth, ARowOfTwoSidesHasNoMoreColumnsThanTheHeader) {
  EXPECT_EQ(why("xu,yu,xl,yl\n0,0,0,0\n0,5,0,1,0,5,-0,1\n1,5,0,2,1,5,-0,2\n"),
            "file:3 8 columns where the first row has 4");
  std::istringstream in("xu yu xl yl\n0 0 0 0\n1 2 1 -2 77\n2 3 2 -3\n");
  const auto curves = read_points(in, "file");
  ASSERT_TRUE(curves) << curves.error().message;
  EXPECT_THAT(curves->at(0).left_out, testing::ElementsAre("line 3: what stands behind column 4"));
}

TEST(RowWidth, ALatticesRowsHaveTheColumnsOfTheFirst) {
  std::istringstream in("n,x,y,z,i\n1,0,0,1,9\n2,0,1,2,9\n\n3,1,0,3\n4,1,1,4,9\n");
  const auto read = read_lattice(in, "file");
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().path, "file:5");
  EXPECT_EQ(read.error().message, "4 columns where the first row has 5");
}

}  // namespace
}  // namespace keyline::exchange
