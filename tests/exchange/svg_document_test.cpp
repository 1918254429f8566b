#include "keyline/exchange/svg/svg_document.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "keyline/exchange/json/json_document.h"

namespace keyline::exchange {
namespace {

using document::Document;
using testing::HasSubstr;

/// Chains in the layers "Body", their own and "Body", the second with a line behind a gap that is
/// too wide for the pen to stay down.
Document chains() {
  Document d;
  d.unit = "mm";
  const auto add = [&d](document::Label label, double width, double x) {
    const lac::Chain chain{{{x, 1.0 / 3}, 0.1}, {{-1, 50, 0, 0.03}}, false};
    d.paths.push_back({std::move(label), {{{chain}}, false}, width});
  };
  add({"roof", "Body", "#aa1100"}, 0.25, 0);
  add({"sill", "", ""}, 0, 100);
  add({"door", "Body", ""}, 0, 200);
  document::Path& sill = d.paths[1].path;
  const core::Point2 end = evaluate(sill, 1);
  sill.curves.push_back({curve::Bezier2{{{end.x + 1e-4, end.y}, {160, 20}}, {}}});
  d.space_curves.push_back({{"rail", "", ""}, {curve::Polyline3{{{0, 0, 1}, {1, 2, 3}}}}});
  return d;
}

std::string drawn(const Document& d) {
  const auto written = write_svg_document(d, 0.001);
  EXPECT_TRUE(written) << written.error().message;
  return written ? written->content : std::string();
}

/// The drawing with every `from` that stands behind its metadata made a `to`.
std::string edited(std::string svg, const std::string& from, const std::string& to) {
  std::size_t at = svg.find("</metadata>");
  EXPECT_NE(svg.find(from, at), std::string::npos) << from;
  while ((at = svg.find(from, at)) != std::string::npos) {
    svg.replace(at, from.size(), to);
    at += to.size();
  }
  return svg;
}

Document read(const std::string& svg) {
  auto document = read_svg_document(svg);
  EXPECT_TRUE(document) << document.error().message;
  return document ? std::move(*document) : Document{};
}

bool is_exact(const document::NamedPath& named) {
  return !named.path.curves.empty() &&
         std::holds_alternative<lac::Chain>(named.path.curves[0].value);
}

TEST(SvgDocument, OfAnEditedDrawingTheNamesAndLooksCount) {
  const std::string svg = drawn(chains());
  struct Case {
    const char *from, *to;
    document::Label roof;
    double width;
  };
  for (const Case& c :
       {Case{"\"roof\"", "\"hood\"", {"hood", "Body", "#aa1100"}, 0.25},
        {"label=\"Body\"", "label=\"Glass\"", {"roof", "Glass", "#aa1100"}, 0.25},
        {"#aa1100", "#00ff00", {"roof", "Body", "#00ff00"}, 0.25},
        {"stroke-width=\"0.25\"", "stroke-width=\"3\"", {"roof", "Body", "#aa1100"}, 3}}) {
    SCOPED_TRACE(c.to);
    const Document d = read(edited(svg, c.from, c.to));
    ASSERT_EQ(d.paths.size(), 3U);
    EXPECT_EQ(d.paths[0].label, c.roof);
    EXPECT_DOUBLE_EQ(d.paths[0].stroke_width, c.width);
    EXPECT_EQ(d.paths[1].label, chains().paths[1].label);
    EXPECT_EQ(d.paths[1].stroke_width, 0);
    EXPECT_EQ(d.paths[2].label, (document::Label{"door", c.roof.layer, ""}));
    EXPECT_EQ(d.paths[2].stroke_width, 0);
    for (const document::NamedPath& named : d.paths) EXPECT_TRUE(is_exact(named));
    EXPECT_EQ(d.space_curves.size(), 1U);
    EXPECT_TRUE(d.skipped.empty());
  }
}

// As it was written before the metadata told the names and looks of the drawing.
TEST(SvgDocument, OfADrawingThatDoesNotTellItsLabelsThoseOfTheDocumentCount) {
  std::string svg = drawn(chains());
  const std::string member = "&quot;labels&quot;:&quot;";
  const std::size_t at = svg.find(member);
  ASSERT_NE(at, std::string::npos);
  const std::string end = "&quot;,";
  svg.erase(at, svg.find(end, at + member.size()) + end.size() - at);
  EXPECT_EQ(to_json(read(svg)).dump(), to_json(chains()).dump());
}

TEST(SvgDocument, WidthsAndPageComeInTheUnitOfTheDocument) {
  Document d = chains();
  d.unit = "m";
  d.page = curve::Box2{{-1, -2}, {400, 60}};
  const std::string svg = drawn(d);
  const Document same = read(svg);
  EXPECT_EQ(to_json(same).dump(), to_json(d).dump());
  ASSERT_TRUE(same.page);
  EXPECT_NEAR(same.page->low.y, -2, 1e-12);
  EXPECT_NEAR(same.page->high.x, 400, 1e-12);
  const Document wide = read(edited(svg, "stroke-width=\"0.25\"", "stroke-width=\"3\""));
  EXPECT_EQ(wide.unit, "m");
  EXPECT_DOUBLE_EQ(wide.paths.at(0).stroke_width, 3);
  EXPECT_EQ(wide.paths.at(1).stroke_width, 0);
}

TEST(SvgDocument, WhatOthersPutBesideTheCurvesIsTold) {
  const Document given = chains();
  const std::string more = "<text>note</text><image href=\"x.png\"/></svg>";
  const Document d = read(edited(drawn(given), "</svg>", more));
  EXPECT_TRUE(is_exact(d.paths.at(0)));
  EXPECT_EQ(d.paths.at(1).label, given.paths[1].label);
  ASSERT_EQ(d.skipped.size(), 2U);
  EXPECT_THAT(d.skipped[0], HasSubstr("image: 1 element"));
  EXPECT_THAT(d.skipped[1], HasSubstr("text: 1 element"));
  const Document hidden = read(edited(drawn(given), "<g id=\"layer1\"", "<g display=\"none\""));
  ASSERT_EQ(hidden.skipped.size(), 1U);
  EXPECT_THAT(hidden.skipped[0], HasSubstr("2 shapes that display"));
}

// A path taken apart is two paths: no longer the curves of the metadata.
TEST(SvgDocument, AnElementTakenApartIsADrawingOfItsOwn) {
  std::string svg = drawn(chains());
  const std::size_t second = svg.rfind('M');
  svg.insert(second, "\"/><path id=\"apart\" d=\"");
  const Document d = read(svg);
  ASSERT_EQ(d.paths.size(), 4U);
  EXPECT_EQ(d.paths[3].label.name, "apart");
  EXPECT_FALSE(is_exact(d.paths[0]));
  EXPECT_THAT(d.skipped.back(), HasSubstr("changed"));
}

}  // namespace
}  // namespace keyline::exchange
