#include "keyline/figure/drawing.h"

#include <cmath>
#include <pugixml.hpp>

#include <gtest/gtest.h>

#include "picture.h"

namespace keyline::figure {
namespace {

Drawing sample_drawing() {
  Drawing d;
  d.width = 200;
  d.height = 100;
  d.title = "A <hostile> & \"quoted\" title";
  d.description = "One of everything.";
  Path path;
  path.move_to({10, 10}).line_to({60, 10}).cubic_to({80, 10}, {90, 20}, {90, 40}).close();
  d.add(Shape{path, Stroke{palette(0), 2, {4, 2}}, with_alpha(palette(1), 0.5)});
  d.add(Label{{100, 50}, "ρ < 3 & x", 12, kInk, Anchor::middle, Baseline::middle, 0.3, true});
  d.add(Marks{{{20, 80}, {40, 80}}, Marker::dot, 5, palette(2)});
  d.add(Marks{{{60, 80}, {80, 80}}, Marker::diamond, 6, palette(3)});
  d.add(Picture{{{150, 60}, {190, 90}}, 2, 1, {255, 0, 0, 0, 0, 255}, "two pixels"});
  Group group{"cut", Box{{100, 60}, {140, 90}}, {}};
  group.add(Shape{rectangle({{0, 0}, {500, 500}}), std::nullopt, Color{0, 200, 0}});
  d.add(group);
  return d;
}

pugi::xml_document parsed(const std::string& svg) {
  pugi::xml_document document;
  const auto result = document.load_buffer(svg.data(), svg.size());
  EXPECT_TRUE(result) << result.description() << "\n" << svg;
  return document;
}

TEST(Svg, HoldsEveryItemAsWellFormedXml) {
  const auto document = parsed(write_svg(sample_drawing()));
  const auto root = document.child("svg");
  EXPECT_STREQ(root.attribute("width").value(), "200");
  EXPECT_STREQ(root.attribute("viewBox").value(), "0 0 200 100");
  EXPECT_STREQ(root.attribute("aria-labelledby").value(), "k-title k-desc");
  EXPECT_STREQ(root.child("title").text().get(), "A <hostile> & \"quoted\" title");
  const auto path = root.find_child_by_attribute("path", "stroke-dasharray", "4 2");
  EXPECT_STREQ(path.attribute("d").value(), "M10 10L60 10C80 10 90 20 90 40Z");
  EXPECT_STREQ(path.attribute("fill-opacity").value(), "0.5");
  EXPECT_STREQ(root.child("text").text().get(), "ρ < 3 & x");
  EXPECT_STREQ(root.find_child_by_attribute("stroke-linecap", "round").attribute("d").value(),
               "M20 80h0M40 80h0");
  EXPECT_STREQ(root.child("g").attribute("data-name").value(), "cut");
  EXPECT_STREQ(root.child("g").attribute("clip-path").value(), "url(#k-clip1)");
  EXPECT_STREQ(root.child("clipPath").attribute("id").value(), "k-clip1");
  const std::string image = root.child("image").attribute("xlink:href").value();
  EXPECT_EQ(image.rfind("data:image/png;base64,iVBORw0KGgo", 0), 0U);
}

TEST(Svg, PrefixesIdsAndStatesMillimetres) {
  Drawing d = sample_drawing();
  d.unit = PageUnit::mm;
  const auto document = parsed(write_svg(d, {"figure2", false}));
  const auto root = document.child("svg");
  EXPECT_STREQ(root.attribute("width").value(), "200mm");
  EXPECT_STREQ(root.child("clipPath").attribute("id").value(), "figure2-clip1");
}

TEST(Writers, GiveTheSameBytesTwice) {
  const Drawing d = sample_drawing();
  EXPECT_EQ(write_svg(d), write_svg(d));
  EXPECT_EQ(write_pdf(d).value(), write_pdf(d).value());
  EXPECT_EQ(write_png(d).value(), write_png(d).value());
}

TEST(Png, ShowsWhatWasDrawn) {
  const auto png = write_png(sample_drawing(), 2);
  ASSERT_TRUE(png);
  const Decoded picture(*png);
  ASSERT_TRUE(picture.valid());
  EXPECT_EQ(picture.width(), 400);
  EXPECT_EQ(picture.height(), 200);
  EXPECT_EQ(picture.at(1, 1), 0xFFFFFFU);
  EXPECT_EQ(picture.at(240, 150), 0x00C800U);  // inside the clip
  EXPECT_EQ(picture.at(210, 110), 0xFFFFFFU);  // outside of it
  EXPECT_EQ(picture.at(310, 150), 0xFF0000U);
  EXPECT_EQ(picture.at(370, 150), 0x0000FFU);
  EXPECT_EQ(picture.at(40, 160), 0x008562U);  // a dot
  EXPECT_GT(picture.count_other_than(0xFFFFFFU), 5000);
}

TEST(Png, RefusesImpossibleSizes) {
  Drawing d;
  d.width = 0;
  EXPECT_EQ(write_png(d).error().code, core::ErrorCode::bad_input);
  EXPECT_EQ(write_pdf(d).error().code, core::ErrorCode::bad_input);
  d.width = NAN;
  EXPECT_FALSE(write_png(d));
  d.width = 1e9;
  EXPECT_FALSE(write_png(d));
  EXPECT_FALSE(write_pdf(d));
  d.width = 100;
  EXPECT_FALSE(write_png(d, 1e6));
  EXPECT_FALSE(write_png(d, -1));
}

TEST(Pdf, HasHeaderAndFonts) {
  const auto pdf = write_pdf(sample_drawing());
  ASSERT_TRUE(pdf);
  EXPECT_EQ(pdf->substr(0, 5), "%PDF-");
  EXPECT_NE(pdf->find("%%EOF"), std::string::npos);
  EXPECT_NE(pdf->find("/FontFile"), std::string::npos);
}

TEST(Writers, LeaveOutWhatIsNotFinite) {
  Drawing d;
  Path path;
  path.move_to({0, 0}).line_to({NAN, 1}).line_to({5, 5}).line_to({1e300, 0}).line_to({7, 7});
  path.line_to({8, 8}).cubic_to({INFINITY, 0}, {0, 0}, {9, 9});
  d.add(Shape{path, Stroke{}, std::nullopt});
  d.add(Shape{rectangle({{0, 0}, {1, 1}}), Stroke{kInk, NAN, {}}, std::nullopt});
  d.add(Label{{NAN, 0}, "nowhere"});
  d.add(Label{{0, 0}, "endless", INFINITY});
  d.add(Marks{{{NAN, 0}}, Marker::dot, 4, kInk});
  d.add(Picture{{{0, 0}, {1, 1}}, 1000, 1000, {1, 2, 3}, ""});
  const auto document = parsed(write_svg(d));
  const auto root = document.child("svg");
  EXPECT_STREQ(root.last_child().attribute("d").value(), "M0 0M5 5M7 7L8 8 9 9");
  EXPECT_TRUE(write_png(d));
  EXPECT_TRUE(write_pdf(d));
}

TEST(Writers, MakeHostileTextHarmless) {
  Drawing d;
  d.title = "\xFF\xC0\x80 \x01 ok";
  d.add(Label{{10, 20}, std::string("</text><script>alert(1)</script>\xED\xA0\x80\0x", 36)});
  const std::string svg = write_svg(d);
  EXPECT_EQ(svg.find("<script"), std::string::npos);
  const auto document = parsed(svg);
  EXPECT_STREQ(document.child("svg").child("title").text().get(), "\uFFFD\uFFFD\uFFFD  ok");
  EXPECT_TRUE(write_png(d));
  EXPECT_TRUE(write_pdf(d));
}

TEST(Viewport, CentresAndFlips) {
  const Viewport v = fit_viewport({{0, 0}, {10, 5}}, {{0, 0}, {100, 100}});
  EXPECT_EQ(v.scale, 10);
  EXPECT_EQ(to_page(v, core::Point2{0, 0}), (core::Point2{0, 75}));
  EXPECT_EQ(to_page(v, core::Point2{10, 5}), (core::Point2{100, 25}));
  EXPECT_EQ(fit_viewport({{3, 3}, {3, 3}}, {{0, 0}, {1, 1}}).scale, 1);
}

TEST(ClipToBox, CutsAtTheBorder) {
  const Box box{{0, 0}, {10, 10}};
  const std::vector<core::Point2> line{{-5, 5}, {5, 5}, {5, 20}, {8, 20}, {8, 5}, {NAN, 0}, {1, 1}};
  const auto runs = clip_to_box(line, box);
  ASSERT_EQ(runs.size(), 2U);
  EXPECT_EQ(runs[0], (std::vector<core::Point2>{{0, 5}, {5, 5}, {5, 10}}));
  EXPECT_EQ(runs[1], (std::vector<core::Point2>{{8, 10}, {8, 5}}));
  EXPECT_TRUE(clip_to_box(std::vector<core::Point2>{}, box).empty());
}

TEST(Simplify, KeepsWithinTolerance) {
  std::vector<core::Point2> points;
  for (int i = 0; i <= 1000; ++i) points.push_back({i * 0.01, std::sin(i * 0.01)});
  const auto few = simplify(points, 0.01);
  EXPECT_LT(few.size(), 50U);
  EXPECT_EQ(few.front(), points.front());
  EXPECT_EQ(few.back(), points.back());
}

TEST(Tile, PlacesDrawingsInRows) {
  const Drawing d = sample_drawing();
  const Drawing page = tile({d, d, d}, 2, 10);
  EXPECT_EQ(page.width, 410);
  EXPECT_EQ(page.height, 210);
  const auto png = write_png(page, 1);
  ASSERT_TRUE(png);
  EXPECT_EQ(Decoded(*png).at(120 + 210, 75), 0x00C800U);
}

}  // namespace
}  // namespace keyline::figure
