#include "keyline/exchange/document_file.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "keyline/exchange/json/json_document.h"
#include "keyline/exchange/json/json_text.h"
#include "keyline/exchange/svg/svg_document.h"
#include "keyline/exchange/svg/svg_reader.h"

namespace keyline::exchange {
namespace {

namespace fs = std::filesystem;
using document::Document;
using testing::HasSubstr;

/// A folder that goes with the test.
class Files : public testing::Test {
 protected:
  Files() : folder_(fs::temp_directory_path() / ("keyline-" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
  }
  ~Files() override { fs::remove_all(folder_); }
  fs::path file(const std::string& name, const std::string& content = {}) {
    if (!content.empty()) std::ofstream(folder_ / name, std::ios::binary) << content;
    return folder_ / name;
  }

 private:
  fs::path folder_;
};

/// A chain with irrational numbers, an arc, a spline and a rail in space.
Document mixed() {
  Document d;
  d.unit = "mm";
  lac::Chain chain{{{1.0 / 3, -2.0 / 7}, 0.1}, {{-1, 50, 0, 0.03}, {1.5, 20, 0.03, 0.1}}, false};
  d.paths.push_back({{"roof", "body", "#aa1100"}, {{{chain}}, false}, 0.25});
  d.paths.push_back({{"arc", "body", ""},
                     {{{curve::Bezier2{{{1, 0}, {1, 1}, {0, 1}}, {1, std::sqrt(0.5), 1}}}}, false},
                     0});
  curve::BSpline2 spline{2, {0, 0, 0, 0.5, 1, 1, 1}, {{0, 0}, {1, 2}, {3, 2}, {4, 0}}, {}};
  d.paths.push_back({{"sill", "", ""}, {{{spline}}, false}, 0});
  d.space_curves.push_back({{"rail", "", ""}, {curve::Polyline3{{{0, 0, 1}, {1, 2, 3}}}}});
  surface::BezierSurface patch{{2, 2, {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 1.0 / 3}}}, {}};
  d.surfaces.push_back({{"hood", "skin", ""}, patch, 4});
  return d;
}

/// Polylines alone, on a path and in space, under names that read like the text around them.
Document polylines() {
  Document d;
  const curve::Polyline2 line{{{0, 0}, {1.0 / 3, -1e-7}, {1e20, 5}}};
  d.paths.push_back({{"\"points\": []", "\"points\":[]", ""}, {{{line}}, false}, 0});
  d.paths.push_back(
      {{"", "", ""}, {{{line}, {curve::Bezier2{{{1e20, 5}, {1, 2}}, {}}}, {line}}, true}, 0.5});
  d.space_curves.push_back({{"rail", "", ""}, {curve::Polyline3{{{0, 0, 1}, {1, 2, 3}}}}});
  return d;
}

TEST(JsonDocument, ItsTextIsThatOfItsTree) {
  Document alone = polylines();
  alone.paths.resize(1);
  alone.paths[0].label.layer.clear();
  alone.space_curves.clear();
  alone.unit = "mm";
  Document in_space = polylines();
  in_space.paths.clear();
  for (const Document& d : {polylines(), alone, in_space, mixed(), Document{}})
    for (const int indent : {-1, 0, 1, 4}) EXPECT_EQ(json_text(d, indent), to_json(d).dump(indent));
  nlohmann::json more = to_json(alone);
  more["drawing"] = "7";
  EXPECT_EQ(json_text(alone, -1, {{"drawing", "7"}}), more.dump());
}

TEST(JsonDocument, ReadsBackTheSame) {
  const Document d = mixed();
  const std::string text = to_json(d).dump();
  const auto read = read_json(text);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(to_json(*read).dump(), text);
  EXPECT_EQ(read->paths[0].label, d.paths[0].label);
  EXPECT_EQ(std::get<lac::Chain>(read->paths[0].path.curves[0].value),
            std::get<lac::Chain>(d.paths[0].path.curves[0].value));
  EXPECT_EQ(read->paths[0].stroke_width, 0.25);
  EXPECT_EQ(read->space_curves.size(), 1U);
}

TEST(JsonDocument, OneCurveIsItsValue) {
  Document d;
  d.unit = "m";
  d.paths.push_back(mixed().paths[0]);
  d.paths[0].label = {"roof", "", ""};
  d.paths[0].stroke_width = 0;
  const auto j = to_json(d);
  EXPECT_EQ(j["type"], "log-aesthetic");
  const auto read = document_from_json(j);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->unit, "m");
  EXPECT_EQ(read->paths[0].label.name, "roof");
}

TEST(JsonDocument, OneSurfaceIsItsValue) {
  Document d;
  d.surfaces.push_back(mixed().surfaces[0]);
  d.surfaces[0].trims = 0;
  d.surfaces[0].label.layer.clear();
  const auto j = to_json(d);
  EXPECT_EQ(j["type"], "bezier-surface");
  EXPECT_FALSE(j.contains("trims"));
  const auto read = document_from_json(j);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->surfaces[0].label.name, "hood");
  EXPECT_EQ(read->surfaces[0].surface, d.surfaces[0].surface);
}

TEST(JsonDocument, KeepsTheNumberOfTrims) {
  for (const int trims : {1, 2, 4}) {
    Document d;
    d.surfaces.push_back(mixed().surfaces[0]);
    d.surfaces[0].trims = trims;
    const auto j = to_json(d);
    EXPECT_EQ(j["surfaces"][0]["trims"], trims);
    const auto read = document_from_json(j);
    ASSERT_TRUE(read);
    EXPECT_EQ(read->surfaces[0].trims, trims);
    const auto from_text = read_json(json_text(d, 2));
    ASSERT_TRUE(from_text);
    EXPECT_EQ(from_text->surfaces[0].trims, trims);
  }
}

TEST(JsonDocument, NamesThePlaceOfAMistake) {
  const auto bad =
      read_json(R"({"curves":[{"curve":{"type":"bezier","points":[[0,0],[1,"x"]]}}]})");
  ASSERT_FALSE(bad);
  EXPECT_EQ(bad.error().path, "curves[0].curve.points[1][1]");
  const auto cut = read_json("{\n\"curves\":[\n{");
  ASSERT_FALSE(cut);
  EXPECT_EQ(cut.error().path, "line 3");
  EXPECT_FALSE(read_json("1e999"));
}

TEST(JsonDocument, RefusesDeepNesting) {
  const auto refused = read_json("{\n\"a\": " + std::string(100'000, '['));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().path, "line 2");
  // Two hundred lists or objects in each other are read, whatever stands beside them; no more.
  const auto nested = [](int depth, const std::string& open, const std::string& close) {
    std::string text;
    for (int i = 0; i < depth; ++i) text += open;
    text += "1";
    for (int i = 0; i < depth; ++i) text += close;
    return parse_json(text).has_value();
  };
  for (const auto& [open, close] : {std::pair{"[1, 2, ", "]"},
                                    {"[", ", {}, 3]"},
                                    {"{\"a\": \"}\", \"b\": ", "}"},
                                    {"{\"a\": ", ", \"b\": []}"}}) {
    EXPECT_TRUE(nested(199, open, close)) << open;
    EXPECT_TRUE(nested(200, "[", "]"));
    EXPECT_FALSE(nested(202, open, close)) << open;
  }
  EXPECT_FALSE(nested(201, "[", "]"));
  // Brackets within strings do not count.
  const auto wrong = read_json("{\"type\": \"\\\"" + std::string(1000, '[') + "\"}");
  ASSERT_FALSE(wrong);
  EXPECT_EQ(wrong.error().message.find("nested"), std::string::npos);
}

TEST(SvgDocument, ReadsBackTheExactCurves) {
  const Document d = mixed();
  const auto svg = write_svg_document(d, 0.001);
  ASSERT_TRUE(svg) << svg.error().message;
  EXPECT_GT(svg->deviation, 0);
  EXPECT_LE(svg->deviation, 0.001);
  ASSERT_EQ(svg->notes.size(), 2U);
  EXPECT_THAT(svg->notes[0], HasSubstr("1 space curve is not"));
  const auto read = read_svg_document(svg->content);
  ASSERT_TRUE(read);
  EXPECT_EQ(to_json(*read).dump(), to_json(d).dump());
}

TEST(SvgDocument, HoldsLayersColoursAndWidths) {
  const auto svg = write_svg_document(mixed(), 0.001);
  ASSERT_TRUE(svg);
  const auto read = read_svg(svg->content);
  ASSERT_TRUE(read);
  ASSERT_EQ(read->curves.size(), 3U);
  EXPECT_EQ(read->curves[0].layer, "body");
  EXPECT_EQ(read->curves[1].layer, "body");
  EXPECT_EQ(read->curves[2].layer, "sill");
  EXPECT_THAT(svg->content, HasSubstr("stroke=\"#aa1100\""));
  EXPECT_THAT(svg->content, HasSubstr("stroke-width=\"0.25\""));
}

TEST(SvgDocument, KeepsThePageOfADrawing) {
  const auto given = read_svg_document(
      "<svg xmlns='http://www.w3.org/2000/svg' width='80mm' height='60mm' viewBox='10 20 160 120'>"
      "<path d='M30 40C50 40 60 60 90 70' stroke='#112233'/></svg>");
  ASSERT_TRUE(given);
  const auto written = write_svg_document(*given, 0.001);
  ASSERT_TRUE(written);
  EXPECT_THAT(written->content, HasSubstr("width=\"80mm\" height=\"60mm\" viewBox=\"5 10 80 60\""));
  const auto again = read_svg_document(written->content);
  ASSERT_TRUE(again && again->page);
  EXPECT_EQ(again->page->low, given->page->low);
  EXPECT_EQ(again->page->high, given->page->high);
}

TEST(SvgDocument, AChangedDrawingCounts) {
  std::string text = write_svg_document(mixed(), 0.001)->content;
  const std::size_t at = text.find("<g id=\"layer1\"");
  ASSERT_NE(at, std::string::npos);
  text.insert(at + 2, " transform=\"translate(5 0)\"");
  const auto read = read_svg_document(text);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->paths.size(), 3U);
  EXPECT_TRUE(std::holds_alternative<curve::Bezier2>(read->paths[0].path.curves[0].value));
  EXPECT_THAT(read->skipped.back(), HasSubstr("changed"));
}

TEST_F(Files, OfPenStrokesAreLinesUpright) {
  const auto read = read_document(file(
      "a.scap", "#80 60\n@2.5\n{\n\t#7\t3\n\t@9\n\t1 2\t0\n\t3 4\t9\n}\n{\n#8 3\n5 6\n}\n{\n}\n"));
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_TRUE(read->space_curves.empty());  // the third column is no place
  ASSERT_EQ(read->paths.size(), 1U);
  EXPECT_EQ(read->paths[0].label.name, "7");
  EXPECT_EQ(read->paths[0].label.layer, "3");
  EXPECT_EQ(read->paths[0].stroke_width, 2.5);
  const auto& line = std::get<curve::Polyline2>(read->paths[0].path.curves.front().value);
  EXPECT_EQ(line.points, (std::vector<core::Point2>{{1, 58}, {3, 56}}));
  EXPECT_THAT(read->skipped,
              testing::ElementsAre("line 13: a stroke without points", "1 dot of the pen"));
}

TEST_F(Files, TheExtensionChoosesTheFormat) {
  const Document d = mixed();
  for (const std::string extension : {".json", ".svg"}) {
    const fs::path target = file("a" + extension);
    const auto written = write_document(d, target);
    ASSERT_TRUE(written) << written.error().message;
    const auto read = read_document(target);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(to_json(*read).dump(), to_json(d).dump()) << extension;
  }
  EXPECT_FALSE(write_document(d, file("a.bmp")));
}

TEST_F(Files, AnotherProgramDrawsOurSvg) {
  if (std::system("command -v rsvg-convert >/dev/null 2>&1") != 0)
    GTEST_SKIP() << "rsvg-convert (librsvg2-bin) is not installed";
  const fs::path drawing = file("a.svg");
  ASSERT_TRUE(write_document(mixed(), drawing));
  const fs::path picture = file("a.png");
  const std::string command = "rsvg-convert " + drawing.string() + " -o " + picture.string();
  EXPECT_EQ(std::system(command.c_str()), 0);
  EXPECT_GT(fs::file_size(picture), 100U);
}

TEST_F(Files, TheContentChoosesWhereTheNameSaysNothing) {
  EXPECT_TRUE(read_document(file("a", to_json(mixed()).dump())));
  EXPECT_TRUE(read_document(file("b", write_svg_document(mixed(), 1)->content)));
  const auto points = read_document(file("c", "x,y\n0,0\n1,2\n3,4\n"));
  ASSERT_TRUE(points);
  EXPECT_TRUE(std::holds_alternative<curve::Polyline2>(points->paths[0].path.curves[0].value));
}

TEST_F(Files, FailuresNameTheFileAndTheLine) {
  const auto nothing = read_document(file("none.json"));
  ASSERT_FALSE(nothing);
  EXPECT_EQ(nothing.error().code, core::ErrorCode::io);
  const fs::path broken = file("a.json", "{\n\"type\":");
  const auto bad = read_document(broken);
  ASSERT_FALSE(bad);
  EXPECT_EQ(bad.error().path, broken.string() + ":2");
  const auto empty = read_document(file("a.svg", "<svg xmlns=\"http://www.w3.org/2000/svg\"/>"));
  ASSERT_FALSE(empty);
  EXPECT_EQ(empty.error().code, core::ErrorCode::bad_input);
}

TEST_F(Files, ATableHoldsEveryCurve) {
  Document d = mixed();
  const auto csv = format_document(d, ".csv", {.samples = 11});
  ASSERT_TRUE(csv);
  EXPECT_EQ(std::count(csv->content.begin(), csv->content.end(), '\n'), 1 + 3 * 11 + 2);
  EXPECT_TRUE(csv->content.starts_with("id,x,y,z\n"));
  EXPECT_EQ(csv->notes.size(), 3U);  // a surface that is left out, the unit, what has no place
  EXPECT_GT(csv->deviation, 0);
  d.paths.clear();
  const auto space = format_document(d, ".csv");
  ASSERT_TRUE(space);
  EXPECT_EQ(space->content, "x,y,z\n0,0,1\n1,2,3\n");
  EXPECT_EQ(space->deviation, 0);
  EXPECT_FALSE(format_document(d, ".svg", {}));
}

// A polygon of two cubics that are lines of 3 and 4 with a right angle between, 8 samples: the
// corner is one, at 3, and every step is 1.
TEST_F(Files, ATableHoldsTheCorners) {
  Document d;
  d.unit = "in";
  const curve::Bezier2 along{{{0, 0}, {1, 0}, {2, 0}, {3, 0}}, {}};
  const curve::Bezier2 up{{{3, 0}, {3, 1}, {3, 2}, {3, 4}}, {}};
  d.paths.push_back({{"l", "", ""}, {{{along}, {up}}, false}, 0});
  const auto csv = format_document(d, ".csv", {.samples = 8});
  ASSERT_TRUE(csv);
  EXPECT_THAT(csv->content, HasSubstr("\n3,0,3,\n"));
  EXPECT_EQ(std::count(csv->content.begin(), csv->content.end(), '\n'), 9);
  EXPECT_LE(csv->deviation, 1e-12);
  EXPECT_THAT(csv->notes.at(0), HasSubstr("does not tell: in"));
  const auto few = format_document(d, ".csv", {.samples = 2});
  ASSERT_TRUE(few);
  EXPECT_LE(few->deviation, 1e-12);
}

TEST_F(Files, NamesComeBackFromATable) {
  Document d;
  const std::vector<std::string> names = {"a,b", "say \"x\"", "c;d", "tab\there", "\u00e9"};
  for (const std::string& name : names)
    d.paths.push_back({{name, "", ""}, {{{curve::Polyline2{{{0, 0}, {1, 2}, {3, 4}}}}}, false}, 0});
  const auto csv = format_document(d, ".csv");
  ASSERT_TRUE(csv);
  const auto read = read_document(file("names.csv", csv->content));
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->paths.size(), names.size());
  for (std::size_t i = 0; i < names.size(); ++i)
    EXPECT_EQ(read->paths[i].label.name, i == 3 ? "tab here" : names[i]);
}

TEST_F(Files, LinesOfAMeshAreNumberedInTheirOrder) {
  const auto read = read_document(
      file("l.obj", "v 0 0 0\nv 1 0 0\nv 1 2 0\nv 1 2 3\nl 1 2\nl 2 3 4\nl 4 1\nf 1 2 3\n"));
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->space_curves.size(), 3U);
  EXPECT_EQ(read->skipped, std::vector<std::string>{"1 triangle"});
  const char* const names[] = {"line-1", "line-2", "line-3"};
  const std::size_t corners[] = {2, 3, 2};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(read->space_curves[i].label.name, names[i]);
    const auto* line = std::get_if<curve::Polyline3>(&read->space_curves[i].curve.value);
    ASSERT_TRUE(line);
    EXPECT_EQ(line->points.size(), corners[i]);
  }
}

TEST_F(Files, WhatAFormatCannotHoldIsSaid) {
  Document d;
  d.surfaces.push_back(mixed().surfaces[0]);
  for (const char* extension : {".svg", ".dxf", ".csv", ".glif", ".pdf"})
    EXPECT_FALSE(format_document(d, extension)) << extension;
  Document far;
  far.unit = "furlong";
  far.paths.push_back({{"a", "", ""}, {{{curve::Bezier2{{{0, 0}, {1, 2}}, {}}}}, false}, 0});
  const auto dxf = format_document(far, ".dxf");
  ASSERT_TRUE(dxf);
  EXPECT_THAT(dxf->notes.at(0), HasSubstr("furlong"));
  const auto odd =
      read_document(file("u.dxf",
                         "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n99\n0\nENDSEC\n"
                         "0\nSECTION\n2\nENTITIES\n0\nLINE\n10\n0\n20\n0\n11\n1\n21\n0\n0\nEOF\n"));
  ASSERT_TRUE(odd) << odd.error().message;
  EXPECT_THAT(odd->skipped.at(0), HasSubstr("unit"));
}

TEST_F(Files, CurvesFarFromTheOriginAreSampled) {
  Document d;  // 1e9 times their size away: the speed is a rounded number
  d.paths.push_back(
      {{"far", "", ""},
       {{{curve::Bezier2{{{1e9, 1e9}, {1e9 + 1, 1e9 + 2}, {1e9 + 4, 1e9}}, {}}}}, false},
       0});
  const auto csv = format_document(d, ".csv", {.samples = 11});
  ASSERT_TRUE(csv);
  EXPECT_EQ(std::count(csv->content.begin(), csv->content.end(), '\n'), 12);
}

TEST_F(Files, TheDeviationOfSamplesIsThatOfTheirPolygon) {
  Document d;
  lac::Chain circle{{{1, 0}, core::kPi / 2}, {{-1, 2 * core::kPi, 1, 1}}, true};
  d.paths.push_back({{"circle", "", ""}, {{{circle}}, true}, 0});
  const auto csv = format_document(d, ".csv", {.samples = 101});
  ASSERT_TRUE(csv);
  EXPECT_NEAR(csv->deviation, 1 - std::cos(core::kPi / 100), 1e-9);
}

TEST(Document, OtherExtensionsAreNotWritten) {
  for (const char* none : {".abc", ".stl", ""})
    EXPECT_THAT(format_document(mixed(), none).error().message, HasSubstr("can be written"));
}

}  // namespace
}  // namespace keyline::exchange
