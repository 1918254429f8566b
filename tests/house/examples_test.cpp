#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "keyline/exchange/points/lattice_reader.h"
#include "keyline/exchange/points/points_reader.h"

namespace keyline {
namespace {

std::filesystem::path example(const char* name) {
  return std::filesystem::path(KEYLINE_SOURCE_DIR) / "examples" / name;
}

struct ExampleCase {
  const char* name;
  std::size_t curves;
  std::size_t points;  ///< of the first curve
};
constexpr ExampleCase kExamples[] = {
    {"bonnet-scan.csv", 1, 700}, {"bonnet.csv", 1, 210},     {"windscreen.csv", 1, 190},
    {"roof.csv", 1, 200},        {"car-cloud.xyz", 1, 3600}, {"hull-waterline.tsv", 1, 61},
    {"airfoil.dat", 1, 91},      {"bottle.csv", 1, 300},     {"unordered.xyz", 1, 220},
    {"outlines.csv", 2, 180},    {"clothoid.csv", 1, 101},
};

TEST(Examples, AreReadWithoutOptions) {
  for (const ExampleCase& c : kExamples) {
    SCOPED_TRACE(c.name);
    const auto curves = exchange::read_points(example(c.name));
    ASSERT_TRUE(curves) << curves.error().message;
    ASSERT_EQ(curves->size(), c.curves);
    EXPECT_EQ(curves->front().points.size(), c.points);
  }
}

TEST(Examples, LatticeHasItsShape) {
  const auto lattice = exchange::read_lattice(example("car-lattice.xyz"));
  ASSERT_TRUE(lattice) << lattice.error().message;
  EXPECT_EQ(lattice->lattice.rows, 11u);
  EXPECT_EQ(lattice->lattice.columns, 90u);
}

}  // namespace
}  // namespace keyline
