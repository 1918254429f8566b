#include "keyline/exchange/mesh/mesh.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "keyline/acquire/symmetry.h"
#include "keyline/core/angle.h"
#include "keyline/exchange/document_file.h"
#include "keyline/exchange/mesh/section_file.h"

#include "tests/shared_data.h"

namespace keyline::exchange {
namespace {

namespace fs = std::filesystem;
using core::Point3;
using testing::Contains;
using testing::HasSubstr;

/// A ball of radius 2 about the origin, turned so that no vertex lies in a coordinate plane.
Mesh ball(int n) {
  Mesh m;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j < 2 * n; ++j) {
      const double t = core::kPi * (i + 1e-3) / (n + 2e-3);
      const double f = core::kPi * (j + 0.37) / n;
      m.points.push_back(
          {2 * std::sin(t) * std::cos(f), 2 * std::sin(t) * std::sin(f), 2 * std::cos(t)});
    }
  const auto at = [n](int i, int j) { return static_cast<std::uint32_t>(i * 2 * n + j % (2 * n)); };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < 2 * n; ++j) {
      m.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      m.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return m;
}

std::string obj_of(const Mesh& m) {
  std::string text = "# ball\n";
  for (const Point3 p : m.points)
    text +=
        "v " + std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
  for (const auto& t : m.triangles)
    text += "f " + std::to_string(t[0] + 1) + "/1/1 " + std::to_string(t[1] + 1) + "//2 " +
            std::to_string(t[2] + 1) + "\n";
  return text;
}

template <class T>
void put(std::string& bytes, T value, bool big = false) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  if (big) std::reverse(raw, raw + sizeof(T));
  bytes.append(raw, sizeof(T));
}

std::string stl_of(const Mesh& m) {
  std::string bytes = "solid but binary";
  bytes.resize(80, ' ');
  put(bytes, static_cast<std::uint32_t>(m.triangles.size()));
  for (const auto& t : m.triangles) {
    for (int i = 0; i < 3; ++i) put(bytes, 0.0F);
    for (const auto i : t) {
      put(bytes, static_cast<float>(m.points[i].x));
      put(bytes, static_cast<float>(m.points[i].y));
      put(bytes, static_cast<float>(m.points[i].z));
    }
    put(bytes, std::uint16_t{0});
  }
  return bytes;
}

std::string ply_of(const Mesh& m, const std::string& format) {
  std::string bytes =
      "ply\nformat " + format + " 1.0\ncomment ball\nelement vertex " +
      std::to_string(m.points.size()) +
      "\nproperty uchar red\nproperty double x\nproperty double y\nproperty double z\n"
      "element face " +
      std::to_string(m.triangles.size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
  const bool text = format == "ascii";
  const bool big = format == "binary_big_endian";
  for (const Point3 p : m.points) {
    if (text) {
      bytes +=
          "7 " + std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
      continue;
    }
    put(bytes, std::uint8_t{7});
    for (const double v : {p.x, p.y, p.z}) put(bytes, v, big);
  }
  for (const auto& t : m.triangles) {
    if (text) bytes += "3";
    if (!text) put(bytes, std::uint8_t{3});
    for (const auto i : t) {
      if (text) bytes += " " + std::to_string(i);
      if (!text) put(bytes, static_cast<std::int32_t>(i), big);
    }
    if (text) bytes += "\n";
  }
  return bytes;
}

void expect_ball_section(const Mesh& m) {
  const auto lines = section(m, acquire::plane_of({0, 1, 0}, 0.5));
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_TRUE(lines[0].closed);
  EXPECT_GT(lines[0].points.size(), 60U);
  const double r = std::sqrt(4 - 0.25);
  double turned = 0;
  for (std::size_t i = 0; i < lines[0].points.size(); ++i) {
    const core::Point2 a = lines[0].points[i];
    const core::Point2 b = lines[0].points[(i + 1) % lines[0].points.size()];
    EXPECT_NEAR(norm(a - core::Point2{}), r, 0.02);
    turned += core::angle_between(a - core::Point2{}, b - core::Point2{});
  }
  EXPECT_NEAR(std::abs(turned), 2 * core::kPi, 1e-6);  // in order, once around
}

TEST(Mesh, EveryFormatGivesTheSameSection) {
  const Mesh m = ball(24);
  expect_ball_section(m);
  for (const auto& read :
       {read_obj(obj_of(m)), read_stl(stl_of(m)), read_ply(ply_of(m, "ascii")),
        read_ply(ply_of(m, "binary_little_endian")), read_ply(ply_of(m, "binary_big_endian"))}) {
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->triangles.size(), m.triangles.size());
    EXPECT_EQ(read->points.size(), m.points.size());
    expect_ball_section(*read);
  }
}

TEST(Mesh, OpenMeshesGiveOpenLines) {
  Mesh m;
  for (int i = 0; i <= 10; ++i)
    for (const double y : {-1.0, 1.0}) m.points.push_back({double(i), y, 0.1 * i * i});
  for (std::uint32_t i = 0; i < 20; i += 2) {
    m.triangles.push_back({i, i + 1, i + 3});
    m.triangles.push_back({i, i + 3, i + 2});
  }
  const auto lines = section(m, acquire::plane_of({0, 1, 0}, 0));
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_FALSE(lines[0].closed);
  EXPECT_EQ(lines[0].points.size(), 21U);
  EXPECT_EQ(std::min(lines[0].points.front().x, lines[0].points.back().x), 0);
  EXPECT_EQ(std::max(lines[0].points.front().x, lines[0].points.back().x), 10);
  // Right through a row of vertices there is still one line.
  EXPECT_EQ(section(m, acquire::plane_of({1, 0, 0}, 5)).size(), 1U);
}

TEST(Mesh, SymmetryPlaneIsFoundInAnyPose) {
  Mesh m = ball(16);
  for (Point3& p : m.points)
    p = {3 * p.x + 0.2 * p.x * p.x, p.y, 0.5 * p.z + 0.1 * p.x + 0.1 * p.z * p.z};
  const auto plain = acquire::symmetry_plane(m.points);
  ASSERT_TRUE(plain);
  EXPECT_EQ(cross(plain->plane.axis_x, plain->plane.axis_y), (core::Vector3{0, -1, 0}));
  EXPECT_NEAR(plain->plane.origin.y, 0, 1e-12);
  const double c = std::cos(0.4);
  const double s = std::sin(0.4);
  for (Point3& p : m.points) p = {c * p.x - s * p.y + 7, s * p.x + c * p.y - 3, p.z + 1};
  const auto turned = acquire::symmetry_plane(m.points);
  ASSERT_TRUE(turned);
  const auto n = cross(turned->plane.axis_x, turned->plane.axis_y);
  EXPECT_NEAR(std::abs(n.x * -s + n.y * c), 1, 1e-3);
  EXPECT_NEAR(dot(turned->plane.origin - Point3{7, -3, 1}, n), 0, 0.02);
}

TEST(Mesh, BadFilesAreFailuresWithThePlace) {
  const Mesh m = ball(4);
  const std::string ply = ply_of(m, "binary_little_endian");
  for (std::size_t cut = 0; cut < ply.size(); cut += 37) EXPECT_FALSE(read_ply(ply.substr(0, cut)));
  EXPECT_THAT(read_ply(ply.substr(0, 400)).error().path, HasSubstr("byte "));
  EXPECT_EQ(read_obj("v 1 2 3\nv 1 x 3\n").error().path, "line 2");
  EXPECT_FALSE(read_stl(stl_of(m).substr(0, 300)));
  EXPECT_EQ(read_stl("solid\nfacet\nouter loop\nvertex 1 2 3\nendloop\n").error().path, "line 5");
  const std::string loop = "solid\nfacet\nouter loop\n", vertex = "vertex 1 2 3\n";
  const auto few = read_stl(loop + "vertex 1 2\n");
  EXPECT_EQ(few.error().message, "a vertex needs three numbers");
  EXPECT_EQ(few.error().path, "line 4");
  const auto many = read_stl(loop + vertex + vertex + vertex + vertex);
  EXPECT_EQ(many.error().message, "a triangle has three vertices");
  EXPECT_EQ(many.error().path, "line 7");
  std::string huge =
      "ply\nformat binary_little_endian 1.0\nelement vertex 3000000000\nproperty float "
      "x\nend_header\n";
  EXPECT_FALSE(read_ply(huge));
}

// A number left out shifts all that follow: what is left at the end tells of it.
TEST(Mesh, PlyOfMoreThanItsHeaderTellsSo) {
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
  const auto whole = read_ply(head + "0 0 0\n1 5 0\n0 1 0\n3 0 1 2\n\n");
  ASSERT_TRUE(whole);
  EXPECT_TRUE(whole->skipped.empty());
  const auto shifted = read_ply(head + "0 0 0\n1 0\n0 1 0\n3 0 1 2\n");
  ASSERT_TRUE(shifted);
  EXPECT_THAT(shifted->skipped, Contains(HasSubstr("behind the last element")));
}

// Vertices alone are a cloud: a tube of radius 2, cut across.
TEST(Mesh, ObjWithoutFacesIsCutAsACloud) {
  const fs::path file =
      fs::temp_directory_path() / ("keyline-cloud-" + std::to_string(::getpid()) + ".obj");
  {
    std::ofstream out(file);
    for (int i = 0; i < 600; ++i)
      for (int k = -2; k <= 2; ++k)
        out << "v " << 2 * std::cos(0.01 * i) << ' ' << 2 * std::sin(0.01 * i) << ' ' << 0.5 * k
            << '\n';
  }
  const auto cut = section_of_file(file, parse_section("z=0").value(), 0.03);
  fs::remove(file);
  ASSERT_TRUE(cut) << cut.error().message;
  ASSERT_EQ(cut->curves.size(), 1U);
  ASSERT_EQ(cut->curves[0].points.size(), 600U);
  for (const Point3 p : cut->curves[0].points) EXPECT_NEAR(std::hypot(p.x, p.y), 2, 1e-5);
}

TEST(Mesh, VerticesRepeatedFaceByFaceAreOne) {
  // A tube of eight square faces, each with vertices of its own.
  std::string text;
  for (int i = 0; i < 8; ++i) {
    for (const int corner : {0, 1, 3, 2}) {
      const double angle = (i + corner % 2) % 8 * core::kPi / 4;
      text += "v " + std::to_string(std::cos(angle)) + " " + std::to_string(std::sin(angle)) + " " +
              std::to_string(corner / 2) + "\n";
    }
    text += "f -4 -3 -2 -1\n";
  }
  const auto mesh = read_obj(text);
  ASSERT_TRUE(mesh);
  ASSERT_EQ(mesh->points.size(), 32U);
  const auto lines = section(*mesh, acquire::plane_of({0, 0, 1}, 0.4));
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_TRUE(lines[0].closed);
  EXPECT_EQ(lines[0].points.size(), 16U);
}

TEST(Mesh, CloudsAreCutWithoutKeepingThem) {
  const fs::path file =
      fs::temp_directory_path() / ("keyline-cloud-" + std::to_string(::getpid()) + ".pts");
  {
    std::ofstream out(file);
    out << "20000\n";
    for (int i = 0; i < 20000; ++i) {
      const double x = (i * 7919 % 20000) / 2000.0;
      const double y = (i % 41 - 20) / 20.0;
      out << x << ' ' << y << ' ' << 0.05 * x * x - 0.2 * y * y << " 17 200 200 200\n";
    }
  }
  const auto cut = section_of_file(file, parse_section("y=0").value(), 0.03);
  ASSERT_TRUE(cut) << cut.error().message;
  EXPECT_EQ(cut->curves.at(0).points.size(), 488U);
  EXPECT_THAT(cut->curves[0].notes.back(), HasSubstr("of 20000 points"));
  const auto found = section_of_file(file, parse_section("auto").value(), 0.03);
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_THAT(found->description, HasSubstr("y = 0"));
  const auto miss = section_of_file(file, parse_section("y=9").value(), 0.03);
  ASSERT_FALSE(miss);
  EXPECT_THAT(miss.error().hint, HasSubstr("third nearest"));
  fs::remove(file);
}

struct FileCase {
  const char* name;
  std::size_t points;
  std::size_t triangles;
  std::size_t skipped;
};

// A binary file is told by its size, whatever its header says, and by bytes no text has where the
// size is wrong: what is there of it is read.
TEST(Mesh, WordsOfStlMayBeCapitals) {
  const auto mesh = read_stl(
      "SOLID A\nFACET NORMAL 0 0 1\nOUTER LOOP\nVERTEX 0 0 0\nVERTEX 1.0E+00 0 0\nVERTEX 0 1 0\n"
      "ENDLOOP\nENDFACET\nENDSOLID A\n");
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh->triangles.size(), 1U);
  EXPECT_TRUE(mesh->skipped.empty());
}

TEST(Mesh, BinaryStlIsToldByItsSize) {
  const float corners[12] = {0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0};  // a normal, three corners
  for (const std::string name : {"solid facet", "made elsewhere"}) {
    SCOPED_TRACE(name);
    std::string bytes = name + std::string(80 - name.size(), ' ');
    const std::uint32_t count = 1;
    bytes.append(reinterpret_cast<const char*>(&count), 4);
    bytes.append(reinterpret_cast<const char*>(corners), sizeof corners);
    bytes.append(2, '\0');
    ASSERT_EQ(bytes.size(), 134U);
    const auto mesh = read_stl(bytes);
    ASSERT_TRUE(mesh) << mesh.error().message;
    EXPECT_EQ(mesh->triangles.size(), 1U);
    EXPECT_THAT(mesh->points,
                testing::UnorderedElementsAre(Point3{0, 0, 0}, Point3{1, 0, 0}, Point3{0, 1, 0}));
    const auto longer = read_stl(bytes + "behind");
    ASSERT_EQ(longer.has_value(), !name.starts_with("solid"));
    if (longer) {
      EXPECT_EQ(longer->triangles.size(), 1U);
    }
  }
}

// Counts by hand: lines "v" and "f" (polygons of n corners as n - 2 triangles), PLY headers, STL
// facets.
constexpr FileCase kFiles[] = {
    {"4_cad/nasty/mesh/malformed.obj", 8, 8, 2},
    {"4_cad/nasty/mesh/malformed2.obj", 8, 10, 1},
    {"4_cad/nasty/mesh/number_formats.obj", 15, 1, 6},  // six vertices with 3.1+e2 and the like
    {"4_cad/nasty/mesh/box_UTF16BE.obj", 8, 12, 0},
    {"4_cad/nasty/mesh/box_longline.obj", 8, 944, 0},  // one face of 936 corners
    {"4_cad/nasty/mesh/cube_binary_header_with_RN_newline.ply", 8, 12, 0},
    {"4_cad/nasty/mesh/points.ply", 4, 0, 0},
    {"4_cad/nasty/mesh/triangle_with_two_solids.stl", 6, 2, 0},
    {"5_car3d/teapot.obj", 3644, 6320, 0},
};

TEST(Mesh, ReadsTheSharedFiles) {
  const fs::path folder = KEYLINE_SHARED_DATA;
  KEYLINE_NEEDS_SHARED_DATA(fs::exists(folder), folder);
  for (const FileCase& c : kFiles) {
    SCOPED_TRACE(c.name);
    const auto m = read_mesh(folder / c.name);
    ASSERT_TRUE(m) << m.error().message;
    EXPECT_EQ(m->points.size(), c.points);
    EXPECT_EQ(m->triangles.size(), c.triangles);
    EXPECT_EQ(m->skipped.size(), c.skipped);
  }
  EXPECT_FALSE(
      read_mesh(folder / "4_cad/nasty/mesh/crash-30d6d0f7c529b3b66b4131700b7a4580cd7082df.ply"));
  const auto car = section_of_file(folder / "5_car3d/drivaernet_N_S_WWS_WM_073.xyz",
                                   parse_section("auto").value());
  ASSERT_TRUE(car) << car.error().message;
  EXPECT_EQ(car->description, "y = 0 (symmetry plane, found)");
}

}  // namespace
}  // namespace keyline::exchange
