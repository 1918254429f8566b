#include <cmath>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "keyline/core/angle.h"
#include "keyline/document/arc.h"
#include "keyline/exchange/dxf/dxf_reader.h"
#include "keyline/exchange/dxf/dxf_writer.h"

namespace keyline::exchange {
namespace {

using document::Document;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Groups parted by blanks as a drawing's entities, behind a header.
Document read(const std::string& entities, const std::string& before = {}) {
  std::istringstream words(before + " 0 SECTION 2 ENTITIES " + entities + " 0 ENDSEC 0 EOF");
  std::string text;
  for (std::string word; words >> word;) text += word + "\n";
  const auto document = read_dxf(text);
  EXPECT_TRUE(document) << document.error().message << ' ' << document.error().path;
  return document.value_or(Document{});
}

/// Degrees of the only arc's start and turn.
std::pair<double, double> arc_of(const std::string& from, const std::string& to) {
  const Document d = read("0 ARC 8 0 10 0 20 0 40 1 50 " + from + " 51 " + to);
  const auto& chain = std::get<lac::Chain>(d.paths.at(0).path.curves.at(0).value);
  const auto arc = document::as_arc(lac::segment_at(chain, 0)).value_or(document::Arc{});
  return {arc.start * 180 / core::kPi, arc.turn * 180 / core::kPi};
}

// dxflib 2.0 ends the section before most of its variables.
TEST(DxfGaps, TheUnitMayStandBehindItsSection) {
  EXPECT_EQ(read("0 LINE 8 0 10 0 20 0 11 1 21 0",
                 "0 SECTION 2 HEADER 9 $ACADVER 1 AC1015 0 ENDSEC 9 $INSUNITS 70 4")
                .unit,
            "mm");
}

TEST(DxfGaps, AUnitGivenTwiceIsTold) {
  const auto with = [](const std::string& unit) {
    return read("0 LINE 8 0 10 0 20 0 11 1 21 0",
                "0 SECTION 2 HEADER 9 $INSUNITS 70 4 9 $INSUNITS 70 " + unit + " 0 ENDSEC");
  };
  EXPECT_THAT(with("4").skipped, IsEmpty());
  EXPECT_EQ(with("1").unit, "in");
  EXPECT_THAT(
      with("1").skipped,
      ElementsAre("an earlier unit of the drawing: $INSUNITS has another value at line 12"));
}

// An insert shows one of them: which is not the drawing's to say.
TEST(DxfGaps, BlocksOfOneNameAreTold) {
  const auto block = [](const std::string& name, const std::string& end) {
    return " 0 BLOCK 2 " + name + " 10 0 20 0 0 LINE 8 0 10 0 20 0 11 " + end + " 21 0 0 ENDBLK";
  };
  const auto with = [&](const std::string& second) {
    return read("0 INSERT 8 0 2 a 10 0 20 0",
                "0 SECTION 2 BLOCKS" + block("a", "1") + block(second, "5") + " 0 ENDSEC");
  };
  EXPECT_THAT(with("b").skipped, ElementsAre(HasSubstr("nothing inserts: b")));
  EXPECT_THAT(with("a").skipped,
              ElementsAre("line 28: BLOCK: an earlier block of its name, \"a\""));
}

TEST(DxfGaps, APolylineThatDoesNotEndIsTold) {
  const std::string polyline = "0 POLYLINE 8 0 66 1 0 VERTEX 8 0 10 0 20 0 0 VERTEX 8 0 10 1 20 0 ";
  const std::string line = "0 LINE 8 0 10 0 20 0 11 1 21 0";
  EXPECT_THAT(read(polyline + "0 SEQEND 8 0 " + line).skipped, IsEmpty());
  for (const std::string& behind : {line, polyline + "0 SEQEND"})
    EXPECT_THAT(read(polyline + behind).skipped,
                ElementsAre("line 6: POLYLINE: it has no SEQEND, maybe not all its vertices"));
}

// An arc turns counterclockwise from one angle to the other, at most once around, however the
// angles are counted.
TEST(DxfArc, TurnsAtMostOnceAround) {
  struct Case {
    const char* from;
    const char* to;
    double turn;
  };
  for (const Case& c : {Case{"350", "20", 30},
                        {"-272", "238", 150},
                        {"20", "-20", 320},
                        {"-10", "350", 360},
                        {"0", "360", 360},
                        {"-400", "400", 80},
                        {"90", "90", 360},
                        {"10", "9", 359},
                        {"10", "10.0001", 0.0001},     // a short arc
                        {"10", "10.0000000001", 360},  // rounding of a whole one
                        {"10", "9.9999999999", 360},
                        {"-350", "340", 330}}) {
    const auto [start, turn] = arc_of(c.from, c.to);
    EXPECT_NEAR(turn, c.turn, 1e-12) << c.from << ' ' << c.to;
    EXPECT_NEAR(std::remainder(start - std::stod(c.from), 360), 0, 1e-12) << c.from;
  }
}

TEST(DxfEllipse, TurnsAtMostOnceAround) {
  const auto ends = [](const std::string& from, const std::string& to) {
    const Document d = read("0 ELLIPSE 8 0 10 0 20 0 11 2 21 0 40 0.5 41 " + from + " 42 " + to);
    const auto& path = d.paths.at(0).path;
    return std::pair{path.curves.size(), path.closed};
  };
  EXPECT_EQ(ends("-6", "6"), (std::pair{std::size_t{4}, false}));  // 12 - 2 pi: 5.72
  EXPECT_EQ(ends("-5", "5"), (std::pair{std::size_t{3}, false}));  // 10 - 2 pi: 3.72
  EXPECT_EQ(ends("0", "6.2831853072"), (std::pair{std::size_t{4}, true}));
  EXPECT_EQ(ends("1", "7.283185307"), (std::pair{std::size_t{4}, true}));
  EXPECT_EQ(ends("6", "1"), (std::pair{std::size_t{1}, false}));
}

// A spline that counts more than it has was cut short: what is left of it is another curve.
TEST(DxfReader, SplinesOfFewerPointsThanTheyCountAreSaid) {
  const std::string cubic =
      "70 8 71 3 40 0 40 0 40 0 40 0 40 1 40 1 40 1 40 1 "
      "10 0 20 0 10 1 20 2 10 3 20 2 10 4 20 0";
  for (const char* sound : {"72 8 73 4 ", "73 4 ", "", "72 0 73 0 "})
    EXPECT_THAT(read("0 SPLINE 8 0 " + (sound + cubic)).skipped, IsEmpty()) << sound;
  const auto why = [&](const char* counts) {
    const Document d = read("0 SPLINE 8 0 " + (counts + cubic));
    EXPECT_EQ(d.paths.size(), 0U) << counts;
    return d.skipped.at(0);
  };
  EXPECT_THAT(why("72 9 73 5 "), HasSubstr("only 4 of its 5 control points are there"));
  EXPECT_THAT(why("72 10 73 4 "), HasSubstr("only 8 of its 10 knots are there"));
}

// What is not there is no 0.
TEST(DxfReader, MissingCoordinatesAreSaid) {
  const std::string line = "0 LINE 8 0 10 1 20 2 11 3 21 4 ";
  for (const auto& [entity, group] :
       {std::pair{"0 LINE 8 0 10 1 20 2 11 3", 21},
        {"0 LINE 8 0 20 2 11 3 21 4", 10},
        {"0 CIRCLE 8 0 10 1 20 2", 40},
        {"0 ARC 8 0 10 1 20 2 40 3 50 10", 51},
        {"0 ELLIPSE 8 0 10 1 20 2 11 3 40 0.5", 21},
        {"0 LWPOLYLINE 8 0 90 3 70 0 10 1 20 2 10 3 10 5 20 6", 20},
        {"0 POLYLINE 8 0 66 1 70 0 0 VERTEX 8 0 10 1 20 2 0 VERTEX 8 0 10 3 0 SEQEND", 20},
        {"0 SPLINE 8 0 70 8 71 1 40 0 40 0 40 1 40 1 10 0 20 0 10 5", 20},
        {"0 SPLINE 8 0 70 8 71 3 11 0 21 0 11 5 11 6 21 1", 21},
        {"0 LINE 8 0 10 1 20 2 30 5 11 3 21 4", 31},
        {"0 LINE 8 0 10 1 20 2 11 3 21 4 31 5", 30},
        {"0 SPLINE 8 0 70 8 71 1 40 0 40 0 40 1 40 1 10 0 20 0 30 7 10 5 20 5", 30},
        {"0 SPLINE 8 0 70 8 71 3 11 0 21 0 31 7 11 5 21 5 11 6 21 1 31 7", 31}}) {
    const Document d = read(line + entity);
    EXPECT_EQ(d.paths.size() + d.space_curves.size(), 1U) << entity;
    EXPECT_THAT(d.skipped, ElementsAre(HasSubstr("group " + std::to_string(group) + " is missing")))
        << entity;
  }
  EXPECT_TRUE(read(line).skipped.empty());
}

// Of two values of what an entity has one of, neither is known to be meant.
TEST(DxfReader, GroupsWithTwoValuesAreSaid) {
  const std::string line = "0 LINE 8 0 10 1 20 2 11 3 21 4 ";
  for (const auto& [entity, group] :
       {std::pair{"0 LINE 8 0 10 1 20 2 11 3 21 4 11 5", 11},
        {"0 CIRCLE 8 0 10 1 20 2 40 3 40 4", 40},
        {"0 ARC 8 0 10 1 20 2 40 3 50 10 50 20 51 90", 50},
        {"0 ELLIPSE 8 0 10 1 20 2 11 3 21 0 40 0.5 42 3 42 4", 42},
        {"0 INSERT 8 0 2 none 10 1 20 2 20 3", 20},
        {"0 LWPOLYLINE 8 0 90 2 70 0 70 1 10 1 20 2 10 3 20 0", 70},
        {"0 POLYLINE 8 0 66 1 70 0 0 VERTEX 8 0 10 1 20 2 0 VERTEX 8 0 10 3 20 1 10 4 0 SEQEND",
         10},
        {"0 SPLINE 8 0 70 8 71 1 71 2 40 0 40 0 40 1 40 1 10 0 20 0 10 5 20 5", 71}}) {
    const Document d = read(line + entity);
    EXPECT_EQ(d.paths.size() + d.space_curves.size(), 1U) << entity;
    EXPECT_THAT(d.skipped, ElementsAre(HasSubstr("group " + std::to_string(group) + " has two")))
        << entity;
  }
  const Document same = read("0 LINE 8 0 10 1 20 2 11 3 11 3.0 21 4");
  EXPECT_EQ(same.paths.size(), 1U);
  EXPECT_TRUE(same.skipped.empty());
}

// The flag makes no curve closed: one whose ends lie apart would get an edge that nobody drew.
TEST(DxfReader, SplinesAreClosedWhereTheirEndsMeet) {
  const auto spline = [](const std::string& knots, const std::string& points) {
    return read("0 SPLINE 8 0 70 9 71 3 " + knots + points);
  };
  const std::string ends = "40 0 40 0 40 0 40 0 40 1 40 1 40 1 40 1 ";
  const Document apart = spline(ends, "10 0 20 0 10 1 20 5 10 5 20 5 10 6 20 0");
  EXPECT_FALSE(apart.paths.at(0).path.closed);
  EXPECT_THAT(apart.skipped,
              ElementsAre("nothing, but open: 1 spline said to be closed whose ends lie apart"));
  // 1e-5 of its size, as paths of other files
  const Document near = spline(ends, "10 0 20 0 10 1 20 5 10 5 20 5 10 0.00001 20 0");
  EXPECT_TRUE(near.paths.at(0).path.closed);
  EXPECT_THAT(near.skipped, IsEmpty());
  // The last three points are the first: its ends meet, but not in a control point.
  const Document around = spline("40 0 40 1 40 2 40 3 40 4 40 5 40 6 40 7 40 8 40 9 40 10 ",
                                 "10 0 20 0 10 1 20 0 10 1 20 1 10 0 20 1 10 0 20 0 10 1 20 0 "
                                 "10 1 20 1");
  EXPECT_TRUE(around.paths.at(0).path.closed);
  EXPECT_THAT(around.skipped, IsEmpty());
}

TEST(DxfReader, FitPointsThatAreAnnouncedHaveToBeThere) {
  const Document d =
      read("0 LINE 8 0 10 1 20 2 11 3 21 4 0 SPLINE 8 0 70 8 71 3 74 3 11 0 21 0 11 5 21 1");
  EXPECT_THAT(d.skipped, ElementsAre(HasSubstr("only 2 of its 3 fit points are there")));
}

// Every number a curve is made of, by the groups that the DXF reference gives the entity.
TEST(DxfReader, NoUnreadableNumberIsLetPass) {
  struct Case {
    const char* entity;
    std::vector<int> groups;
  };
  const std::vector<int> across{210, 220, 230};
  for (const auto& [entity, groups] :
       {Case{"0 LINE 8 0 10 1 20 2 30 0 11 3 21 4 31 0", {10, 20, 30, 11, 21, 31}},
        {"0 CIRCLE 8 0 10 1 20 2 30 0 40 3", {10, 20, 30, 40}},
        {"0 ARC 8 0 10 1 20 2 40 3 50 10 51 20", {10, 20, 40, 50, 51}},
        {"0 ELLIPSE 8 0 10 1 20 2 11 3 21 0 31 0 40 0.5 41 0 42 1", {11, 21, 31, 40, 41, 42}},
        {"0 LWPOLYLINE 8 0 90 2 70 0 38 5 10 1 20 2 42 1 10 3 20 4", {90, 70, 38, 10, 20, 42}},
        {"0 SPLINE 8 0 70 8 71 1 72 4 73 2 40 0 40 0 40 1 40 1 10 0 20 0 30 0 10 1 20 1 30 0",
         {70, 71, 72, 73, 40, 10, 20, 30}},
        {"0 SPLINE 8 0 70 8 71 3 74 2 11 0 21 0 31 0 11 1 21 1 31 0", {71, 74, 11, 21, 31}}}) {
    EXPECT_THAT(read(entity).skipped.size(), testing::Le(1U)) << entity;
    for (const auto& codes : {groups, across})
      for (const int code : codes) {
        const Document d = read(std::string(entity) + ' ' + std::to_string(code) + " abc");
        EXPECT_EQ(d.paths.size() + d.space_curves.size(), 0U) << entity << ' ' << code;
        EXPECT_THAT(d.skipped, ElementsAre(HasSubstr("\"abc\""))) << entity << ' ' << code;
      }
  }
}

// What no curve is made of is let pass, but told.
TEST(DxfReader, UnreadableFlagsAndThicknessAreTold) {
  const std::string line = "0 LINE 8 0 10 1 20 2 11 3 21 4 ";
  EXPECT_THAT(read(line + "60 abc").skipped,
              ElementsAre("the visibility of 1 entity, which is no number"));
  EXPECT_THAT(read(line + "39 abc").skipped, ElementsAre("the thickness of 1 entity"));
  for (const char* group : {"62", "420"})
    EXPECT_THAT(read(line + group + " abc").skipped,
                ElementsAre(HasSubstr("a colour that is no number")));
  EXPECT_THAT(
      read(line, "0 SECTION 2 TABLES 0 TABLE 2 LAYER 0 LAYER 2 0 70 abc 0 ENDTAB 0 ENDSEC").skipped,
      ElementsAre("the visibility of 1 layer, which is no number"));
}

// A degree of 99999999999 had become 3, a flag of 1.5 a closed curve.
TEST(DxfReader, CountsAndFlagsAreWholeNumbers) {
  for (const char* flag : {"1.5", "99999999999", "1e30"}) {
    const Document d =
        read(std::string("0 LINE 8 0 10 1 20 2 11 3 21 4 0 LWPOLYLINE 8 0 90 2 70 ") + flag +
             " 10 0 20 0 10 1 20 1");
    EXPECT_THAT(d.skipped, ElementsAre(HasSubstr("is no number"))) << flag;
  }
}

TEST(DxfReader, LettersOfOtherCodePagesAreSaid) {
  const auto header = [](const std::string& page) {
    return "0 SECTION 2 HEADER 9 $DWGCODEPAGE 3 " + page + " 0 ENDSEC";
  };
  const std::string line = "0 LINE 8 K\xee\xed 10 1 20 2 11 3 21 4 ";
  EXPECT_THAT(read(line + line, header("ANSI_1251")).skipped,
              ElementsAre(HasSubstr("which are in ANSI_1251")));
  EXPECT_TRUE(read(line, header("ANSI_1252")).skipped.empty());
  EXPECT_TRUE(read("0 LINE 8 Kon 10 1 20 2 11 3 21 4", header("ANSI_1251")).skipped.empty());
  EXPECT_EQ(read("0 LINE 8 \x80\xe4 10 1 20 2 11 3 21 4").paths.at(0).label.layer, "\u20ac\u00e4");
}

// Curves do not show it, or show what the drawing does not.
TEST(DxfReader, WhatCurvesDoNotTellIsSaid) {
  const std::string layers =
      "0 SECTION 2 TABLES 0 TABLE 2 LAYER 0 LAYER 2 off 62 -3 0 LAYER 2 ice 70 1 62 5 0 LAYER 2 on "
      "62 1 0 ENDTAB 0 ENDSEC";
  const auto said = [&](const std::string& entity) { return read(entity, layers).skipped; };
  const std::string line = "0 LINE 10 0 20 0 11 1 21 0 ";
  EXPECT_THAT(said(line + "8 on 60 0 39 0"), testing::IsEmpty());
  EXPECT_THAT(said(line + "8 off " + line + "8 off"), ElementsAre(HasSubstr("layer off")));
  EXPECT_THAT(said(line + "8 off " + line + "8 off"), ElementsAre(HasSubstr("2 entities")));
  EXPECT_THAT(said(line + "8 ice"), ElementsAre(HasSubstr("layer ice")));
  EXPECT_THAT(said(line + "8 on 60 1"), ElementsAre(HasSubstr("not to be seen: 1 entity")));
  EXPECT_THAT(said(line + "8 on 39 2"), ElementsAre("the thickness of 1 entity"));
  const std::string two = "0 LWPOLYLINE 8 on 90 2 70 0 10 0 20 0 10 2 20 0 ";
  EXPECT_THAT(said(two + "43 0.0"), testing::IsEmpty());
  EXPECT_THAT(said(two + "43 0.5"), ElementsAre("the width of 1 polyline"));
  EXPECT_THAT(said(two + "41 0.5"), ElementsAre("the width of 1 polyline"));
  EXPECT_THAT(
      said("0 POLYLINE 8 on 66 1 70 0 0 VERTEX 10 0 20 0 40 0.1 0 VERTEX 10 1 20 0 0 SEQEND"),
      ElementsAre("the width of 1 polyline"));
  EXPECT_THAT(said("0 SPLINE 8 on 70 8 71 3 74 3 11 0 21 0 11 1 21 1 11 2 21 0"),
              ElementsAre(HasSubstr("1 spline without control points")));
}

// As some programs pad their lines.
TEST(DxfReader, BlanksBehindTypesCountForNothing) {
  const auto document = read_dxf(
      "0\nSECTION \n2\nENTITIES\n0\n LINE  \n8\n0\n10\n0\n20\n0\n11\n1"
      "\n21\n0\n0\nENDSEC \n0\nEOF \n");
  ASSERT_TRUE(document) << document.error().message;
  EXPECT_EQ(document->paths.size(), 1U);
  EXPECT_THAT(document->skipped, testing::IsEmpty());
}

// The end of a closed curve that misses its start is put there, and that is how far off it is.
TEST(DxfWriter, ClosingUpIsToldAsDeviation) {
  Document d;
  d.unit = "mm";
  d.paths.push_back(
      {{"a", "", ""}, {{{curve::Bezier2{{{0, 0}, {10, 0}, {0, 10}, {3e-6, 4e-6}}, {}}}}, true}, 0});
  const auto written = write_dxf(d, {});
  ASSERT_TRUE(written) << written.error().message;
  EXPECT_DOUBLE_EQ(written->deviation, 5e-6);
  const auto back = read_dxf(written->content);
  ASSERT_TRUE(back);
  EXPECT_TRUE(back->paths.at(0).path.closed);
}

// A uniform cubic starts at (P0 + 4 P1 + P2) / 6: its first and last control point say nothing of
// its ends. Where the last three are the first it is closed.
TEST(DxfWriter, SplinesAreClosedByTheirEndsNotByTheirControlPoints) {
  const std::vector<core::Point2> around = {{0, 0}, {4, 0}, {6, 3}, {2, 6}, {0, 0}, {4, 0}, {6, 3}};
  const std::vector<core::Point2> open = {{0, 0}, {4, 0}, {6, 3}, {2, 6}, {-3, 4}, {1, 1}, {0, 0}};
  for (const auto& [points, closed] : {std::pair{around, true}, {open, false}})
    for (const double step : {1.0, 0.1}) {  // tenths: ends meet but for rounding
      SCOPED_TRACE(closed ? "around" : "open");
      std::vector<double> knots;
      for (int i = 0; i < 11; ++i) knots.push_back(i * step);
      const curve::BSpline2 flat{3, knots, points, {}};
      curve::BSpline3 space{3, knots, {}, {}};
      for (const core::Point2 p : flat.control) space.control.push_back({p.x, p.y, p.x * p.y + 1});
      Document d;
      d.unit = "mm";
      d.paths.push_back({{"a", "", ""}, {{{flat}}, closed}, 0});
      d.space_curves.push_back({{"b", "", ""}, {space}});
      const auto written = write_dxf(d, {});
      ASSERT_TRUE(written) << written.error().message;
      EXPECT_THAT(written->content, HasSubstr(closed ? "\n70\n9\n71\n3" : "\n70\n8\n71\n3"));
      EXPECT_THAT(written->content, HasSubstr(closed ? "\n70\n1\n71\n3" : "\n70\n0\n71\n3"));
      const auto back = read_dxf(written->content);
      ASSERT_TRUE(back) << back.error().message;
      EXPECT_THAT(back->skipped, IsEmpty());
      EXPECT_EQ(back->paths.at(0).path.closed, closed);
    }
}

}  // namespace
}  // namespace keyline::exchange
