#include "keyline/exchange/text/text_table.h"

#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace keyline::exchange::detail
