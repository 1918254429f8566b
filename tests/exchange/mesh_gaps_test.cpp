#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "keyline/exchange/document_file.h"
#include "keyline/exchange/mesh/mesh.h"

/// Meshes and clouds with something missing or too much: refused, or told.
namespace keyline::exchange {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Where a file fails, or what of it is skipped.
std::string told(const core::Result<Mesh>& mesh) {
  if (!mesh) return mesh.error().path + ": " + mesh.error().message;
  std::string all;
  for (const std::string& what : mesh->skipped) all += what + "\n";
  return all;
}

std::string ply(const std::string& vertex, const std::string& data,
                const std::string& format = "format ascii 1.0\n") {
  return "ply\n" + format + vertex +
         "element face 1\nproperty list uchar int vertex_indices\nend_header\n" + data;
}

const std::string kVertex =
    "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
const std::string kCorners = "0 0 0\n1 0 0\n0 1 0\n";

// Each would otherwise lie in the plane z = 0, or be read from another's numbers.
TEST(MeshGaps, PlyNeedsAFormatAndEveryCoordinateOnce) {
  EXPECT_EQ(told(read_ply(ply(kVertex, kCorners + "3 0 1 2\n"))), "");
  EXPECT_THAT(told(read_ply(ply(kVertex, kCorners + "3 0 1 2\n", ""))),
              HasSubstr("line 8: the header names no format"));
  const std::string x = "property float x\n", y = "property float y\n", z = "property float z\n";
  for (const std::string& properties :
       {x + y, x + z, y + z, x + y + z + z, x + y + "property list uchar float z\n", std::string()})
    EXPECT_THAT(told(read_ply(ply("element vertex 3\n" + properties, kCorners + "3 0 1 2\n"))),
                HasSubstr("as a property, once"))
        << properties;
  EXPECT_THAT(told(read_ply(ply(kVertex + kVertex, kCorners + kCorners + "3 0 1 2\n"))),
              HasSubstr("one element of vertices"));
  EXPECT_THAT(told(read_ply(ply("", "3 0 1 2\n"))), HasSubstr("one element of vertices"));
}

TEST(MeshGaps, PlyCountsInWholeNumbers) {
  EXPECT_THAT(told(read_ply(ply("element vertex 3.5\nproperty float x\n", ""))),
              HasSubstr("line 3: "));
  for (const char* count : {"2.5", "-1"})
    EXPECT_THAT(told(read_ply(ply(kVertex, kCorners + count + " 0 1 2\n"))),
                HasSubstr("line 13: the length of a list"))
        << count;
  EXPECT_THAT(told(read_ply(ply(kVertex, kCorners + "3 0 1 1.5\n"))),
              HasSubstr("1 face that names no vertices"));
}

// A header that counts fewer vertices than the file has; of binary files, too.
TEST(MeshGaps, PlyOfMoreBytesThanItsHeaderTellsSo) {
  const std::string header =
      "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty uchar x\n"
      "property uchar y\nproperty uchar z\nend_header\n";
  EXPECT_EQ(told(read_ply(header + "abc")), "");
  EXPECT_THAT(told(read_ply(header + "abcdef")), HasSubstr("behind the last element"));
}

// Edges, strips and faces under another name are lines and triangles that are not there.
TEST(MeshGaps, PlyTellsElementsItDoesNotRead) {
  const auto with = [](const std::string& element) {
    return told(read_ply("ply\nformat ascii 1.0\n" + kVertex + element + "end_header\n" + kCorners +
                         "3 0 1 2\n"));
  };
  EXPECT_EQ(with("element face 1\nproperty list uchar int vertex_index\n"), "");
  EXPECT_EQ(with("element edge 1\nproperty list uchar int vertex_indices\n"),
            "1 element of the name \"edge\"\n");
  EXPECT_EQ(with("element face 1\nproperty list uchar int vertices\n"),
            "1 element of the name \"face\": the header gives them no vertex_indices\n");
  EXPECT_EQ(with("element edge 0\nproperty int vertex1\n"
                 "element face 1\nproperty list uchar int vertex_index\n"),
            "");
}

const std::string kFacet = "facet normal 0 0 1\nouter loop\n";
const std::string kThree = "vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n";

TEST(MeshGaps, StlLosesNoTriangleWithoutItsEnd) {
  const std::string whole = kFacet + kThree + "endloop\nendfacet\n";
  EXPECT_EQ(told(read_stl("solid\n" + whole + whole + "endsolid\n")), "");
  for (const char* ends : {"endfacet\n", "", "endsolid\n"})
    EXPECT_THAT(told(read_stl("solid\n" + kFacet + kThree + ends + whole + "endsolid\n")),
                HasSubstr("line 7: the vertices before this line have no endloop"))
        << ends;
  EXPECT_THAT(told(read_stl("solid\n" + kFacet + "vertex 0 0 0 5\n" + whole)),
              HasSubstr("line 4: a vertex needs three numbers"));
  EXPECT_THAT(told(read_stl("solid\n" + kFacet + "vertex 0,5 0 0\n" + whole)),
              HasSubstr("line 4: a vertex needs three numbers"));
}

TEST(MeshGaps, StlTellsWhatIsNoStatement) {
  const auto with = [](const std::string& line) {
    return told(read_stl("solid a b\n" + kFacet + line + kThree + "endloop\nendfacet\nendsolid\n"));
  };
  EXPECT_EQ(with(""), "");
  EXPECT_EQ(with("\n  \n"), "");
  EXPECT_EQ(with("vertx 5 5 5\n"), "line 4: \"vertx\" is no statement of STL\n");
}

// The first thousand, in their order; words of the file are cut where they fill a line.
TEST(MeshGaps, NoMoreThanAThousandLinesAreTold) {
  std::string lines;
  for (int i = 0; i < 1200; ++i) lines += "what" + std::string(40, 'x') + "\n";
  const auto check = [](const core::Result<Mesh>& mesh, const std::string& format) {
    ASSERT_TRUE(mesh);
    ASSERT_EQ(mesh->skipped.size(), 1000U);
    const std::string told = ": \"what" + std::string(26, 'x') + "\" is no statement of " + format;
    EXPECT_EQ(mesh->skipped.front(), "line 2" + told);
    EXPECT_EQ(mesh->skipped.back(), "line 1001" + told);
  };
  check(read_obj("#\n" + lines + "v 0 0 0\n"), "OBJ");
  check(read_stl("solid\n" + lines + kFacet + kThree + "endloop\nendfacet\nendsolid\n"), "STL");
}

TEST(MeshGaps, StlOfMoreTrianglesThanItCountsTellsSo) {
  std::string one(84 + 50, '\0');
  one[80] = 1;
  EXPECT_EQ(told(read_stl(one)), "");
  EXPECT_THAT(told(read_stl(one + std::string(50, '\0'))),
              HasSubstr("50 bytes behind the 1 triangle"));
}

// A vertex without its "v" would give all behind it another number.
TEST(MeshGaps, ObjTellsWhatItTakesForNothing) {
  const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  EXPECT_EQ(told(read_obj("vt 0 0\ng a\n" + corners + "f 1 2 3\n")), "");
  EXPECT_EQ(told(read_obj("# v\n#v 1\n\nmtllib a.mtl\nusemtl b\no c\ns off\nvn 0 0 1\n" + corners)),
            "");
  EXPECT_EQ(told(read_obj(corners + "vv 1 2 3\nF 1 2 3\np 1\ncall b.obj\n")),
            "line 4: \"vv\" is no statement of OBJ\nline 5: \"F\" is no statement of OBJ\n"
            "line 6: points by themselves\nline 7: what another file holds\n");
  EXPECT_EQ(told(read_obj("\xef\xbb\xbf" + corners)), "");
  EXPECT_EQ(read_obj(corners + "fo 1 2 3\n")->triangles.size(), 1U);
  EXPECT_THAT(told(read_obj("1 2 3\n" + corners + "f 1 2 3\n")), HasSubstr("line 1: numbers"));
  EXPECT_THAT(told(read_obj(corners + "f 1 2 2.5\n")), HasSubstr("none of the vertices"));
  const auto cut = read_obj(corners + "f 1 2 \\\n3 \\");  // goes on, but the file ends
  ASSERT_TRUE(cut);
  EXPECT_EQ(cut->triangles.size(), 1U);
}

TEST(MeshGaps, MeshesWithoutLinesSayWhatIsLost) {
  const fs::path file =
      fs::temp_directory_path() / ("keyline-gaps-" + std::to_string(::getpid()) + ".obj");
  const auto why = [&](const std::string& text) {
    std::ofstream(file) << "v 0 0 0\nv 1 0 0\n" << text;
    return read_document(file).error().message;
  };
  EXPECT_EQ(why("f 1 2 2\n"), "a mesh or cloud of 2 points and 1 triangle is no curve");
  EXPECT_EQ(why("l 1 3\n"),
            "a mesh or cloud of 2 points and 0 triangles is no curve; skipped: line 3: \"3\" is "
            "none of the vertices");
  fs::remove(file);
}

/// What a cloud of that text leaves out.
std::vector<std::string> left_out(const std::string& text) {
  const fs::path file =
      fs::temp_directory_path() / ("keyline-gaps-" + std::to_string(::getpid()) + ".xyz");
  std::ofstream(file) << text;
  const auto left = stream_points(file, [](core::Point3) {});
  fs::remove(file);
  return left ? left->left_out
              : std::vector<std::string>{left.error().path + ": " + left.error().message};
}

TEST(MeshGaps, CloudsHaveThePointsTheyCount) {
  EXPECT_THAT(left_out("3\n0 0 0\n1 0 0\n0 1 0\n1\n5 5 5\n"), IsEmpty());
  EXPECT_THAT(left_out("4\n0 0 0\n1 0 0\n0 1 0\n1\n5 5 5\n"), ElementsAre(HasSubstr("line 1: ")));
  EXPECT_THAT(left_out("3\n0 0 0\n1 0 0\n0 1 0\n2\n5 5 5\n"), ElementsAre(HasSubstr("line 5: ")));
  EXPECT_THAT(left_out("0 0 0\n1 0 0\nabc\n0 1 0\n"), ElementsAre(HasSubstr("three numbers")));
}

}  // namespace
}  // namespace keyline::exchange
