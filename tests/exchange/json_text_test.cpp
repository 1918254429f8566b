#include "keyline/exchange/json/json_text.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace keyline::exchange {
namespace {

using testing::HasSubstr;

// RFC 8259, 4: names within an object should be unique; of those that are not, readers take one or
// the other.
TEST(JsonText, TwoMembersOfOneNameAreRefused) {
  const auto told = [](const std::string& text) {
    const auto read = parse_json(text);
    return read ? "" : read.error().path + ": " + read.error().message;
  };
  const std::string twice = "an object has two members of the name ";
  EXPECT_EQ(told("{\"a\": 1,\n \"b\": 2,\n \"a\": 1}"), "line 3: " + twice + "\"a\"");
  EXPECT_EQ(told(R"([{"a":[{"x":1,"x" : 2}]}])"), "line 1: " + twice + "\"x\"");
  EXPECT_EQ(told(R"({"a":{"b":1},"c":[],"a":2})"), "line 1: " + twice + "\"a\"");
  // the same name, written otherwise
  EXPECT_EQ(told(R"({"a":1,"\u0061":2})"), "line 1: " + twice + "\"a\"");
  EXPECT_EQ(told(R"({"\"":1,"\u0022":2})"), "line 1: " + twice + R"("\"")");
  EXPECT_EQ(told(R"({"":1,"":2})"), "line 1: " + twice + "\"\"");
}

TEST(JsonText, NamesOfOtherObjectsAndTextsAreNoSecondMembers) {
  for (const std::string text :
       {R"({"a":{"a":{"a":1}},"b":[{"a":1},{"a":2}]})", R"([{"a":1},{"a":2}])",
        R"({"a":"a","b":"\"a\":","c":"{\"a\":1,\"a\":2}","d":"\\"})", R"(["a","a"])", R"("a")",
        "\xEF\xBB\xBF{\"a\" :1,\"A\"\t:2,\"a \"\n:3}", "{}", "[]", "1"})
    EXPECT_TRUE(parse_json(text)) << text;
}

TEST(JsonText, WhatIsNoJsonIsToldAsThat) {
  for (const std::string text : {R"({"a":1,"a":2)", R"({"a":1,"a")", "", "\"", R"({"a":"\)", "}"}) {
    const auto read = parse_json(text);
    ASSERT_FALSE(read) << text;
    EXPECT_THAT(read.error().message, HasSubstr("not JSON")) << text;
  }
}

}  // namespace
}  // namespace keyline::exchange
