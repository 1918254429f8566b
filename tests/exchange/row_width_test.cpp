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
  EXPECT_EQ(why("x,y,z,i\n1,3.5,9\n0,1,2,7\n2,4,5,8\n"),
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

TEST(RowWidth, ALatticesRowsHaveTheColumnsOfTheFirst) {
  std::istringstream in("n,x,y,z,i\n1,0,0,1,9\n2,0,1,2,9\n\n3,1,0,3\n4,1,1,4,9\n");
  const auto read = read_lattice(in, "file");
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().path, "file:5");
  EXPECT_EQ(read.error().message, "4 columns where the first row has 5");
}

}  // namespace
}  // namespace keyline::exchange
