#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "keyline/core/angle.h"
#include "keyline/document/arc.h"
#include "keyline/exchange/document_file.h"
#include "keyline/exchange/dxf/dxf_color.h"
#include "keyline/exchange/dxf/dxf_reader.h"
#include "keyline/exchange/dxf/dxf_writer.h"

#include "tests/shared_data.h"

namespace keyline::exchange {
namespace {

using core::Point2;
using document::Document;
using testing::HasSubstr;

/// Groups "code value code value …" parted by blanks as a drawing's entities.
std::string drawing(const std::string& entities, const std::string& before = {}) {
  std::istringstream words(before + " 0 SECTION 2 ENTITIES " + entities + " 0 ENDSEC 0 EOF");
  std::string text;
  for (std::string word; words >> word;) text += word + "\n";
  return text;
}

Document read(const std::string& text) {
  auto document = read_dxf(text);
  EXPECT_TRUE(document) << document.error().message << ' ' << document.error().path;
  return document.value_or(Document{});
}

const document::PlanarCurve& only(const Document& d) { return d.paths.at(0).path.curves.at(0); }

document::Arc arc_of(const document::PlanarCurve& c) {
  const auto arc = document::as_arc(lac::segment_at(std::get<lac::Chain>(c.value), 0));
  EXPECT_TRUE(arc);
  return arc.value_or(document::Arc{});
}

TEST(DxfReader, ArcsAndCirclesStayExact) {
  const Document d =
      read(drawing("0 ARC 8 body 10 3 20 4 40 5 50 350 51 20 0 CIRCLE 8 0 10 1 20 2 40 7"));
  ASSERT_EQ(d.paths.size(), 2U);
  EXPECT_EQ(d.paths[0].label.layer, "body");
  EXPECT_EQ(d.paths[0].label.name, "");
  const auto arc = arc_of(only(d));
  EXPECT_NEAR(distance(arc.center, Point2{3, 4}), 0, 1e-14);
  EXPECT_NEAR(arc.radius, 5, 1e-14);
  EXPECT_NEAR(arc.turn, 30 * core::kPi / 180, 1e-14);
  EXPECT_TRUE(d.paths[1].path.closed);
}

TEST(DxfReader, BulgesAreArcs) {
  const Document d =
      read(drawing("0 LWPOLYLINE 8 0 90 3 70 1 10 0 20 0 42 1 10 2 20 0 10 2 20 3 42 -0.5"));
  ASSERT_EQ(d.paths.size(), 1U);
  EXPECT_TRUE(d.paths[0].path.closed);
  // A bulge of 1 is a half turn to the left: from (0,0) to (2,0) below the x axis.
  const auto half = evaluate(d.paths[0].path.curves[0], 1);
  EXPECT_NEAR(distance(half, Point2{1, -1}), 0, 1e-15);
  const auto arc = document::as_arc(std::get<curve::Bezier2>(d.paths[0].path.curves[0].value));
  ASSERT_TRUE(arc);
  EXPECT_NEAR(arc->radius, 1, 1e-15);
  EXPECT_EQ(evaluate(d.paths[0].path, 1), (Point2{0, 0}));
  EXPECT_EQ(d.paths[0].path.curves.size(), 5U);
}

TEST(DxfReader, RationalSplinesKeepTheirWeights) {
  const Document d =
      read(drawing("0 SPLINE 8 0 70 12 71 2 72 6 73 3 40 0 40 0 40 0 40 1 40 1 40 1 "
                   "41 1 41 0.5 41 1 10 0 20 0 30 0 10 1 20 2 30 0 10 2 20 0 30 0"));
  const auto& spline = std::get<curve::BSpline2>(only(d).value);
  EXPECT_EQ(spline.weights, (std::vector<double>{1, 0.5, 1}));
  EXPECT_EQ(spline.control[1], (Point2{1, 2}));
}

TEST(DxfReader, FitPointsArePassed) {
  const Document d = read(drawing(
      "0 SPLINE 8 0 70 8 71 3 74 4 11 0 21 0 31 0 11 1 21 1 31 0 11 3 21 1 31 0 11 4 21 0 31 0"));
  const auto& path = d.paths.at(0).path;
  ASSERT_EQ(path.curves.size(), 3U);
  EXPECT_EQ(evaluate(path.curves[1], 0), (Point2{1, 1}));
  for (std::size_t i = 1; i < 3; ++i) {
    const auto a = jet(path.curves[i - 1], 1);
    const auto b = jet(path.curves[i], 0);
    EXPECT_NEAR(curvature(a), curvature(b), 1e-13);
  }
  EXPECT_NEAR(curvature(jet(path.curves[0], 0)), 0, 1e-14);
}

TEST(DxfReader, EllipsesAreRationalQuadratics) {
  const Document d =
      read(drawing("0 ELLIPSE 8 0 10 1 20 1 30 0 11 3 21 0 31 0 40 0.5 41 0 42 6.283185307179586"));
  ASSERT_EQ(d.paths.at(0).path.curves.size(), 4U);
  for (int i = 0; i <= 50; ++i) {
    const Point2 p = evaluate(d.paths[0].path, i / 50.0);
    EXPECT_NEAR(std::pow((p.x - 1) / 3, 2) + std::pow((p.y - 1) / 1.5, 2), 1, 1e-14);
  }
}

TEST(DxfReader, NestedInsertsTurnScaleAndMirror) {
  const std::string blocks =
      "0 SECTION 2 BLOCKS 0 BLOCK 8 0 2 inner 10 1 20 0 0 LINE 8 0 10 1 20 0 11 2 20 0 21 0 0 "
      "ENDBLK "
      "0 BLOCK 8 0 2 outer 10 0 20 0 0 INSERT 8 0 2 inner 10 5 20 0 50 90 41 2 42 2 0 ENDBLK 0 "
      "ENDSEC";
  const Document d = read(drawing("0 INSERT 8 wall 62 1 2 outer 10 100 20 0 41 -1", blocks));
  ASSERT_EQ(d.paths.size(), 1U);
  EXPECT_EQ(d.paths[0].label.layer, "wall");
  EXPECT_EQ(d.paths[0].label.name, "outer/inner");
  // inner: (1,0)-(2,0) less its base, doubled, turned up, at (5,0); then mirrored at x = 0.
  EXPECT_NEAR(distance(evaluate(only(d), 0), Point2{95, 0}), 0, 1e-13);
  EXPECT_NEAR(distance(evaluate(only(d), 1), Point2{95, 2}), 0, 1e-13);
}

TEST(DxfReader, ExtrusionMirrorsAndLiftsIntoSpace) {
  const Document d =
      read(drawing("0 ARC 8 0 10 2 20 0 40 1 50 0 51 90 230 -1 "
                   "0 CIRCLE 8 0 10 0 20 0 30 5 40 1 "
                   "0 CIRCLE 8 0 10 0 20 0 40 1 210 1 220 0 230 0"));
  ASSERT_EQ(d.paths.size(), 1U);
  ASSERT_EQ(d.space_curves.size(), 2U);
  const auto arc = arc_of(only(d));
  EXPECT_NEAR(distance(arc.center, Point2{-2, 0}), 0, 1e-14);
  EXPECT_LT(arc.turn, 0);
  for (int i = 0; i <= 20; ++i) {
    EXPECT_NEAR(evaluate(d.space_curves[0].curve, i / 20.0).z, 5, 1e-14);
    const auto p = evaluate(d.space_curves[1].curve, i / 20.0);
    EXPECT_NEAR(std::hypot(p.x, std::hypot(p.y, p.z) - 1), 0, 1e-14);
  }
}

TEST(DxfReader, UnitsAndColours) {
  const Document d =
      read(drawing("0 LINE 8 a 10 0 20 0 11 1 21 0 0 LINE 8 a 62 5 10 0 20 0 11 1 21 0 "
                   "0 LINE 8 b 420 66051 10 0 20 0 11 1 21 0",
                   "0 SECTION 2 HEADER 9 $INSUNITS 70 6 0 ENDSEC 0 SECTION 2 TABLES 0 LAYER 2 a "
                   "62 -3 0 ENDSEC"));
  EXPECT_EQ(d.unit, "m");
  EXPECT_EQ(d.paths.at(0).label.color, "#00ff00");
  EXPECT_EQ(d.paths.at(1).label.color, "#0000ff");
  EXPECT_EQ(d.paths.at(2).label.color, "#010203");
  EXPECT_EQ(detail::aci_color(30), "#ff7f00");
  EXPECT_EQ(detail::aci_color(0), "");
}

// Groups 1000 behind 1001 hold what the application named there keeps; ours a name.
TEST(DxfReader, NamesAreOursAlone) {
  const std::string line = "0 LINE 8 0 10 0 20 0 11 1 21 0 ";
  const Document d = read(drawing(
      line + "1001 OTHER 1000 theirs " + line + "1001 KEYLINE 1000 roof 1001 OTHER 1000 theirs " +
      line + "1000 nobodys " + line + "1001 OTHER 1000 x 1001 KEYLINE 1000 sill"));
  ASSERT_EQ(d.paths.size(), 4U);
  EXPECT_EQ(d.paths[0].label.name, "");
  EXPECT_EQ(d.paths[1].label.name, "roof");
  EXPECT_EQ(d.paths[2].label.name, "");
  EXPECT_EQ(d.paths[3].label.name, "sill");
}

TEST(DxfReader, SaysWhatItLeavesOut) {
  const Document d =
      read(drawing("0 TEXT 8 0 1 hello 0 TEXT 8 0 1 x 0 CIRCLE 8 0 10 0 20 0 40 -1 "
                   "0 LINE 8 0 67 1 10 0 20 0 11 1 21 0 0 INSERT 2 nowhere 10 0 20 0 "
                   "0 LINE 8 0 10 0 20 0 11 1 21 0"));
  EXPECT_EQ(d.paths.size(), 1U);
  EXPECT_THAT(d.skipped, testing::UnorderedElementsAre(
                             HasSubstr("radius is not positive"), HasSubstr("no block \"nowhere\""),
                             "1 entity in paper space", "TEXT: 2 entities"));
}

TEST(DxfReader, BoundsRecursionAndExplosion) {
  std::string blocks =
      "0 SECTION 2 BLOCKS 0 BLOCK 2 loop 0 INSERT 2 loop 10 0 20 0 0 ENDBLK 0 BLOCK 2 b0 0 LINE 10 "
      "0 20 0 11 1 21 0 0 "
      "ENDBLK";
  for (int i = 1; i <= 12; ++i)
    blocks += " 0 BLOCK 2 b" + std::to_string(i) + " 0 INSERT 2 b" + std::to_string(i - 1) +
              " 10 0 20 0 70 30000 71 30000 0 ENDBLK";
  const Document d =
      read_dxf(drawing("0 INSERT 2 loop 10 0 20 0 0 INSERT 2 b12 10 0 20 0", blocks + " 0 ENDSEC"),
               {.points = 20'000})
          .value();
  EXPECT_LT(d.paths.size(), 20'000U);
  EXPECT_FALSE(d.skipped.empty());
}

TEST(DxfReader, FailsWithThePlace) {
  for (const std::string text : {"", "hello", "0\nSECTION\n2\nENTITIES\nxx\nLINE\n"}) {
    const auto d = read_dxf(text);
    ASSERT_FALSE(d);
    EXPECT_THAT(d.error().path, HasSubstr("line ")) << text;
  }
}

Document sample() {
  Document d;
  d.unit = "mm";
  lac::Chain chain{
      {{1.0 / 3, -2.0 / 7}, 0.1}, {{-1, 20, 0, 0}, {-1, 50, 0, 0.03}, {-1, 20, 0.03, 0.03}}, false};
  d.paths.push_back({{"Dachlinie \u00e4", "body", "#aa1100"}, {{{chain}}, false}, 0});
  curve::BSpline2 spline{
      2, {0, 0, 0, 0.5, 1, 1, 1}, {{0, 0}, {1, 2}, {3, 2}, {4, 0}}, {1, 2, 1, 1}};
  d.paths.push_back({{"sill", "trim", ""}, {{{spline}}, false}, 0});
  d.paths.push_back(
      {{"poly", "trim", ""}, {{{curve::Polyline2{{{0, 0}, {1, 1}, {0.1, 3}}}}}, false}, 0});
  d.space_curves.push_back(
      {{"rail", "wire", ""}, {curve::Polyline3{{{0, 0, 1}, {1, 2, 3}, {2, 2, 2}}}}});
  d.space_curves.push_back(
      {{"bow", "wire", ""}, {curve::Bezier3{{{0, 0, 1}, {1, 2, 3}, {2, 0, 0}}, {1, 0.5, 1}}}});
  return d;
}

TEST(DxfWriter, ReadsBack) {
  const auto written = write_dxf(sample(), {.tolerance = 1e-3});
  ASSERT_TRUE(written) << written.error().message;
  EXPECT_GT(written->deviation, 0);
  EXPECT_LE(written->deviation, 1e-3);
  const Document d = read(written->content);
  EXPECT_EQ(d.unit, "mm");
  EXPECT_TRUE(d.skipped.empty());
  ASSERT_EQ(d.paths.size(), 3U);  // the chain is one spline
  ASSERT_EQ(d.space_curves.size(), 2U);
  EXPECT_EQ(d.paths[0].label, (document::Label{"Dachlinie \u00e4", "body", "#aa1100"}));
  EXPECT_EQ(std::get<curve::BSpline2>(d.paths[1].path.curves[0].value),
            std::get<curve::BSpline2>(sample().paths[1].path.curves[0].value));
  EXPECT_EQ(std::get<curve::Polyline2>(d.paths[2].path.curves[0].value).points[2],
            (Point2{0.1, 3}));
  EXPECT_EQ(d.space_curves[0].label.layer, "wire");
  const auto exact = sample().paths[0].path;
  EXPECT_EQ(evaluate(d.paths[0].path, 0), evaluate(exact, 0));
  EXPECT_NEAR(distance(evaluate(d.paths[0].path, 1), evaluate(exact, 1)), 0, 1e-12);
}

// The side of a bulge is that of the turn: to the right, negative. Values by hand: a quarter circle
// of radius 1 from (0,0), heading along x and turning right, ends at (1,-1); tan(90/4 degrees).
TEST(DxfWriter, RightTurnsHaveNegativeBulges) {
  Document d;
  const lac::Chain chain{{{0, 0}, 0}, {{-1, core::kPi / 2, -1, -1}, {-1, 2, 0, 0}}, false};
  d.paths.push_back({{"a", "", ""}, {{{chain}}, false}, 0});
  const auto written = write_dxf(d, {.tolerance = 1e-3});
  ASSERT_TRUE(written);
  EXPECT_THAT(written->content, HasSubstr("\n42\n-0.41421356"));
  const Document back = read(written->content);
  ASSERT_EQ(back.paths.size(), 1U);
  const Point2 middle = evaluate(back.paths[0].path.curves[0], 0.5);
  EXPECT_NEAR(distance(middle, Point2{std::sqrt(0.5), std::sqrt(0.5) - 1}), 0, 1e-12);
  EXPECT_NEAR(distance(evaluate(back.paths[0].path, 1), Point2{1, -3}), 0, 1e-12);
}

// A mirrored arc runs clockwise: DXF tells it by the angles of its ends in the order of the other
// sense. From (1,0) by 60 degrees to the right around the origin: 300 to 360 degrees.
TEST(DxfWriter, ArcsToTheRightStartWhereTheyEnd) {
  Document d;
  const lac::Chain chain{{{1, 0}, -core::kPi / 2}, {{-1, core::kPi / 3, -1, -1}}, false};
  d.paths.push_back({{"a", "", ""}, {{{chain}}, false}, 0});
  const auto written = write_dxf(d, {.tolerance = 1e-3});
  ASSERT_TRUE(written);
  const Document back = read(written->content);
  ASSERT_EQ(back.paths.size(), 1U);
  const auto arc = arc_of(only(back));
  EXPECT_NEAR(arc.turn, core::kPi / 3, 1e-14);
  EXPECT_NEAR(distance(evaluate(only(back), 0.5),
                       Point2{std::cos(core::kPi / 6), -std::sin(core::kPi / 6)}),
              0, 1e-12);
}

// A partial arc in a mirrored frame (extrusion -z): its angles count from the mirrored axis. By
// hand: centre (2,0) becomes (-2,0), angles 30 to 90 become 150 to 90, at 150 degrees the start.
TEST(DxfReader, MirroredPartialArcsStartWhereTheyShould) {
  const Document d = read(drawing("0 ARC 8 0 10 2 20 0 40 1 50 30 51 90 230 -1"));
  const Point2 start{-2 - std::cos(core::kPi / 6), 0.5};
  EXPECT_NEAR(distance(evaluate(only(d), 0), start), 0, 1e-14);
  EXPECT_NEAR(distance(evaluate(only(d), 1), Point2{-2, 1}), 0, 1e-14);
}

// What AutoCAD draws of a negative bulge: a half turn to the right from (0,0) to (2,0) is above.
TEST(DxfReader, NegativeBulgesTurnRight) {
  const Document d = read(drawing("0 LWPOLYLINE 8 0 90 2 70 0 10 0 20 0 42 -1 10 2 20 0"));
  ASSERT_FALSE(d.paths.empty());
  EXPECT_NEAR(distance(evaluate(d.paths[0].path, 0.5), Point2{1, 1}), 0, 1e-14);
}

TEST(DxfWriter, PolylinesOnRequestKeepArcs) {
  const auto written = write_dxf(sample(), {.tolerance = 1e-3, .polylines = true});
  ASSERT_TRUE(written);
  EXPECT_LE(written->deviation, 1e-3);
  EXPECT_EQ(written->content.find("AcDbArc"), std::string::npos);
  const Document d = read(written->content);
  ASSERT_EQ(d.paths.size(), 3U);
  const auto exact = sample().paths[0].path;
  const auto& last = d.paths[0].path.curves.back();
  EXPECT_TRUE(document::as_arc(std::get<curve::Bezier2>(last.value)));
  EXPECT_NEAR(distance(evaluate(last, 1), evaluate(exact, 1)), 0, 1e-12);
}

/// The ASCII file as a binary one of R13 and later.
std::string binary(const std::string& text) {
  std::string bytes("AutoCAD Binary DXF\r\n\x1a\0", 22);
  std::istringstream lines(text);
  for (std::string code, value; std::getline(lines, code) && std::getline(lines, value);) {
    const int c = std::stoi(code);
    bytes += static_cast<char>(c & 255);
    bytes += static_cast<char>(c >> 8);
    const bool real = (c >= 10 && c < 60) || (c >= 210 && c < 240);
    const bool small = c >= 60 && c < 80;
    if (real) {
      const double v = std::stod(value);
      bytes.append(reinterpret_cast<const char*>(&v), 8);
    } else if (small || c == 281) {
      const short v = static_cast<short>(std::stoi(value));
      bytes.append(reinterpret_cast<const char*>(&v), 2);
    } else if ((c >= 90 && c < 100) || c == 420) {
      const int v = std::stoi(value);
      bytes.append(reinterpret_cast<const char*>(&v), 4);
    } else {
      bytes += value;
      bytes += '\0';
    }
  }
  return bytes;
}

TEST(DxfReader, BinaryFilesHoldTheSame) {
  const std::string text = write_dxf(sample(), {.tolerance = 1e-3})->content;
  const auto a = format_document(read(text), ".json");
  const auto b = format_document(read(binary(text)), ".json");
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->content, b->content);
}

struct FileCase {
  const char* name;
  std::size_t paths;
  std::size_t space_curves;
};

// Counts by hand: groups 0 of the entities section (and of blocks as often as they are inserted).
constexpr FileCase kFiles[] = {
    {"dxf/librecad_aw21_15splines.dxf", 15 + 2 + 8, 0},
    {"dxf/librecad_kin39.dxf", 2 + 6, 0},
    {"dxf/ezdxf_hatches_2.dxf", 4 + 1 + 1 + 1, 0},
    {"dxf/ezdxf_usa_polylines.dxf", 59, 0},
    {"nasty/dxf/R12_with_trash_beyond_EOF.dxf", 1, 0},
    {"nasty/dxf/empty_handles.dxf", 8, 0},
    {"nasty/dxf/no_layouts.dxf", 2, 0},
    {"nasty/dxf/Leica_Disto_S910.dxf", 0, 10},
    {"nasty/dxf/issue1106.dxf", 5 + 3 + 2, 0},
    {"nasty/dxf/recover01.dxf", 1441 - 18, 0},  // 18 lines without extent
    {"nasty/dxf/POLI-ALL210_12.DXF", 0, 30},    // at their own heights
};

TEST(DxfReader, ReadsTheSharedFiles) {
  const std::filesystem::path folder = KEYLINE_SHARED_DATA "/4_cad";
  KEYLINE_NEEDS_SHARED_DATA(std::filesystem::exists(folder), folder);
  for (const FileCase& c : kFiles) {
    SCOPED_TRACE(c.name);
    const auto d = read_document(folder / c.name);
    ASSERT_TRUE(d) << d.error().message;
    EXPECT_EQ(d->paths.size(), c.paths);
    EXPECT_EQ(d->space_curves.size(), c.space_curves);
    const auto again = format_document(*d, ".dxf");
    ASSERT_TRUE(again) << again.error().message;
    const auto back = read_dxf(again->content);
    ASSERT_TRUE(back);
    EXPECT_NEAR(extent(*back), extent(*d), 1e-9 * extent(*d));
  }
  const auto none = read_document(folder / "nasty/dxf/circle_radius_le_0.dxf");
  ASSERT_FALSE(none);
  EXPECT_THAT(none.error().message, HasSubstr("radius"));
}

TEST(DxfWriter, OlderReadersFindUnitAndColour) {
  document::Document d;
  d.unit = "mm";
  d.paths.push_back({{"", "", "#fe0101"}, {{{curve::Bezier2{{{0, 0}, {1, 2}}, {}}}}, false}, 0});
  const auto metric = write_dxf(d, {.tolerance = 1e-3});
  ASSERT_TRUE(metric);
  EXPECT_THAT(metric->content, testing::HasSubstr("$MEASUREMENT\n70\n1\n"));
  EXPECT_THAT(metric->content, testing::HasSubstr("\n62\n1\n420\n"));
  d.unit = "in";
  EXPECT_THAT(write_dxf(d, {.tolerance = 1e-3})->content,
              testing::HasSubstr("$MEASUREMENT\n70\n0\n"));
}

}  // namespace
}  // namespace keyline::exchange
