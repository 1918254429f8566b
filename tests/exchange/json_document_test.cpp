#include "keyline/exchange/json/json_document.h"

#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "keyline/exchange/json/json_surface.h"

/// What a document says beside its curves.
namespace keyline::exchange {
namespace {

using document::Document;
using nlohmann::json;

Document one() {
  Document d;
  d.paths.push_back({{}, {{{curve::Bezier2{{{0, 0}, {1, 2}}, {}}}}, false}, 0});
  return d;
}

// A value by itself cannot say these things: then a list of one.
TEST(JsonDocument, IsAListWhereMoreIsSaidThanAValueHolds) {
  const auto is_list = [](const auto& change) {
    Document d = one();
    change(d);
    const json j = to_json(d);
    EXPECT_NE(j.contains("curves"), j.contains("type"));
    return j.contains("curves");
  };
  EXPECT_FALSE(is_list([](Document&) {}));
  EXPECT_FALSE(is_list([](Document& d) { d.unit = "in"; }));
  EXPECT_FALSE(is_list([](Document& d) { d.paths[0].label.name = "n"; }));
  EXPECT_FALSE(is_list([](Document& d) { d.paths[0].label.color = "#123456"; }));
  EXPECT_TRUE(is_list([](Document& d) { d.paths[0].label.layer = "l"; }));
  EXPECT_TRUE(is_list([](Document& d) { d.paths[0].stroke_width = 1; }));
  EXPECT_TRUE(is_list([](Document& d) { d.paths[0].stroke_width = 0.5; }));
  EXPECT_TRUE(is_list([](Document& d) { d.skipped.emplace_back("a text"); }));
  EXPECT_TRUE(is_list([](Document& d) { d.paths.push_back(d.paths[0]); }));
  EXPECT_FALSE(to_json(one()).contains("unit"));
}

TEST(JsonDocument, ASpaceCurveByItselfIsItsValue) {
  Document d;
  d.space_curves.push_back({{"s", "", ""}, {curve::Polyline3{{{0, 0, 1}, {1, 2, 3}}}}});
  EXPECT_EQ(to_json(d)["type"], "polyline");
  d.space_curves[0].label.layer = "l";
  EXPECT_EQ(to_json(d)["curves"][0]["layer"], "l");
}

// An array of values, or of what stands in either list, is a document of them in their order.
TEST(JsonDocument, MayBeAnArrayOfCurvesAndSurfaces) {
  const json patch = {{"type", "bezier-surface"},
                      {"points", {{{0, 0, 0}, {1, 0, 0}}, {{0, 1, 0}, {1, 1, 1}}}}};
  const json line = {{"type", "polyline"}, {"points", {{0, 0}, {1, 2}}}};
  const auto mixed = document_from_json(
      {patch, line, {{"surface", patch}, {"name", "s"}}, {{"curve", line}, {"layer", "l"}}});
  ASSERT_TRUE(mixed) << mixed.error().message;
  ASSERT_EQ(mixed->surfaces.size(), 2U);
  ASSERT_EQ(mixed->paths.size(), 2U);
  EXPECT_EQ(mixed->surfaces[1].label.name, "s");
  EXPECT_EQ(mixed->paths[1].label.layer, "l");
  EXPECT_EQ(to_json(mixed->surfaces[0].surface), patch);
  const auto listed = document_from_json({{"surfaces", {patch, patch}}});
  ASSERT_TRUE(listed) << listed.error().message;
  EXPECT_EQ(listed->surfaces.size(), 2U);
  ASSERT_TRUE(document_from_json({{"surface", patch}}));
  const auto wrong = document_from_json(json::array({patch, 7}));
  ASSERT_FALSE(wrong);
  EXPECT_EQ(wrong.error().path, "[1]");
}

// A closed path of a curve that is no chain says so as a path only.
TEST(JsonDocument, ClosedPathsStayClosed) {
  Document d = one();
  EXPECT_EQ(to_json(d)["type"], "bezier");
  d.paths[0].path.closed = true;
  EXPECT_EQ(to_json(d)["type"], "path");
  const auto back = document_from_json(to_json(d));
  ASSERT_TRUE(back);
  EXPECT_TRUE(back->paths[0].path.closed);
}

const char* const kCurve = R"({"type": "polyline", "points": [[0, 0], [1, 2]]})";
const char* const kEdge = R"({"type": "polyline", "points": [[0, 0, 0], [1, 2, 1]]})";
const char* const kPatch =
    R"({"type": "bezier-surface", "points": [[[0, 0, 0], [1, 0, 0]], [[0, 1, 0], [1, 1, 1]]]})";

/// What the text says where "C", "E" and "P" stand for a curve, an edge and a patch.
core::Result<Document> read(const std::string& text) {
  std::string whole;
  for (const char c : text)
    whole += c == 'C' ? kCurve : c == 'E' ? kEdge : c == 'P' ? kPatch : std::string(1, c);
  return read_json(whole);
}

std::string path_of(const std::string& text) {
  const auto d = read(text);
  return d ? "fine" : d.error().path;
}

// A unit stands beside a document, a list or a thing of it: one of them is taken, two are refused.
TEST(JsonDocument, HasOneUnitWhereverItIsNamed) {
  const auto unit = [](std::string text) {
    for (const auto& [name, given] : {std::pair{'I', "inch"}, std::pair{'M', "m"}})
      for (std::size_t at; (at = text.find(name)) != std::string::npos;)
        text.replace(at, 1,
                     R"({"type": "polyline", "points": [[0, 0], [1, 2]], "unit": ")" +
                         std::string(given) + "\"}");
    const auto d = read(text);
    if (!d) return d.error().path + ": " + d.error().message;
    return d->unit + (d->skipped.empty() ? "" : ", " + d->skipped.front());
  };
  EXPECT_EQ(unit("[P, I, C, I]"), "in");
  EXPECT_EQ(unit(R"({"curves": [C, I]})"), "in");
  EXPECT_EQ(unit(R"({"unit": "in", "curves": [I, C]})"), "in");
  EXPECT_EQ(unit(R"({"curves": [{"curve": C, "unit": "m"}, M]})"), "m");
  EXPECT_EQ(unit(R"({"curves": [C], "surfaces": [{"surface": P, "unit": "m"}]})"), "m");
  EXPECT_EQ(unit("[I, M]"), "[1].unit: two units, in and m");
  EXPECT_EQ(unit(R"({"curves": [I, C, M]})"), "curves[2].unit: two units, in and m");
  EXPECT_EQ(unit(R"({"curves": [M], "unit": "mm"})"), "curves[0].unit: two units, mm and m");
  EXPECT_EQ(unit(R"({"curves": [I], "surfaces": [{"surface": P, "unit": "m"}]})"),
            "surfaces[0].unit: two units, in and m");
  EXPECT_EQ(path_of(R"({"curves": [{"curve": C, "unit": 2}]})"), "curves[0].unit");
}

TEST(JsonDocument, LinesHaveAWidthOfZeroOrMore) {
  const auto width = [](const std::string& w) {
    return path_of(R"({"curves": [{"curve": C, "stroke_width": )" + w + "}]}");
  };
  EXPECT_EQ(width("0"), "fine");
  EXPECT_EQ(width("1.5"), "fine");
  EXPECT_EQ(width("-1e-9"), "curves[0].stroke_width");
  EXPECT_EQ(width("\"wide\""), "curves[0].stroke_width");
}

TEST(JsonDocument, TrimsAreCounted) {
  const auto trims = [](const std::string& n) {
    const auto d = read(R"({"surfaces": [{"surface": P, "trims": )" + n + "}]}");
    return d ? std::to_string(d->surfaces[0].trims) : d.error().path;
  };
  EXPECT_EQ(trims("0"), "0");
  EXPECT_EQ(trims("1"), "1");
  EXPECT_EQ(trims("999999"), "999999");
  for (const char* none : {"1000000", "-1", "1.5", "\"2\"", "null"})
    EXPECT_EQ(trims(none), "surfaces[0].trims") << none;
}

// What cannot be taken over is refused where it stands, not dropped.
TEST(JsonDocument, LabelsAreTexts) {
  EXPECT_EQ(path_of(R"({"curves": [{"curve": C, "name": 3}]})"), "curves[0].name");
  EXPECT_EQ(path_of(R"({"curves": [{"curve": C, "layer": []}]})"), "curves[0].layer");
  EXPECT_EQ(path_of(R"({"curves": [{"curve": C, "color": "red"}]})"), "curves[0].color");
  EXPECT_EQ(path_of(R"({"curves": [{"curve": C, "color": "#12345"}]})"), "curves[0].color");
  EXPECT_EQ(path_of(R"({"curves": [{"curve": C, "color": "#12345g"}]})"), "curves[0].color");
  EXPECT_EQ(path_of(R"({"curves": [{"curve": C, "color": "#12aBcD", "name": null}]})"), "fine");
  EXPECT_EQ(path_of(R"({"surfaces": [{"surface": P, "color": 7}]})"), "surfaces[0].color");
  EXPECT_EQ(path_of(R"({"curve": C, "name": 3})"), "name");
  EXPECT_EQ(path_of(R"({"curves": [C], "unit": 25.4})"), "unit");
  EXPECT_EQ(path_of(R"({"curve": C, "unit": true})"), "unit");
}

TEST(JsonDocument, APathInSpaceIsItsCurves) {
  const auto d = read(R"({"curves": [{"name": "rail", "curve": {"type": "path", "curves":
    [E, {"type": "polyline", "points": [[1, 2, 1], [3, 3, 0]]}]}}]})");
  ASSERT_TRUE(d) << d.error().message;
  ASSERT_EQ(d->space_curves.size(), 2U);
  EXPECT_EQ(d->space_curves[1].label.name, "rail");
  EXPECT_EQ(path_of(R"({"type": "path", "curves": [E, E]})"), "curves[1]");
}

TEST(JsonDocument, PathsAreClosedOrNot) {
  const auto path = [](const std::string& closed) {
    return path_of(R"({"type": "path", "curves": [C], "closed": )" + closed + "}");
  };
  EXPECT_EQ(path("true"), "fine");
  EXPECT_EQ(path("\"yes\""), "closed");
  EXPECT_EQ(path("1"), "closed");
}

// The line that closes a path of curves is in no text; a polyline by itself ends where it begins.
TEST(JsonDocument, ALineThatClosesAPathIsTold) {
  const auto told = [](const std::string& curves, bool closed = true) {
    const auto d = read(R"({"curves": [{"curve": {"type": "path", "curves": [)" + curves +
                        R"(], "closed": )" + (closed ? "true" : "false") + "}}]}");
    if (!d) return d.error().message;
    return d->skipped.empty() ? std::string("nothing") : d->skipped.front();
  };
  const std::string bent = R"({"type": "bezier", "points": [[0, 0], [1, 5], [5, 5], [6, 0]]})";
  EXPECT_EQ(told(bent),
            "curves[0].curve: nothing, but a straight line of length 6 closes this path");
  EXPECT_EQ(told(bent, false), "nothing");
  EXPECT_EQ(told(bent + R"(, {"type": "bezier", "points": [[6, 0], [0, 0]]})"), "nothing");
  EXPECT_EQ(told(R"({"type": "polyline", "points": [[0, 0], [1, 0], [1, 1]]})"), "nothing");
}

TEST(JsonDocument, TrimLoopsAreListsOfCurves) {
  const auto loops = [](const std::string& list) {
    return R"({"surfaces": [{"surface": P, "trim_loops": )" + list + "}]}";
  };
  const auto two = read(loops("[[E, E], [E]]"));
  ASSERT_TRUE(two) << two.error().message;
  ASSERT_EQ(two->surfaces[0].trim_loops.size(), 2U);
  EXPECT_EQ(two->surfaces[0].trim_loops[0].size(), 2U);
  EXPECT_EQ(two->surfaces[0].trim_loops[1].size(), 1U);
  EXPECT_EQ(path_of(loops("3")), "surfaces[0].trim_loops");
  EXPECT_EQ(path_of(loops("[[E], 4]")), "surfaces[0].trim_loops[1]");
  EXPECT_EQ(path_of(loops("[[E, 4]]")), "surfaces[0].trim_loops[0][1]");
}

TEST(JsonDocument, WhatIsNoListIsNamed) {
  EXPECT_EQ(path_of(R"({"curves": 3})"), "curves");
  EXPECT_EQ(path_of(R"({"surfaces": "x"})"), "surfaces");
  EXPECT_EQ(path_of(R"({"surfaces": [3]})"), "surfaces[0]");
  EXPECT_EQ(path_of(R"({"surfaces": [C]})"), "surfaces[0]");
  EXPECT_EQ(path_of(R"({"surfaces": [P]})"), "fine");
  EXPECT_EQ(path_of(R"([P, C, 3])"), "[2]");
  EXPECT_EQ(path_of(R"({"curves": [C, 3]})"), "curves[1]");
  EXPECT_EQ(path_of(R"({"curve": C})"), "fine");
  EXPECT_EQ(path_of(R"({"curves": []})"), "fine");
}

// Degrees from 1 to 30, both ends included.
TEST(JsonDocument, DegreesAreAtMost30) {
  const auto spline = [](int degree) {
    std::string knots, points;
    for (int i = 0; i <= degree; ++i) {
      knots += "0, ";
      points += (i > 0 ? ", [" : "[") + std::to_string(i) + ", 1]";
    }
    for (int i = 0; i <= degree; ++i) knots += i > 0 ? ", 1" : "1";
    return path_of(R"({"type": "bspline", "degree": )" + std::to_string(degree) +
                   R"(, "knots": [)" + knots + R"(], "points": [)" + points + "]}");
  };
  EXPECT_EQ(spline(1), "fine");
  EXPECT_EQ(spline(30), "fine");
  EXPECT_EQ(spline(31), "degree");
  EXPECT_EQ(path_of(R"({"type": "bspline", "degree": 0, "knots": [0, 1, 2],)"
                    R"("points": [[0, 1], [1, 1]]})"),
            "degree");
}

}  // namespace
}  // namespace keyline::exchange
