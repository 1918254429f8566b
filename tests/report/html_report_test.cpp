#include "keyline/report/html_report.h"

#include <limits>
#include <pugixml.hpp>
#include <set>

#include <gtest/gtest.h>

#include "keyline/figure/rhythm_charts.h"

namespace keyline::report {
namespace {

const std::string kHostile = "\"'><script>alert(1)</script>&amp;\x01\xFF";

Report sample_report() {
  Report report;
  report.title = "Bonnet";
  report.subtitle = "examples/bonnet-scan.csv, curve 1";
  report.verdict_line = "Within the tolerance everywhere.";
  report.numbers = {{"Largest deviation", "0.42 mm", "tolerance 0.5 mm"}, {"Pieces", "5", ""}};
  figure::LcgPiece piece{.name = "Piece 1", .points = {{0, 0}, {1, 1}}, .lines = {{0, 1, 1, 0}}};
  const ReportFigure narrow{figure::lcg_chart(piece), "Curvature graph"};
  const ReportFigure wide{figure::lcg_chart(piece, 720, 300), "Larger"};
  report.sections = {{"Figures", {"A paragraph."}, {wide, narrow, narrow, wide, narrow}, {}},
                     {"Tables",
                      {},
                      {},
                      {piece_table({{.rhythm = "one line", .slope = "−1", .length = "12 mm"}}),
                       joint_table({{.between = "1–2", .order = "G2"}})}}};
  report.notes = {{NoteKind::warning, "2 strays left out"}, {NoteKind::note, "points reordered"}};
  report.options = {{"seed", "1"}};
  report.command = "keyline fair bonnet.csv --seed 1";
  report.generator = "Keyline 9.8.7";
  return report;
}

pugi::xml_document parsed(const std::string& html) {
  pugi::xml_document document;
  const auto result = document.load_buffer(html.data(), html.size());
  EXPECT_TRUE(result) << result.description() << " at " << result.offset;
  return document;
}

TEST(HtmlReport, HasItsPartsInOrder) {
  const auto document = parsed(html_report(sample_report()));
  const auto body = document.child("html").child("body");
  EXPECT_STREQ(body.select_node("header/h1").node().text().get(), "Bonnet");
  const auto main = body.child("main");
  EXPECT_STREQ(main.first_child().attribute("class").value(), "verdict good");
  EXPECT_EQ(main.select_nodes("dl/div").size(), 2U);
  EXPECT_EQ(main.select_nodes(".//figure").size(), 5U);
  EXPECT_EQ(main.select_nodes(".//div[@class='pair']").size(), 2U);
  EXPECT_EQ(main.select_nodes(".//div[@class='pair']/figure").size(), 3U);
  EXPECT_STREQ(main.select_node(".//figcaption").node().text().get(), "Figure 1. Larger");
  EXPECT_EQ(main.select_nodes(".//table").size(), 3U);
  EXPECT_STREQ(main.select_node(".//li[@class='warning']/strong").node().text().get(), "Warning:");
  EXPECT_STREQ(main.select_node(".//pre").node().text().get(), "keyline fair bonnet.csv --seed 1");
}

TEST(HtmlReport, NeedsNothingFromElsewhere) {
  const std::string html = html_report(sample_report());
  EXPECT_EQ(html.find("<script"), std::string::npos);
  EXPECT_EQ(html.find("src="), std::string::npos);
  EXPECT_EQ(html.find("@import"), std::string::npos);
  EXPECT_EQ(html.find("url(http"), std::string::npos);
  EXPECT_EQ(html, html_report(sample_report()));
}

LinkedCurve linked_arc() {
  LinkedCurve linked{.pieces = {kHostile}, .unit = kHostile};
  linked.curve.arc_length = {0, 1, 2};
  linked.curve.points = {{5, 5}, {6, 5.5}, {7, 6.5}};
  linked.curve.tangent_angle = {0, 0.5, 1};
  linked.curve.curvature = {0.5, std::numeric_limits<double>::infinity(), 1.0 / 3};
  linked.curve.joints = {1};
  return linked;
}

TEST(HtmlReport, LetsOneScriptDrawALinkedCurve) {
  Report report = sample_report();
  report.sections[0].linked = linked_arc();
  report.sections[0].figures[0].on_paper = true;
  const std::string html = html_report(report);
  const auto document = parsed(html);
  EXPECT_STREQ(document.select_node("//div[@class='explorer']/ul/li").node().text().get(),
               "\"'><script>alert(1)</script>&amp;\uFFFD");
  EXPECT_STREQ(document.select_node("//script[@type]").node().text().get(),
               R"({"s":[0,1,2],"k":[0.5,null,0.3333333],"x":[0,1,2],"y":[0,0.5,1.5],)"
               R"("a":[0,0.5,1],"joints":[1],"before":{"s":[],"k":[]}})");
  EXPECT_EQ(document.select_nodes("//script").size(), 2U);
  EXPECT_EQ(document.select_nodes("//figure[@class='wide still']").size(), 1U);
  EXPECT_NE(html.find("script-src 'sha256-"), std::string::npos);
}

TEST(HtmlReport, RefusesALinkedCurveWhosePartsDiffer) {
  Report report;
  report.sections.push_back({.title = "Curve", .linked = linked_arc()});
  report.sections[0].linked->curve.curvature.pop_back();
  EXPECT_THROW(html_report(report), core::InvalidInput);
}

TEST(HtmlReport, KeepsIdsApart) {
  const auto document = parsed(html_report(sample_report()));
  std::set<std::string> ids;
  for (const auto& found : document.select_nodes("//@id"))
    EXPECT_TRUE(ids.insert(found.attribute().value()).second) << found.attribute().value();
  for (const auto& found : document.select_nodes("//@aria-labelledby")) {
    std::istringstream names(found.attribute().value());
    for (std::string name; names >> name;) EXPECT_TRUE(ids.contains(name)) << name;
  }
}

TEST(HtmlReport, ShowsHostileTextAsText) {
  Report report = sample_report();
  report.title = report.subtitle = report.verdict_line = report.command = report.generator =
      kHostile;
  report.numbers = {{kHostile, kHostile, kHostile}};
  report.notes = {{NoteKind::note, kHostile}};
  report.options = {{kHostile, kHostile}};
  figure::Drawing drawing;
  drawing.title = drawing.description = kHostile;
  drawing.add(figure::Label{.at = {10, 10}, .text = kHostile});
  report.sections = {{kHostile,
                      {kHostile},
                      {{drawing, kHostile}},
                      {{kHostile, {{kHostile}}, {{kHostile, "too many cells"}, {}}}}}};
  const std::string html = html_report(report);
  EXPECT_EQ(html.find("<script"), std::string::npos);
  const auto document = parsed(html);
  EXPECT_STREQ(document.select_node("//h1").node().text().get(),
               "\"'><script>alert(1)</script>&amp;\uFFFD");
}

TEST(HtmlReport, StandsEmpty) {
  const auto document = parsed(html_report({}));
  EXPECT_TRUE(document.child("html").child("body").child("main"));
}

TEST(PieceTable, LeavesOutEmptyColumns) {
  const ReportTable table = piece_table({{.rhythm = "arc", .length = "3"}, {.rhythm = "line"}});
  ASSERT_EQ(table.columns.size(), 3U);
  EXPECT_EQ(table.columns[2].title, "Length");
  EXPECT_EQ(table.rows[1], (std::vector<std::string>{"2", "line", ""}));
}

}  // namespace
}  // namespace keyline::report
