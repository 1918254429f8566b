#include "keyline/exchange/lost_labels.h"

#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "keyline/exchange/document_file.h"
#include "keyline/exchange/points/points_reader.h"

namespace keyline::exchange {
namespace {

using document::Document;
using testing::HasSubstr;

document::NamedPath arch(const document::Label& label, double width) {
  return {label, {{{curve::Polyline2{{{0, 0}, {1, 2}, {3, 4}}}}}, false}, width};
}

// What a format has no place for is told, and nothing that it has.
TEST(LostLabels, AreThoseTheFormatHasNoPlaceFor) {
  Document d;
  d.paths = {arch({"roof", "body", "#aa1100"}, 0.25), arch({}, 0)};
  EXPECT_EQ(lost_labels(d, ".json"), "");
  EXPECT_EQ(lost_labels(d, ".svg"), "");
  for (const char* cad : {".dxf", ".step", ".stp", ".iges", ".igs"})
    EXPECT_EQ(lost_labels(d, cad), "widths of strokes") << cad;
  EXPECT_EQ(lost_labels(d, ".csv"), "layers, colours, widths of strokes");
  EXPECT_EQ(lost_labels(d, ".glif"), "names, layers, colours, widths of strokes");
  EXPECT_EQ(lost_labels(d, ".pdf"), "names");
  d.paths.resize(1);
  d.surfaces.emplace_back();
  EXPECT_EQ(lost_labels(d, ".csv"), "names, layers, colours, widths of strokes");
  d.surfaces.clear();
  EXPECT_EQ(lost_labels(d, ".csv"), "names, layers, colours, widths of strokes");
  d.paths[0].stroke_width = 0;
  EXPECT_EQ(lost_labels(d, ".dxf"), "");
  d.paths[0].label = {};
  EXPECT_EQ(lost_labels(d, ".glif"), "");
}

TEST(LostLabels, AreToldWhereAFileIsWritten) {
  Document d;
  d.paths = {arch({"roof", "", ""}, 0.25)};
  EXPECT_THAT(format_document(d, ".dxf").value().notes,
              testing::Contains("the format has no place for: widths of strokes"));
}

std::vector<std::string> notes_of(const Document& d, const std::string& extension) {
  const auto written = format_document(d, extension);
  if (!written) return {written.error().message};
  return written->notes;
}

// Numbers without a unit get one where the format knows none without, and that is told.
TEST(LostLabels, AUnitThatNobodyGaveIsTold) {
  Document d;
  d.paths = {arch({}, 0)};
  const auto told = testing::Contains("no unit is given: the numbers are written as mm");
  for (const char* extension : {".svg", ".svgz", ".pdf"})
    EXPECT_THAT(notes_of(d, extension), told) << extension;
  for (const char* extension : {".dxf", ".json", ".csv"})
    EXPECT_THAT(notes_of(d, extension), testing::Not(told)) << extension;
  d.unit = "mm";
  for (const char* extension : {".svg", ".pdf"})
    EXPECT_THAT(notes_of(d, extension), testing::Not(told)) << extension;
}

// Two curves of one name are two in a table, too, and those without any; a note says so.
TEST(LostLabels, CurvesOfOneNameStayApartInATable) {
  Document d;
  for (const char* name : {"twin", "twin", "", "", "twin#2"})
    d.paths.push_back(arch({name, "", ""}, 0));
  const auto csv = format_document(d, ".csv");
  ASSERT_TRUE(csv);
  EXPECT_THAT(csv->notes.at(0), HasSubstr("numbered"));
  std::istringstream in(csv->content);
  const auto read = read_points(in, "twins.csv");
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->size(), 5U);
  const char* const names[] = {"twin", "twin#2", "", "curve#2", "twin#2#2"};
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ((*read)[i].id, names[i]);
}

}  // namespace
}  // namespace keyline::exchange
