#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "keyline/acquire/symmetry.h"
#include "keyline/exchange/mesh/mesh.h"
#include "keyline/exchange/mesh/section_file.h"

/// Sections of meshes of a few triangles, by hand.
namespace keyline::exchange {
namespace {

using core::Point2;
using core::Point3;

/// A strip of squares over [from, to] at y, from z = -1 to 3.
void add_wall(Mesh& mesh, double from, double to, double y) {
  const auto n = static_cast<std::uint32_t>(mesh.points.size());
  for (const double x : {from, to})
    for (const double z : {-1.0, 3.0}) mesh.points.push_back({x, y, z});
  mesh.triangles.push_back({n, n + 1, n + 3});
  mesh.triangles.push_back({n, n + 3, n + 2});
}

std::vector<SectionLine> at_zero(const Mesh& mesh) {
  return section(mesh, acquire::plane_of({0, 0, 1}, 0));
}

double width(const SectionLine& line) {
  return std::abs(line.points.back().x - line.points.front().x);
}

TEST(MeshSection, TheLongestLineIsFirst) {
  Mesh mesh;
  add_wall(mesh, 0, 1, 0);
  add_wall(mesh, 0, 7, 1);
  add_wall(mesh, 0, 3, 2);
  const auto lines = at_zero(mesh);
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(width(lines[0]), 7);
  EXPECT_EQ(width(lines[1]), 3);
  EXPECT_EQ(width(lines[2]), 1);
}

// Edges rise from -1 to 3: a quarter of each lies below. The diagonal is met in the middle of a
// line.
TEST(MeshSection, PointsStandWhereTheEdgesMeetThePlane) {
  Mesh mesh;
  add_wall(mesh, 0, 8, 5);
  const auto lines = at_zero(mesh);
  ASSERT_EQ(lines.size(), 1U);
  ASSERT_EQ(lines[0].points.size(), 3U);
  EXPECT_EQ(lines[0].points[1], (Point2{2, 5}));
  EXPECT_FALSE(lines[0].closed);
  mesh.points[0].z = -3;  // half of its edge, the diagonal too
  EXPECT_EQ(at_zero(mesh)[0].points[1], (Point2{4, 5}));
}

// Half a model ends in the plane of its symmetry: there is a border on whichever side it lies, of a
// flat one and of a block, whose faces there are closed.
TEST(MeshSection, BordersOnThePlaneAreCutFromEitherSide) {
  for (const double side : {-1.0, 1.0}) {
    SCOPED_TRACE(side);
    const Mesh flat{{{0, 0, 0}, {4, 0, 0}, {2, 0, side}}, {{0, 1, 2}}, {}, {}};
    ASSERT_EQ(at_zero(flat).size(), 1U);
    EXPECT_EQ(width(at_zero(flat)[0]), 4);
    const auto block = read_obj(
        "v 0 0 0\nv 2 0 0\nv 2 3 0\nv 0 3 0\nv 0 0 1\nv 2 0 1\nv 2 3 1\nv 0 3 1\n"
        "f 1 2 3 4\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
    const auto lines = section(*block, acquire::plane_of({0, 0, 1}, side > 0 ? 0 : 1));
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_TRUE(lines[0].closed);
    EXPECT_THAT(lines[0].points,
                testing::IsSupersetOf({Point2{0, 0}, Point2{2, 0}, Point2{2, 3}, Point2{0, 3}}));
  }
}

// A vertex on the plane counts as above it where anything is cut so: of a triangle above there is
// nothing then, and of a vertex alone there never is.
TEST(MeshSection, VerticesOnThePlaneAreOnOneSide) {
  Mesh mesh{{{0, 0, 0}, {4, 0, 0}, {2, 0, 1}, {9, 0, 1}, {9, 0, -1}, {8, 0, 1}},
            {{0, 1, 2}, {3, 4, 5}},
            {},
            {}};
  ASSERT_EQ(at_zero(mesh).size(), 1U);
  EXPECT_EQ(width(at_zero(mesh)[0]), 0.5);
  for (const double side : {-1.0, 1.0})
    EXPECT_TRUE(at_zero({{{0, 0, 0}, {4, 0, side}, {2, 0, side}}, {{0, 1, 2}}, {}, {}}).empty());
}

// Three walls that meet in one edge: three lines, none closed.
TEST(MeshSection, LinesPartWhereMoreThanTwoTrianglesMeet) {
  Mesh mesh{{{0, 0, -1}, {0, 0, 1}, {2, 0, 0.5}, {-3, 0, 0.5}, {0, 4, 0.5}},
            {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}},
            {},
            {}};
  const auto lines = at_zero(mesh);
  ASSERT_EQ(lines.size(), 3U);
  for (const SectionLine& line : lines) {
    EXPECT_EQ(line.points.size(), 2U);
    EXPECT_FALSE(line.closed);
  }
}

// A pyramid without its bottom, cut across: a loop of four corners, each once.
TEST(MeshSection, LoopsDoNotRepeatTheirStart) {
  Mesh mesh{{{0, 0, 1}, {1, 0, -1}, {0, 1, -1}, {-1, 0, -1}, {0, -1, -1}},
            {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}},
            {},
            {}};
  const auto lines = at_zero(mesh);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_TRUE(lines[0].closed);
  EXPECT_THAT(lines[0].points, testing::UnorderedElementsAre(Point2{0.5, 0}, Point2{0, 0.5},
                                                             Point2{-0.5, 0}, Point2{0, -0.5}));
}

TEST(MeshSection, TrianglesThatAreNoneAreLetPass) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  for (const int at : {0, 1, 2}) {
    Mesh mesh{{{0, 0, -1}, {1, 0, 1}, {0, 1, 1}}, {{0, 1, 2}}, {}, {}};
    EXPECT_EQ(at_zero(mesh).size(), 1U);
    mesh.points[static_cast<std::size_t>(at)].x = kNone;
    EXPECT_TRUE(at_zero(mesh).empty()) << at;
  }
  const Mesh flat{{{0, 0, -1}, {1, 0, 1}}, {{0, 0, 1}, {0, 1, 1}, {1, 0, 1}}, {}, {}};
  EXPECT_TRUE(at_zero(flat).empty());
}

TEST(Section, IsAnAxisAndANumber) {
  for (const auto& [text, normal, at] : {std::tuple{"x=1.5", core::Vector3{1, 0, 0}, 1.5},
                                         {"y=-2", {0, 1, 0}, -2.0},
                                         {"z=1e1", {0, 0, 1}, 10.0}}) {
    const auto request = parse_section(text);
    ASSERT_TRUE(request) << text;
    const core::Vector3 across = cross(request->plane->axis_x, request->plane->axis_y);
    EXPECT_EQ(std::abs(dot(across, normal)), 1) << text;
    EXPECT_EQ(dot(request->plane->origin - Point3{}, normal), at) << text;
  }
  EXPECT_FALSE(parse_section("auto")->plane);
  for (const char* none : {"", "x", "x=", "w=1", "{=1", "x:1", "x=a", "x=1mm", "xx=1", "auto "})
    EXPECT_FALSE(parse_section(none)) << none;
}

// Faces that name no vertex are left out, and told line by line, five of them.
// Bytes of binary files that have lost their place make such numbers; products of them overflow.
TEST(Section, RefusesCoordinatesThatAreTooLarge) {
  const auto file = std::filesystem::temp_directory_path() /
                    ("keyline-large-" + std::to_string(::getpid()) + ".obj");
  for (const char* faces : {"", "f 1 2 3\n"}) {
    std::ofstream(file) << "v 0 0 0\nv 1 0 1\nv 0 1e120 2\nv 3 1 0\n" << faces;
    for (const char* where : {"z=0.5", "auto"}) {
      const auto cut = section_of_file(file, parse_section(where).value());
      ASSERT_FALSE(cut) << faces << where;
      EXPECT_EQ(cut.error().message, "a coordinate is larger than 1e100");
      EXPECT_EQ(cut.error().path, file.string());
    }
  }
  std::filesystem::remove(file);
}

TEST(Section, TellsWhatOfAMeshCouldNotBeRead) {
  const auto file = std::filesystem::temp_directory_path() /
                    ("keyline-faces-" + std::to_string(::getpid()) + ".obj");
  const auto left_out = [&](int bad) {
    std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 1\n";
    for (int i = 0; i < bad; ++i) text += "f 1 2 9\n";
    std::ofstream(file) << text << "f 1 2 3\n";
    const auto cut = section_of_file(file, parse_section("z=0.25").value());
    EXPECT_TRUE(cut) << cut.error().message;
    return cut ? cut->curves.at(0).left_out : std::vector<std::string>{};
  };
  EXPECT_TRUE(left_out(0).empty());
  EXPECT_THAT(left_out(1), testing::ElementsAre(testing::HasSubstr("line 4")));
  EXPECT_EQ(left_out(5).size(), 5U);
  ASSERT_EQ(left_out(7).size(), 6U);
  EXPECT_EQ(left_out(7)[5], "2 further parts of the mesh");
  std::filesystem::remove(file);
}

// Coordinates are known by their names, whatever stands between them.
// Of a mesh with decimal commas no vertex is left; the plane is not at fault.
TEST(Section, TellsWhatWasSkippedWhereNothingIsMet) {
  const auto file = std::filesystem::temp_directory_path() /
                    ("keyline-comma-" + std::to_string(::getpid()) + ".obj");
  std::ofstream(file) << "v 0,5 0 0\nv 1,5 0 1\nv 0,5 1 1\nf 1 2 3\n";
  const auto cut = section_of_file(file, parse_section("z=0.5").value());
  std::filesystem::remove(file);
  ASSERT_FALSE(cut);
  EXPECT_THAT(cut.error().message, testing::HasSubstr("\"0,5\" is no number and others"));
}

TEST(Section, TellsWhetherThePlaneTouches) {
  const auto file = std::filesystem::temp_directory_path() /
                    ("keyline-touch-" + std::to_string(::getpid()) + ".obj");
  std::ofstream(file) << "v 0 0 1\nv 1 0 2\nv 0 1 2\nf 1 2 3\n";
  for (const auto& [where, why] :
       {std::pair{"z=1", "the plane touches the mesh and cuts nothing of it"},
        {"z=0.5", "the plane does not meet the mesh"}}) {
    const auto cut = section_of_file(file, parse_section(where).value());
    ASSERT_FALSE(cut);
    EXPECT_EQ(cut.error().message, why);
  }
  std::filesystem::remove(file);
}

// Lines of an OBJ stand beside its faces and points: no plane cuts them, and that is told.
TEST(Section, TellsLinesOfAnObj) {
  const auto file =
      std::filesystem::temp_directory_path() / ("keyline-l-" + std::to_string(::getpid()) + ".obj");
  const std::string vertices = "v 0 0 -1\nv 1 0 1\nv 0 1 1\nv 1 1 -1\nv 0.5 0 0\n";
  for (const char* faces : {"f 1 2 3\n", ""}) {
    std::ofstream(file) << vertices << faces << "l 4 5\nl 1 2 4\n";
    const auto cut = section_of_file(file, parse_section("z=0").value(), 2);
    ASSERT_TRUE(cut) << cut.error().message;
    EXPECT_THAT(cut->curves.at(0).left_out, testing::ElementsAre("2 lines between vertices"));
  }
  std::filesystem::remove(file);
}

TEST(StreamPoints, PropertiesMayStandInAnyOrder) {
  const auto file = std::filesystem::temp_directory_path() /
                    ("keyline-stream-" + std::to_string(::getpid()) + ".ply");
  std::string ply =
      "ply\nformat binary_big_endian 1.0\nelement vertex 2\nproperty uchar red\nproperty char z\n"
      "property uchar green\nproperty char x\nproperty char y\nproperty uchar blue\nend_header\n";
  for (const int byte : {200, 3, 100, 1, 2, 50, 201, 6, 101, 4, 5, 51})
    ply += static_cast<char>(byte);
  std::ofstream(file, std::ios::binary) << ply;
  std::vector<core::Point3> points;
  const auto left = stream_points(file, [&points](core::Point3 p) { points.push_back(p); });
  std::filesystem::remove(file);
  ASSERT_TRUE(left) << left.error().message;
  EXPECT_EQ(points, (std::vector<core::Point3>{{1, 2, 3}, {4, 5, 6}}));
}

}  // namespace
}  // namespace keyline::exchange
