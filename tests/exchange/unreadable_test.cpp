#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "keyline/exchange/document_file.h"
#include "keyline/exchange/dxf/dxf_reader.h"
#include "keyline/exchange/mesh/mesh.h"

namespace keyline::exchange {
namespace {

namespace fs = std::filesystem;
using document::Document;
using testing::Contains;
using testing::HasSubstr;

/// Groups "code value code value …", one on each line.
std::string lines_of(const std::string& words) {
  std::string text = words;
  for (char& c : text)
    if (c == ' ') c = '\n';
  return text + '\n';
}

struct TextFile {
  const char* name;  ///< with the extension that tells the format
  std::string text;  ///< with @ in place of one number
};

// One number of every kind of thing each text format holds.
std::vector<TextFile> files() {
  const auto dxf = [](const std::string& entities) {
    return lines_of("0 SECTION 2 ENTITIES " + entities + " 0 ENDSEC 0 EOF");
  };
  const auto svg = [](const std::string& shape) {
    return "<svg xmlns='http://www.w3.org/2000/svg' width='9mm' height='9mm' viewBox='0 0 9 9'>\n" +
           shape + "\n</svg>\n";
  };
  const auto mesh = [](const std::string& vertex) {
    return "v " + vertex + "\nv 1 0 0\nv 0 1 0\nl 1 2\nl 2 3\n";
  };
  return {
      {"line.dxf", dxf("0 LINE 8 0 10 @ 20 0 11 1 21 1")},
      {"arc.dxf", dxf("0 ARC 8 0 10 0 20 0 40 1 50 @ 51 90")},
      {"circle.dxf", dxf("0 CIRCLE 8 0 10 0 20 @ 40 1")},
      {"ellipse.dxf", dxf("0 ELLIPSE 8 0 10 0 20 0 11 1 21 @ 31 0 40 0.5")},
      {"bulge.dxf", dxf("0 LWPOLYLINE 8 0 90 2 70 0 10 0 20 0 42 @ 10 1 20 1")},
      {"vertex.dxf",
       dxf("0 POLYLINE 8 0 66 1 0 VERTEX 8 0 10 0 20 0 0 VERTEX 8 0 10 @ 20 1 0 SEQEND")},
      {"knot.dxf", dxf("0 SPLINE 8 0 70 8 71 1 40 0 40 0 40 @ 40 1 10 0 20 0 10 1 20 1")},
      {"weight.dxf",
       dxf("0 SPLINE 8 0 70 12 71 1 40 0 40 0 40 1 40 1 41 1 41 @ 10 0 20 0 10 1 20 1")},
      {"extrusion.dxf", dxf("0 CIRCLE 8 0 10 0 20 0 40 1 210 0 220 0 230 @")},
      {"insert.dxf", lines_of("0 SECTION 2 BLOCKS 0 BLOCK 2 b 10 0 20 0 0 LINE 8 0 10 0 20 0 11 1 "
                              "21 1 0 ENDBLK 0 ENDSEC 0 SECTION 2 ENTITIES 0 INSERT 8 0 2 b 10 @ "
                              "20 0 0 ENDSEC 0 EOF")},
      {"base.dxf", lines_of("0 SECTION 2 BLOCKS 0 BLOCK 2 b 10 @ 20 0 0 LINE 8 0 10 0 20 0 11 1 "
                            "21 1 0 ENDBLK 0 ENDSEC 0 SECTION 2 ENTITIES 0 INSERT 8 0 2 b 10 1 "
                            "20 0 0 ENDSEC 0 EOF")},
      {"unit.dxf", lines_of("0 SECTION 2 HEADER 9 $INSUNITS 70 @ 0 ENDSEC 0 SECTION 2 ENTITIES 0 "
                            "LINE 8 0 10 0 20 0 11 1 21 1 0 ENDSEC 0 EOF")},
      {"path.svg", svg("<path d='M 0 0 L @ 1'/>")},
      {"rect.svg", svg("<rect x='0' y='0' width='@' height='2'/>")},
      {"round.svg", svg("<rect x='0' y='0' width='4' height='2' rx='@'/>")},
      {"circle.svg", svg("<circle cx='@' cy='0' r='2'/>")},
      {"points.svg", svg("<polyline points='0,0 1,@ 2,2'/>")},
      {"transform.svg", svg("<path transform='translate(@ 1)' d='M 0 0 L 1 1'/>")},
      {"page.svg",
       "<svg xmlns='http://www.w3.org/2000/svg' width='@' height='9mm' "
       "viewBox='0 0 9 9'><path d='M0 0 L 1 1'/></svg>"},
      {"box.svg",
       "<svg xmlns='http://www.w3.org/2000/svg' width='9mm' height='9mm' "
       "viewBox='0 0 @ 9'><path d='M0 0 L 1 1'/></svg>"},
      {"use.svg", svg("<path id='a' d='M0 0 L 1 1'/><use href='#a' x='@'/>")},
      {"vertex.obj", mesh("@ 0 0")},
      {"point.glif",
       "<glyph name='a' format='2'><outline><contour><point x='0' y='0' "
       "type='line'/><point x='@' y='1' type='line'/><point x='1' y='0' "
       "type='line'/></contour></outline></glyph>"},
      {"row.csv", "x,y\n0,0\n@,1\n2,2\n"},
      {"row.dat", "0 0\n1 @\n2 2\n3 3\n"},
      {"hull.csv", "waterline,0,1,2\n0,1,@,2\n1,1,2,3\n"},
      {"curve.json", R"({"type":"polyline","points":[[0,0],[@,1]]})"},
  };
}

class Unreadable : public testing::Test {
 protected:
  Unreadable()
      : folder_(fs::temp_directory_path() / ("keyline-unreadable-" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
  }
  ~Unreadable() override { fs::remove_all(folder_); }

  core::Result<Document> read(const TextFile& file, const std::string& number) const {
    std::string text = file.text;
    text.replace(text.find('@'), 1, number);
    const fs::path path = folder_ / file.name;
    std::ofstream(path, std::ios::binary) << text;
    return read_document(path);
  }

  fs::path folder_;
};

// A number that cannot be read is refused, or what it belongs to is named among the things skipped:
// the file with 1 in its place says less.
TEST_F(Unreadable, NumbersAreNeverTakenForOthers) {
  for (const TextFile& file : files()) {
    SCOPED_TRACE(file.name);
    const auto sound = read(file, "1");
    ASSERT_TRUE(sound) << sound.error().message;
    const std::string name = file.name;
    for (const std::string number : {"abc", "1e400", "nan", "3,5", "1.2.3", "0x1p", "--1"}) {
      SCOPED_TRACE(number);
      const bool commas = name.ends_with(".csv") || name.ends_with(".svg") ||
                          name.ends_with(".json") || name.ends_with(".dat");
      if (number == "3,5" && commas) continue;                   // two numbers there
      if (number == "nan" && name.starts_with("row")) continue;  // a missing entry
      if (number == "nan" && name.starts_with("hull")) continue;
      const auto document = read(file, number);
      if (!document) continue;
      EXPECT_GT(document->skipped.size(), sound->skipped.size());
    }
  }
}

// What lies beyond 1e100 has lengths and sections that are no numbers.
TEST_F(Unreadable, CoordinatesTooLargeAreTold) {
  const std::set<std::string> no_coordinates = {
      // an angle, a weight, a direction, sizes
      "arc.dxf", "bulge.dxf", "weight.dxf", "extrusion.dxf", "round.svg", "page.svg", "box.svg"};
  for (const TextFile& file : files()) {
    SCOPED_TRACE(file.name);
    if (no_coordinates.contains(file.name)) continue;
    const auto sound = read(file, "1");
    ASSERT_TRUE(sound) << sound.error().message;
    for (const std::string number : {"1e150", "-1.1e100", "1e300"}) {
      const auto document = read(file, number);
      EXPECT_TRUE(!document || document->skipped.size() > sound->skipped.size()) << number;
    }
  }
}

TEST_F(Unreadable, NumbersTooSmallAreZero) {
  const TextFile file{"line.dxf", files()[0].text};
  const auto document = read(file, "1e-400");
  ASSERT_TRUE(document) << document.error().message;
  EXPECT_TRUE(document->skipped.empty());
  EXPECT_EQ(evaluate(document->paths.at(0).path, 0), (core::Point2{0, 0}));
}

TEST_F(Unreadable, DxfNamesTheLine) {
  const auto document = read_dxf(lines_of(
      "0 SECTION 2 ENTITIES 0 LINE 8 0 10 0 20 0 11 1 21 1 0 LINE 8 0 10 abc 20 0 11 1 21 1 0 "
      "ENDSEC 0 EOF"));
  ASSERT_TRUE(document);
  EXPECT_EQ(document->paths.size(), 1u);
  EXPECT_THAT(document->skipped,
              testing::ElementsAre("line 18: LINE: \"abc\" at line 22 is no number"));
}

// Cut off anywhere, a drawing is refused, or says that it is not whole; what is read of it is what
// the whole one holds.
TEST_F(Unreadable, DxfCutOffIsNotWhole) {
  const std::string whole = lines_of(
      "0 SECTION 2 ENTITIES 0 LINE 8 0 10 12.5 20 7 11 100 21 1 0 LWPOLYLINE 8 0 90 3 70 1 10 0 20 "
      "0 "
      "42 0.5 10 2 20 0 10 2 20 33 0 POLYLINE 8 0 66 1 0 VERTEX 8 0 10 0 20 0 0 VERTEX 8 0 10 5 20 "
      "15 0 SEQEND 8 0 0 ENDSEC 0 EOF");
  const auto sound = read_dxf(whole);
  ASSERT_TRUE(sound);
  ASSERT_EQ(sound->paths.size(), 3u);
  for (std::size_t bytes = 1; bytes + 4 < whole.size(); ++bytes) {
    SCOPED_TRACE(bytes);
    const auto cut = read_dxf(whole.substr(0, bytes));
    if (!cut) continue;
    EXPECT_FALSE(cut->skipped.empty());
    ASSERT_LE(cut->paths.size(), 3u);
    for (std::size_t i = 0; i < cut->paths.size(); ++i)
      EXPECT_EQ(evaluate(cut->paths[i].path, 1), evaluate(sound->paths[i].path, 1));
  }
}

TEST_F(Unreadable, StlCutOffSaysSo) {
  const std::string facet =
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
      "endfacet\n";
  const auto whole = read_stl("solid a\n" + facet + "endsolid a\n");
  ASSERT_TRUE(whole);
  EXPECT_TRUE(whole->skipped.empty());
  const auto cut = read_stl("solid a\n" + facet + "facet normal 0 0 1\nouter loop\nvertex 0 0 0\n");
  ASSERT_TRUE(cut);
  EXPECT_THAT(cut->skipped, Contains(HasSubstr("before its endsolid")));
}

}  // namespace
}  // namespace keyline::exchange
