#include "keyline/exchange/text/text_table.h"

#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/exchange/text/header_unit.h"

namespace keyline::exchange::detail {
namespace {

TEST(ParseNumber, MayBeQuotedInBracketsOrOfFortran) {
  const TableStyle point{',', false};
  const TableStyle comma{';', true};
  for (const char* text : {"12.5", "\"12.5\"", "\" 12.5 \"", "(12.5", "12.5)", "[12.5]", "([12.5])",
                           "1.25D1", "0.125d+2", "+12.5"})
    EXPECT_EQ(parse_number(text, point), 12.5) << text;
  EXPECT_EQ(parse_number("12,5", comma), 12.5);
  EXPECT_EQ(parse_number("\"12,5\"", comma), 12.5);
  EXPECT_EQ(parse_number("1e400", point), std::numeric_limits<double>::max());
  for (const char* none : {"12,5", "12.5x", "\"12.5", "12.5\"", "\"", "x", "1 2", "1.2.3"})
    EXPECT_FALSE(parse_number(none, point)) << none;
  EXPECT_FALSE(parse_number(std::string(200, '1'), point));
  EXPECT_EQ(parse_number(std::string(126, '0') + "7.", point), 7);
}

// The end mark of CP/M stands behind the text. A stray one between digits makes no two numbers of
// one.
TEST(Split, AnEndMarkPartsNoNumber) {
  using Fields = std::vector<std::string_view>;
  const TableStyle spaces{' ', false};
  EXPECT_EQ(split("\x1a 1\t2\x1a ", spaces), (Fields{"1", "2"}));
  const Fields fields = split(
      "2 0.\x1a"
      "7",
      spaces);
  EXPECT_EQ(fields, (Fields{"2",
                            "0.\x1a"
                            "7"}));
  EXPECT_FALSE(parse_number(fields.back(), spaces));
}

// The seven errors of ECMA-376 part 1, 18.17.3, two in German, and #N/A in Spanish and Danish.
TEST(ParseNumber, ErrorsOfSpreadsheetsAreMissingValues) {
  const TableStyle style{';', true};
  for (const std::string error : {"#NULL!", "#DIV/0!", "#VALUE!", "#REF!", "#NAME?", "#NUM!",
                                  "#N/A", "#WERT!", "#NV", "#N/D", "#I/T"}) {
    ASSERT_TRUE(parse_number(error, style)) << error;
    EXPECT_TRUE(std::isnan(*parse_number("\"" + error + "\"", style))) << error;
    for (const char* rest : {";1,5", "; 1,5", "\t2", " 0.5", ",-1", " ;1", ";", " #N/A"})
      EXPECT_FALSE(is_comment(error + rest)) << error << rest;
    EXPECT_TRUE(is_comment(error + " stands for what is missing")) << error;
  }
  for (const char* none : {"#", "#1", "#x;y", "# N/A;1", "#N/A", "#!", "# 1;2", "#Neu!;1", "##!;1"})
    EXPECT_TRUE(is_comment(none)) << none;
  EXPECT_FALSE(parse_number("#1", style));
  EXPECT_FALSE(parse_number("#!", style));
}

TEST(HeaderUnit, StandsBehindAName) {
  EXPECT_EQ(start_of_unit("x_mm"), 1U);
  EXPECT_EQ(start_of_unit("_mm"), std::string_view::npos);
  EXPECT_EQ(unit_of("x [mm]").known, "mm");
  EXPECT_EQ(unit_of("x [chord]").unknown, "chord");
  EXPECT_EQ(unit_of("x (chord)").unknown, "chord");
  for (const char* none : {"x [1]", "x [-]", "x []", "x ()"}) {
    EXPECT_EQ(unit_of(none).known, "") << none;
    EXPECT_EQ(unit_of(none).unknown, "") << none;
  }
}

}  // namespace
}  // namespace keyline::exchange::detail
