#include <chrono>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "keyline/core/angle.h"
#include "keyline/exchange/dxf/dxf_names.h"
#include "keyline/exchange/dxf/dxf_reader.h"
#include "keyline/exchange/dxf/dxf_shape.h"
#include "keyline/exchange/dxf/dxf_writer.h"

/// Inserts, and what is written, group by group as in Autodesk's DXF reference.
namespace keyline::exchange {
namespace {

using core::Point2;
using document::Document;
using testing::HasSubstr;
using testing::Not;

/// A drawing of one block "b", which is a line from its base (1, 2) by (3, 0), and what inserts it.
Document inserted(const std::string& insert) {
  std::istringstream words(
      "0 SECTION 2 BLOCKS 0 BLOCK 2 b 10 1 20 2 0 LINE 8 0 10 1 20 2 11 4 21 2 0 ENDBLK 0 ENDSEC "
      "0 SECTION 2 ENTITIES 0 INSERT 8 0 2 b " +
      insert + " 0 ENDSEC 0 EOF");
  std::string text;
  for (std::string word; words >> word;) text += word + "\n";
  return read_dxf(text).value();
}

std::vector<Point2> starts(const Document& d) {
  std::vector<Point2> points;
  for (const auto& named : d.paths) points.push_back(evaluate(named.path, 0));
  return points;
}

// 70 columns 44 apart along x, 71 rows 45 apart along y.
TEST(DxfInsert, ArraysHaveColumnsAndRows) {
  const Document d = inserted("10 10 20 20 70 3 71 2 44 5 45 7");
  EXPECT_EQ(starts(d),
            (std::vector<Point2>{{10, 20}, {15, 20}, {20, 20}, {10, 27}, {15, 27}, {20, 27}}));
  EXPECT_EQ(evaluate(d.paths[5].path, 1), (Point2{23, 27}));
}

// The array turns with the insert: by 90 degrees x becomes y, y becomes -x. Scales are the block's.
TEST(DxfInsert, ArraysTurnButDoNotScale) {
  const Document d = inserted("10 0 20 0 70 2 71 2 44 5 45 7 50 90 41 2 42 3");
  const std::vector<Point2> wanted{{0, 0}, {0, 5}, {-7, 0}, {-7, 5}};
  ASSERT_EQ(d.paths.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_LT(distance(starts(d)[i], wanted[i]), 1e-14);
    EXPECT_LT(distance(evaluate(d.paths[i].path, 1), wanted[i] + core::Vector2{0, 6}), 1e-14);
  }
}

const std::string kLine = " 0 LINE 8 0 10 0 20 0 11 1 21 0 ";

/// What a drawing of these blocks and tables, a line and these entities tells.
Document drawing(const std::string& blocks, const std::string& entities,
                 const std::string& tables = {}) {
  std::istringstream words("0 SECTION 2 TABLES " + tables + " 0 ENDSEC 0 SECTION 2 BLOCKS " +
                           blocks + " 0 ENDSEC 0 SECTION 2 ENTITIES " + kLine + entities +
                           " 0 ENDSEC 0 EOF");
  std::string text;
  for (std::string word; words >> word;) text += word + "\n";
  return read_dxf(text).value_or(Document{});
}

std::string block(const std::string& name, const std::string& entities,
                  const std::string& further = {}) {
  return " 0 BLOCK 8 0 2 " + name + ' ' + further + " 10 0 20 0 " + entities + " 0 ENDBLK ";
}

// DXF reference, "BLOCK": 70 has 4 for an external reference, 8 for one laid over; 1 is its path.
TEST(DxfInsert, BlocksOfOtherFilesAreTold) {
  const auto with = [](const std::string& flags) {
    return drawing(block("site", "", "70 " + flags + " 1 plans/site.dwg"),
                   "0 INSERT 8 0 2 site 10 0 20 0")
        .skipped;
  };
  for (const char* flags : {"4", "36", "8"})
    EXPECT_THAT(with(flags), testing::ElementsAre(HasSubstr(
                                 "INSERT: block \"site\" is another file, \"plans/site.dwg\"")))
        << flags;
  EXPECT_THAT(with("0"), testing::IsEmpty());
}

TEST(DxfInsert, BlocksThatNothingInsertsAreTold) {
  const auto told = [](const std::string& blocks, const std::string& entities = {}) {
    const Document d = drawing(blocks, entities);
    return d.skipped.empty() ? std::string("nothing") : d.skipped.front();
  };
  EXPECT_EQ(told(block("wheel", kLine)), "1 entity of 1 block that nothing inserts: wheel");
  EXPECT_EQ(told(block("wheel", kLine), "0 INSERT 8 0 2 wheel 10 0 20 0"), "nothing");
  EXPECT_EQ(told(block("empty", "")), "nothing");
  // One within another stands where that stands.
  const std::string nested =
      block("hub", kLine + kLine) + block("wheel", "0 INSERT 8 0 2 hub 10 0 20 0");
  EXPECT_EQ(told(nested), "3 entities of 2 blocks that nothing inserts: hub, wheel");
  EXPECT_EQ(told(nested, "0 INSERT 8 0 2 wheel 10 0 20 0"), "nothing");
  // A dimension shows its block, and what stands in that; so does an insert on a layout.
  const std::string arrow =
      block("_ArchTick", kLine) + block("*D1", "0 INSERT 8 0 2 _archtick 10 0 20 0");
  EXPECT_EQ(told(arrow), "2 entities of 2 blocks that nothing inserts: *D1, _ArchTick");
  EXPECT_THAT(told(arrow, "0 DIMENSION 8 0 2 *D1 10 0 20 0"), Not(HasSubstr("inserts")));
  EXPECT_THAT(told(block("Title", kLine), "0 INSERT 8 0 67 1 2 TITLE 10 0 20 0"),
              Not(HasSubstr("inserts")));
  EXPECT_THAT(
      told(block("Title", kLine) + block("*Paper_Space0", "0 INSERT 8 0 2 TITLE 10 0 20 0")),
      Not(HasSubstr("inserts")));
  EXPECT_EQ(told(block("a", kLine) + block("b", kLine) + block("c", kLine) + block("d", kLine)),
            "4 entities of 4 blocks that nothing inserts: a, b, c and others");
  // The picture of a dimension, which is told by its type.
  EXPECT_EQ(told(block("*D1", kLine), "0 DIMENSION 8 0 2 *d1 10 0 20 0"), "DIMENSION: 1 entity");
}

// *Paper_Space0 and so on hold the layouts that are not in front.
TEST(DxfInsert, LayoutsAreTold) {
  const Document d = drawing(
      block("*Model_Space", "") + block("*Paper_Space", "") + block("*Paper_Space0", kLine + kLine),
      "0 LINE 67 1 8 0 10 0 20 0 11 1 21 0");
  EXPECT_EQ(d.paths.size(), 1U);
  EXPECT_THAT(d.skipped, testing::ElementsAre("3 entities in paper space"));
}

// In the tables of a DXF "walls" and "WALLS" are one.
TEST(DxfInsert, NamesAreTheSameInSmallAndLargeLetters) {
  const std::string layers =
      "0 TABLE 2 LAYER 0 LAYER 2 Walls 70 0 62 -1 0 LAYER 2 Doors 70 0 62 5 0 ENDTAB";
  const Document d = drawing(block("WHEEL", " 0 LINE 8 DOORS 10 0 20 0 11 1 21 0 "),
                             "0 INSERT 8 0 2 wheel 10 5 20 5", layers);
  ASSERT_EQ(d.paths.size(), 2U);
  EXPECT_EQ(d.paths[1].label.color, "#0000ff");
  const Document of_layers =
      drawing("", "0 LINE 8 walls 10 0 20 0 11 1 21 0 0 LINE 8 WALLS 10 0 20 0 11 1 21 0", layers);
  EXPECT_THAT(of_layers.skipped,
              testing::ElementsAre("nothing, but off or frozen: layer Walls, 2 entities"));
  EXPECT_EQ(of_layers.paths.at(1).label.color, "#ff0000");
}

TEST(DxfInsert, CountsBelowOneAreOne) {
  EXPECT_EQ(inserted("10 0 20 0 70 0 71 -3 44 5 45 7").paths.size(), 1U);
  EXPECT_EQ(inserted("10 0 20 0").paths.size(), 1U);
}

// The last vertex of an open polyline has no edge behind it, and so no bulge that counts.
TEST(DxfInsert, TheBulgeBehindAnOpenPolylineDoesNotCount) {
  using detail::BulgeVertex;
  const auto is_line = [](std::vector<BulgeVertex> v, bool closed) {
    return std::holds_alternative<curve::Polyline3>(detail::polyline_shape(v, closed));
  };
  const BulgeVertex a{{0, 0, 0}, 0}, b{{1, 0, 0}, 0}, c{{1, 1, 0}, 0};
  BulgeVertex bent = c;
  bent.bulge = 0.5;
  BulgeVertex middle = b;
  middle.bulge = 0.5;
  EXPECT_TRUE(is_line({a, b, c}, false));
  EXPECT_TRUE(is_line({a, b, bent}, false));
  EXPECT_FALSE(is_line({a, b, bent}, true));
  EXPECT_FALSE(is_line({a, middle, c}, false));
  EXPECT_TRUE(is_line({}, false));
}

// ---- Written groups ----------------------------------------------------------------------------

/// The groups of the first entity of that type in what is written of a curve.
std::vector<std::pair<int, std::string>> groups_of(const Document& d, const std::string& type,
                                                   std::size_t which = 0) {
  const auto written = write_dxf(d, {.tolerance = 1e-3});
  EXPECT_TRUE(written) << written.error().message;
  std::istringstream lines(written->content);
  std::vector<std::pair<int, std::string>> groups;
  bool entities = false;
  std::size_t met = 0;
  for (std::string code, text; std::getline(lines, code) && std::getline(lines, text);) {
    entities = entities || text == "ENTITIES";
    if (std::stoi(code) == 0) met += entities && text == type;
    if (std::stoi(code) == 0 && (met > which + 1 || (met > which && text != type))) break;
    if (met == which + 1) groups.emplace_back(std::stoi(code), text);
  }
  return groups;
}

std::string all(const std::vector<std::pair<int, std::string>>& groups, int code) {
  std::string text;
  for (const auto& [own, value] : groups)
    if (own == code) text += (text.empty() ? "" : " ") + value;
  return text;
}

Document space(document::SpaceCurve curve) {
  Document d;
  d.space_curves.push_back({{"n", "l", "#ff0000"}, std::move(curve)});
  return d;
}

TEST(DxfGroups, OfAPolylineInSpace) {
  const Document d = space({curve::Polyline3{{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}}}});
  const auto head = groups_of(d, "POLYLINE");
  EXPECT_EQ(all(head, 66), "1");  // vertices follow
  EXPECT_EQ(all(head, 70), "8");  // in space
  EXPECT_EQ(all(head, 8), "l");
  EXPECT_EQ(all(head, 62), "1");  // red
  EXPECT_EQ(all(head, 420), "16711680");
  EXPECT_EQ(all(head, 10) + all(head, 20) + all(head, 30), "000");
  const auto vertex = groups_of(d, "VERTEX", 1);
  EXPECT_EQ(all(vertex, 70), "32");
  EXPECT_EQ(all(vertex, 10) + " " + all(vertex, 20) + " " + all(vertex, 30), "4 5 6");
  EXPECT_EQ(all(vertex, 100), "AcDbEntity AcDbVertex AcDb3dPolylineVertex");
  EXPECT_EQ(all(groups_of(d, "SEQEND"), 8), "l");
}

TEST(DxfGroups, OfALineInSpace) {
  const auto line = groups_of(space({curve::Polyline3{{{1, 2, 3}, {4, 5, 6}}}}), "LINE");
  EXPECT_EQ(all(line, 10) + all(line, 20) + all(line, 30), "123");
  EXPECT_EQ(all(line, 11) + all(line, 21) + all(line, 31), "456");
}

// Flags: 1 closed, 4 rational, 8 planar.
TEST(DxfGroups, OfASpline) {
  const auto bent =
      groups_of(space({curve::Bezier3{{{0, 0, 1}, {1, 2, 3}, {2, 0, 0}}, {1, 0.5, 1}}}), "SPLINE");
  EXPECT_EQ(all(bent, 70), "4");
  EXPECT_EQ(all(bent, 71), "2");
  EXPECT_EQ(all(bent, 72), "6");
  EXPECT_EQ(all(bent, 73), "3");
  EXPECT_EQ(all(bent, 74), "0");
  EXPECT_EQ(all(bent, 40), "0 0 0 1 1 1");
  EXPECT_EQ(all(bent, 41), "1 0.5 1");
  EXPECT_EQ(all(bent, 10), "0 1 2");
  EXPECT_EQ(all(bent, 20), "0 2 0");
  EXPECT_EQ(all(bent, 30), "1 3 0");
  const auto loop = groups_of(
      space({curve::Bezier3{{{0, 0, 1}, {1, 2, 3}, {2, 0, 0}, {0, 0, 1}}, {}}}), "SPLINE");
  EXPECT_EQ(all(loop, 70), "1");
  Document flat;
  flat.paths.push_back(
      {{"", "", ""}, {{{curve::Bezier2{{{0, 0}, {1, 2}, {2, 0}}, {}}}}, false}, 0});
  const auto planar = groups_of(flat, "SPLINE");
  EXPECT_EQ(all(planar, 70), "8");
  EXPECT_EQ(all(planar, 210) + all(planar, 220) + all(planar, 230), "001");
  EXPECT_EQ(all(planar, 62), "");
  EXPECT_EQ(all(planar, 8), "0");
}

TEST(DxfGroups, OfAnArcAndACircle) {
  Document d;
  const lac::Chain quarter{{{5, 0}, core::kPi / 2}, {{-1, core::kPi, 0.5, 0.5}}, false};
  d.paths.push_back({{"", "", ""}, {{{quarter}}, false}, 0});
  const auto arc = groups_of(d, "ARC");
  const auto number = [&](int code) { return std::stod(all(arc, code)); };
  EXPECT_NEAR(number(10), 3, 1e-14);
  EXPECT_NEAR(number(20), 0, 1e-14);
  EXPECT_EQ(number(40), 2);
  EXPECT_NEAR(number(50), 0, 1e-12);
  EXPECT_NEAR(number(51), 90, 1e-12);
}

// Layers that differ in letter case alone, which a DXF does not tell apart: numbered, each once.
TEST(DxfNames, ThousandsOfLayersOfOneNameTakeNoTime) {
  constexpr unsigned kLayers = 8'192;
  Document d;
  for (unsigned bits = 0; bits < kLayers; ++bits) {
    std::string layer(13, 'a');
    for (unsigned k = 0; k < layer.size(); ++k)
      if ((bits >> k & 1U) != 0) layer[k] = 'A';
    d.paths.push_back({{"", layer, ""}, {{{curve::Polyline2{{{0, 0}, {1, 2}}}}}, false}});
  }
  const auto begin = std::chrono::steady_clock::now();
  const auto layers = detail::dxf_layers(d);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(2));  // else 20 and more
  ASSERT_EQ(layers.size(), kLayers + 2U);
  EXPECT_EQ(layers.at("aaaaaaaaaaaaa"), "aaaaaaaaaaaaa");
  std::set<std::string> names;
  for (const auto& [layer, name] : layers)
    if (layer.size() == 13) names.insert(name.substr(13));
  EXPECT_EQ(names.size(), kLayers);
  EXPECT_TRUE(names.contains("_" + std::to_string(kLayers)));
}

}  // namespace
}  // namespace keyline::exchange
