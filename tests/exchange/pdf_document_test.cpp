#include "keyline/exchange/pdf/pdf_document.h"

#include <cmath>
#include <cstdio>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace keyline::exchange {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

document::Document drawing(const std::string& unit, double length) {
  document::Document d;
  d.unit = unit;
  d.paths.push_back({{"line", "r\u00F6d", "#ff0000"},
                     {{{curve::Bezier2{{{10, 10}, {10 + length, 10}}, {}}}}, false},
                     0.5});
  return d;
}

/// Byte offsets of the cross-reference table that point at "N 0 obj".
int sound_references(const std::string& pdf) {
  std::size_t at = pdf.rfind("startxref\n");
  at = std::stoul(pdf.substr(at + 10));
  EXPECT_EQ(pdf.substr(at, 5), "xref\n");
  int sound = 0;
  for (std::size_t entry = pdf.find(" n \n", at); entry != std::string::npos;
       entry = pdf.find(" n \n", entry + 1)) {
    const std::size_t place = std::stoul(pdf.substr(entry - 16, 10));
    sound += pdf.substr(place).starts_with(std::to_string(sound + 1) + " 0 obj\n");
  }
  return sound;
}

TEST(PdfDocument, IsInRealSizeWithLayersAndColours) {
  const auto written = write_pdf_document(drawing("in", 10), 1e-3);
  ASSERT_TRUE(written) << written.error().message;
  const std::string& pdf = written->content;
  EXPECT_TRUE(pdf.starts_with("%PDF-1.5\n"));
  EXPECT_THAT(pdf, HasSubstr("72 0 0 72 0 0 cm"));        // points per inch
  EXPECT_THAT(pdf, HasSubstr("/MediaBox [0 0 764 44]"));  // 10 in and margins
  EXPECT_THAT(pdf, HasSubstr("1 0 0 RG 0.5 w\n"));
  EXPECT_THAT(pdf, HasSubstr("/Name <FEFF007200F60064>"));
  EXPECT_EQ(sound_references(pdf), 5);
  EXPECT_TRUE(written->notes.empty());
}

// Where none is given, a line is as wide as a four-hundredth of the drawing, 1 mm of 400.
TEST(PdfDocument, LinesWithoutAWidthAreAFourHundredth) {
  document::Document d = drawing("mm", 400);
  d.paths[0].stroke_width = 0;
  EXPECT_THAT(write_pdf_document(d, 1e-3).value().content, HasSubstr("1 0 0 RG 1 w\n"));
}

// The middle of what is drawn lies in the middle of the page, wherever it was drawn.
TEST(PdfDocument, TheDrawingStandsInTheMiddleOfThePage) {
  for (const core::Point2 low : {core::Point2{0, 0}, {100, 200}, {-3000, 70}}) {
    document::Document d;
    d.unit = "mm";
    const core::Point2 high{low.x + 40, low.y + 30};
    d.paths.push_back({{"c", "", ""}, {{{curve::Bezier2{{low, high}, {}}}}, false}, 0});
    const auto written = write_pdf_document(d, 1e-3);
    ASSERT_TRUE(written);
    const std::string& pdf = written->content;
    double width = 0, height = 0, x = 0, y = 0;
    const std::size_t box = pdf.find("/MediaBox [");
    const std::size_t move = pdf.find(" m\n");
    ASSERT_TRUE(box != std::string::npos && move != std::string::npos);
    ASSERT_EQ(std::sscanf(pdf.c_str() + box, "/MediaBox [0 0 %lf %lf]", &width, &height), 2);
    const std::size_t line = pdf.rfind('\n', move - 1) + 1;
    ASSERT_EQ(std::sscanf(pdf.c_str() + line, "%lf %lf m", &x, &y), 2);
    constexpr double kPoints = 72 / 25.4;
    EXPECT_NEAR(x + 20, width / kPoints / 2, 1e-6);
    EXPECT_NEAR(y + 15, height / kPoints / 2, 1e-6);
  }
}

TEST(PdfDocument, ALargeDrawingIsScaledAndSaysSo) {
  const auto written = write_pdf_document(drawing("m", 30), 1e-3);
  ASSERT_TRUE(written);
  EXPECT_THAT(written->notes, ElementsAre(HasSubstr("scale 1:10:")));
}

TEST(PdfDocument, WhatHasNoSizeIsRefused) {
  EXPECT_FALSE(write_pdf_document(drawing("mm", 0), 1e-3));
  EXPECT_FALSE(write_pdf_document({}, 1e-3));
  EXPECT_FALSE(write_pdf_document(drawing("mm", 1e300), 1e-3));
}

/// What stands between the first "m" and what paints the path.
std::string drawn(document::Document d) {
  d.unit = "mm";
  const auto written = write_pdf_document(d, 1e-3);
  if (!written) return written.error().message;
  const std::size_t from = written->content.find(" m\n") + 3;
  return written->content.substr(from, written->content.find("EMC", from) - from);
}

// A parabola's cubic has its handles two thirds of the way to the parabola's; lower-case s closes.
TEST(PdfDocument, ParabolasAreCubicsAndClosedPathsClose) {
  const auto path = [](std::vector<core::Point2> control, bool closed) {
    document::Document d;
    d.paths.push_back({{}, {{{curve::Bezier2{std::move(control), {}}}}, closed}, 0});
    return d;
  };
  document::Document parabola = path({{0, 0}, {30, 60}, {60, 0}}, false);
  parabola.page = curve::Box2{{0, 0}, {60, 60}};
  const double corner = (60 - std::ceil(60 * 72 / 25.4) * 25.4 / 72) / 2;
  std::istringstream text(drawn(parabola));
  for (const core::Point2 wanted : {core::Point2{20, 40}, {40, 40}, {60, 0}}) {
    double x = 0, y = 0;
    text >> x >> y;
    EXPECT_NEAR(x + corner, wanted.x, 1e-9);
    EXPECT_NEAR(y + corner, wanted.y, 1e-9);
  }
  EXPECT_THAT(drawn(parabola), HasSubstr(" c\nS\n"));
  document::Document loop = path({{0, 0}, {3, 6}, {6, 0}}, true);
  loop.paths[0].path.curves.push_back({curve::Bezier2{{{6, 0}, {0, 0}}, {}}});
  EXPECT_THAT(drawn(loop), HasSubstr(" l\ns\n"));
  EXPECT_THAT(drawn(path({{0, 0}, {3, 6}}, false)), HasSubstr(" l\nS\n"));
}

// UTF-16 beyond its first plane is a pair: U+1F697 is D83D DE97; U+FFFF and U+10000 lie on either
// side.
TEST(PdfDocument, NamesOfLayersAreUtf16) {
  const auto name = [](const char* layer) {
    document::Document d = drawing("mm", 10);
    d.paths[0].label.layer = layer;
    const std::string pdf = write_pdf_document(d, 1e-3)->content;
    const std::size_t at = pdf.find("/Name <") + 7;
    return pdf.substr(at, pdf.find('>', at) - at);
  };
  EXPECT_EQ(name("a"), "FEFF0061");
  EXPECT_EQ(name("\U0001F697"), "FEFFD83DDE97");
  EXPECT_EQ(name("\uFFFD"), "FEFFFFFD");
  EXPECT_EQ(name("\U00010000"), "FEFFD800DC00");
  EXPECT_EQ(name("\U0010FFFF"), "FEFFDBFFDFFF");
}

// Parts of 255 in four decimals; a path's own colour and width before its layer's.
TEST(PdfDocument, ColoursAndWidthsAreThePathsOwn) {
  document::Document d = drawing("mm", 10);
  d.paths[0].label.color = "#336699";
  d.paths[0].stroke_width = 0;
  d.paths.push_back(d.paths[0]);
  d.paths[1].label.color = "#0000ff";
  d.paths[1].stroke_width = 0.25;
  const auto written = write_pdf_document(d, 1e-3);
  ASSERT_TRUE(written);
  EXPECT_THAT(written->content, HasSubstr("0.2 0.4 0.6 RG "));
  EXPECT_THAT(written->content, HasSubstr("0 0 1 RG 0.25 w\n"));
}

// A page that is given is kept: no margin, its corner at 0.
TEST(PdfDocument, APageThatIsGivenHasNoMargin) {
  document::Document d = drawing("in", 1);
  d.page = curve::Box2{{9, 8}, {12, 10}};
  const auto written = write_pdf_document(d, 1e-3);
  ASSERT_TRUE(written);
  EXPECT_THAT(written->content, HasSubstr("/MediaBox [0 0 216 144]"));
  EXPECT_THAT(written->content, HasSubstr("\n1 2 m\n2 2 l\n"));
}

// 14400 points are 200 inches: the largest page, and the first that is too large.
TEST(PdfDocument, PagesAreAtMost200Inches) {
  const auto scale = [](double width) {
    document::Document d = drawing("in", 1);
    d.page = curve::Box2{{0, 0}, {width, 20}};
    return write_pdf_document(d, 1e-3)->notes;
  };
  EXPECT_THAT(scale(200), ElementsAre());
  EXPECT_THAT(scale(201), ElementsAre(HasSubstr("scale 1:10:")));
  EXPECT_THAT(scale(2001), ElementsAre(HasSubstr("scale 1:100:")));
}

// The handles of a cubic stand in the order of ISO 32000-1, 8.5.2: those of the start first. Taken
// from where the curve starts, they are the given points less the first.
TEST(PdfDocument, HandlesAreInTheOrderOfTheFormat) {
  document::Document d;
  d.unit = "mm";
  d.paths.push_back(
      {{"c", "", ""}, {{{curve::Bezier2{{{0, 0}, {1, 2}, {7, 3}, {8, 0}}, {}}}}, false}, 0});
  const auto written = write_pdf_document(d, 1e-3);
  ASSERT_TRUE(written);
  const std::size_t end = written->content.find(" c\n");
  ASSERT_NE(end, std::string::npos);
  const std::size_t from = written->content.rfind(" w\n", end) + 3;
  std::istringstream text(written->content.substr(from, end - from));
  double x0 = 0;
  double y0 = 0;
  std::string verb;
  text >> x0 >> y0 >> verb;
  EXPECT_EQ(verb, "m");
  for (const core::Point2 wanted : {core::Point2{1, 2}, {7, 3}, {8, 0}}) {
    double x = 0;
    double y = 0;
    text >> x >> y;
    EXPECT_NEAR(x - x0, wanted.x, 1e-9);
    EXPECT_NEAR(y - y0, wanted.y, 1e-9);
  }
}

}  // namespace
}  // namespace keyline::exchange
