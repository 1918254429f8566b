#include "keyline/exchange/mesh/mesh_polygon.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "keyline/core/text.h"

/// Faces of more than three corners, as triangles.
namespace keyline::exchange {
namespace {

using core::Point2;
using core::Point3;
using core::Vector3;

const std::vector<Point2> kU = {{0, 0}, {6, 0}, {6, 5}, {4, 5}, {4, 2}, {2, 2}, {2, 5}, {0, 5}};

/// A prism of height 4 over kU, numbered from one of its corners: two faces of eight corners.
struct Prism {
  std::vector<Point3> points;
  std::vector<std::vector<int>> faces;
};

Prism prism(int start) {
  Prism p;
  for (const double z : {0.0, 4.0})
    for (int i = 0; i < 8; ++i) {
      const Point2 corner = kU[static_cast<std::size_t>((start + i) % 8)];
      p.points.push_back({corner.x, corner.y, z});
    }
  p.faces = {{7, 6, 5, 4, 3, 2, 1, 0}, {8, 9, 10, 11, 12, 13, 14, 15}};
  for (int i = 0; i < 8; ++i) p.faces.push_back({i, (i + 1) % 8, (i + 1) % 8 + 8, i + 8});
  return p;
}

std::string text_of(Point3 p) {
  return core::number_text(p.x, 6) + " " + core::number_text(p.y, 6) + " " +
         core::number_text(p.z, 6) + "\n";
}

std::string obj_of(const Prism& prism) {
  std::string text;
  for (const Point3 p : prism.points) text += "v " + text_of(p);
  for (const auto& face : prism.faces) {
    text += "f";
    for (const int i : face) text += " " + std::to_string(i + 1);
    text += "\n";
  }
  return text;
}

std::string ply_of(const Prism& prism) {
  std::string text =
      "ply\nformat ascii 1.0\nelement vertex " + std::to_string(prism.points.size()) +
      "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
      std::to_string(prism.faces.size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Point3 p : prism.points) text += text_of(p);
  for (const auto& face : prism.faces) {
    text += std::to_string(face.size());
    for (const int i : face) text += " " + std::to_string(i);
    text += "\n";
  }
  return text;
}

double length(const SectionLine& line) {
  double sum = 0;
  for (std::size_t i = 0; i < line.points.size(); ++i)
    sum += distance(line.points[i], line.points[(i + 1) % line.points.size()]);
  return sum;
}

// At y = 3.5 there are the two arms, 2 wide and 4 high: nothing runs between them or back.
TEST(MeshPolygon, HollowFacesAreCutWhereTheyAre) {
  for (int start = 0; start < 8; ++start)
    for (const auto& mesh : {read_obj(obj_of(prism(start))), read_ply(ply_of(prism(start)))}) {
      SCOPED_TRACE(start);
      ASSERT_TRUE(mesh) << mesh.error().message;
      EXPECT_EQ(mesh->triangles.size(), 28U);
      const auto lines = section(*mesh, acquire::plane_of({0, 1, 0}, 3.5));
      ASSERT_EQ(lines.size(), 2U);
      std::vector<double> from;
      for (const SectionLine& line : lines) {
        EXPECT_TRUE(line.closed);
        EXPECT_NEAR(length(line), 12, 1e-12);
        const auto less_x = [](Point2 a, Point2 b) { return a.x < b.x; };
        const auto less_y = [](Point2 a, Point2 b) { return a.y < b.y; };
        const auto& p = line.points;
        from.push_back(std::min_element(p.begin(), p.end(), less_x)->x);
        EXPECT_EQ(std::max_element(p.begin(), p.end(), less_x)->x, from.back() + 2);
        EXPECT_EQ(std::min_element(p.begin(), p.end(), less_y)->y, 0);
        EXPECT_EQ(std::max_element(p.begin(), p.end(), less_y)->y, 4);
      }
      EXPECT_THAT(from, testing::UnorderedElementsAre(0, 4));
    }
}

/// The triangles of a face in the plane of two directions, whose corners are numbered from `start`:
/// twice the area of all of them along the plane's normal, and of all that turn against it.
struct Areas {
  double sum = 0;
  double against = 0;
  std::size_t triangles = 0;
};

Areas areas(const std::vector<Point2>& face, Vector3 x, Vector3 y, std::size_t start = 0) {
  Mesh mesh;
  for (std::size_t i = 0; i < face.size(); ++i) {
    const Point2 p = face[(start + i) % face.size()];
    mesh.points.push_back(Point3{} + p.x * x + p.y * y);
  }
  std::vector<std::uint32_t> corners(face.size());
  std::iota(corners.begin(), corners.end(), 0U);
  EXPECT_TRUE(detail::add_polygon(mesh, corners));
  Areas result;
  for (const auto& [a, b, c] : mesh.triangles) {
    const double area = dot(cross(mesh.points[b] - mesh.points[a], mesh.points[c] - mesh.points[a]),
                            cross(x, y) / norm(cross(x, y)));
    result.sum += area;
    result.against = std::min(result.against, area);
  }
  result.triangles = mesh.triangles.size();
  return result;
}

// Triangles that all turn as the face does and add up to its area do not overlap.
TEST(MeshPolygon, TrianglesFillTheFaceOnce) {
  struct Case {
    const char* what;
    std::vector<Point2> face;
    double twice;
  };
  std::vector<Point2> comb;  // twenty teeth of width 1 and height 10 on a bar of height 1
  for (int i = 0; i < 20; ++i) {
    const double at = 40 - 2.0 * i;
    comb.insert(comb.end(), {{at, 0}, {at, 10}, {at - 1, 10}, {at - 1, 0}});
  }
  comb.insert(comb.end(), {{1, -1}, {40, -1}});
  const Case cases[] = {
      {"U", kU, 48},
      {"arrow", {{0, 0}, {2, 3}, {0, 1}, {-2, 3}}, 4},
      {"points on its sides",
       {{0, 0}, {3, 0}, {6, 0}, {6, 6}, {4, 6}, {4, 4}, {4, 2}, {2, 2}, {2, 4}, {2, 6}, {0, 6}},
       56},
      {"a hole, by a cut there and back",
       {{0, 0}, {6, 0}, {6, 6}, {0, 6}, {0, 0}, {2, 2}, {2, 4}, {4, 4}, {4, 2}, {2, 2}},
       64},
      {"comb", comb, 2 * (20 * 10 + 39)},
  };
  const Vector3 frames[][2] = {
      {{1, 0, 0}, {0, 1, 0}},     {{0, 1, 0}, {1, 0, 0}},      {{0, 0, 1}, {1, 0, 0}},
      {{1, 0, 0}, {0, 0, 1}},     {{0, 1, 0}, {0, 0, 1}},      {{0, 0, 1}, {0, 1, 0}},
      {{0.6, 0, 0.8}, {0, 1, 0}}, {{0, 0.6, -0.8}, {1, 0, 0}}, {{0.8, 0.6, 0}, {0, 0, 1}}};
  for (const Case& c : cases)
    for (const auto& [x, y] : frames)
      for (std::size_t start = 0; start < c.face.size(); ++start) {
        SCOPED_TRACE(c.what);
        const Areas found = areas(c.face, x, y, start);
        EXPECT_EQ(found.triangles, c.face.size() - 2);
        EXPECT_NEAR(found.sum, c.twice, 1e-11);
        EXPECT_GT(found.against, -1e-12) << start;
      }
}

// Faces without an area, and those that cross themselves, have as many triangles as others.
TEST(MeshPolygon, FacesThatAreNoneAreFans) {
  const Vector3 x{1, 0, 0}, y{0, 1, 0};
  EXPECT_EQ(areas({{0, 0}, {1, 0}, {2, 0}, {1, 0}}, x, y).triangles, 2U);
  EXPECT_EQ(areas({{0, 0}, {1, 1}, {1, 0}, {0, 1}}, x, y).triangles, 2U);
  EXPECT_EQ(areas({{0, 0}, {4, 3}, {1, 5}, {3, 0}, {3, 5}, {0, 3}}, x, y).triangles, 4U);
  EXPECT_EQ(areas({{0, 0}, {NAN, 0}, {2, 2}, {1, 0}, {0, 1}}, x, y).triangles, 3U);
}

// Time grows with the square of the corners; files are not let to choose it. A face that is a fan
// about its first corner takes none.
TEST(MeshPolygon, FacesOfTooManyCornersAreTold) {
  for (const bool hollow : {false, true}) {
    std::string text;
    std::string face = "f";
    const int n = static_cast<int>(detail::kMostCorners) + 1;
    for (int i = 0; i < n; ++i) {
      const double angle = 2 * 3.14159265358979 * i / n;
      const double r = hollow && i % 2 == 0 ? 50 : 100;
      text += "v " + text_of({r * std::cos(angle), r * std::sin(angle), 0});
      face += " " + std::to_string(i + 1);
    }
    const auto mesh = read_obj(text + face + "\n");
    ASSERT_TRUE(mesh);
    EXPECT_EQ(mesh->triangles.size(), static_cast<std::size_t>(n - 2));
    ASSERT_EQ(mesh->skipped.size(), hollow ? 1U : 0U);
    if (hollow) {
      EXPECT_EQ(mesh->skipped[0],
                "line " + std::to_string(n + 1) + ": a face of too many corners; divide it");
    }
  }
}

}  // namespace
}  // namespace keyline::exchange
