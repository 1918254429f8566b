#include "keyline/exchange/points/points_writer.h"

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

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

TEST(ReadLattice, BothForms) {
  std::istringstream blank("0 0 0\n1 0 0\n2 0 0\n\n0 1 0\n1 1 1\n2 1 0\n");
  const auto a = read_lattice(blank, "blank.xyz");
  ASSERT_TRUE(a) << a.error().message;
  EXPECT_EQ(a->rows, 2u);
  EXPECT_EQ(a->columns, 3u);
  std::istringstream headed("3 2\n0 0 0\n1 0 0\n2 0 0\n0 1 0\n1 1 1\n2 1 0\n");
  const auto b = read_lattice(headed, "headed.xyz");
  ASSERT_TRUE(b) << b.error().message;
  EXPECT_EQ(b->rows, 3u);
  EXPECT_EQ(a->points, b->points);
  const auto column = acquire::lattice_column(*a, 1);
  ASSERT_TRUE(column);
  EXPECT_EQ(column->points[1], (core::Point3{1, 1, 1}));
  EXPECT_FALSE(acquire::lattice_row(*a, 2));
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

}  // namespace
}  // namespace keyline::exchange
