#include "keyline/exchange/points_writer.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include <unistd.h>

#include <gtest/gtest.h>

#include "keyline/exchange/atomic_file.h"
#include "keyline/exchange/lattice_reader.h"
#include "keyline/exchange/points_reader.h"

namespace keyline::exchange {
namespace {

namespace fs = std::filesystem;

/// A folder of its own that goes away with the test.
class Folder {
 public:
  Folder() {
    path = fs::temp_directory_path() / ("keyline-writer-" + std::to_string(::getpid()));
    fs::create_directories(path);
  }
  ~Folder() { fs::remove_all(path); }
  fs::path path;
};

std::string content_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

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

TEST(WriteAtomically, FailureKeepsWhatWasThere) {
  const Folder folder;
  const fs::path file = folder.path / "curve.csv";
  ASSERT_TRUE(write_atomically(file, "old"));
  const auto refused = write_atomically(file, [](std::ostream& out) -> core::Result<void> {
    out << "half";
    return core::fail(core::ErrorCode::cancelled, "stopped");
  });
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, core::ErrorCode::cancelled);
  const auto broken = [](std::ostream&) -> core::Result<void> {
    throw std::runtime_error("broken");
  };
  EXPECT_THROW(std::ignore = write_atomically(file, broken), std::runtime_error);
  const auto bad = write_atomically(file, [](std::ostream& out) -> core::Result<void> {
    out.setstate(std::ios::badbit);
    return {};
  });
  ASSERT_FALSE(bad);
  EXPECT_EQ(bad.error().code, core::ErrorCode::io);
  EXPECT_EQ(content_of(file), "old");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path), {}), 1);
}

TEST(WriteAtomically, UnwritableIsIo) {
  const Folder folder;
  for (const fs::path& path : {folder.path / "no" / "such" / "folder.csv", folder.path}) {
    const auto written = write_atomically(path, "x");
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().code, core::ErrorCode::io);
    EXPECT_FALSE(written.error().message.empty());
  }
  EXPECT_TRUE(write_atomically("/dev/null", "x"));
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
