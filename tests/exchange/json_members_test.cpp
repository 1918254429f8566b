#include "keyline/exchange/json/json_members.h"

#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "keyline/exchange/json/json_document.h"

namespace keyline::exchange {
namespace {

using nlohmann::json;

json schema() {
  std::ifstream file(KEYLINE_SOURCE_DIR "/docs/formats/document.schema.json");
  return json::parse(file)["$defs"];
}

json keys_of(const json& properties) {
  json value = json::object();
  for (const auto& [name, property] : properties.items()) value[name] = json();
  return value;
}

/// Whether the place of the value has one stray member, x, and is said to have just those fields.
void expect_fields(const json& value, const json& fields, const std::string& place) {
  const auto strays = stray_members(value, "curve");
  ASSERT_EQ(strays.size(), 1U) << value;
  EXPECT_EQ(strays[0].place, place);
  std::size_t commas = 0;
  for (const char c : strays[0].hint) commas += c == ',' ? 1 : 0;
  for (const auto& [name, property] : fields.items())
    EXPECT_TRUE(name == "type" || strays[0].hint.find(name) != std::string::npos) << name;
  const std::size_t count = fields.size() - (fields.contains("type") ? 1 : 0);
  EXPECT_EQ(commas, count < 2 ? 0 : count - 2) << strays[0].hint;
}

// Types and their fields, and those of their pieces, are the published ones.
TEST(JsonMembers, FieldsAreThoseOfTheSchema) {
  const json all = schema();
  std::size_t types = 0;
  for (const char* kind : {"curve", "surface"})
    for (const json& one : all[kind]["oneOf"]) {
      const json& fields = one["properties"];
      json value = keys_of(fields);
      value["type"] = fields["type"]["const"];
      EXPECT_TRUE(stray_members(value, "curve").empty()) << value;
      ++types;
      json stray = value;
      stray["xxxxx"] = 1;
      expect_fields(stray, fields, "curve");
      if (!fields.contains("pieces")) continue;
      json piece = keys_of(fields["pieces"]["items"]["properties"]);
      value["pieces"] = json::array({piece});
      EXPECT_TRUE(stray_members(value, "curve").empty()) << value;
      piece["xxxxx"] = 1;
      value["pieces"].push_back(piece);
      expect_fields(value, fields["pieces"]["items"]["properties"], "curve.pieces[1]");
    }
  EXPECT_EQ(types, 8U);
}

std::vector<std::string> told(const std::string& text) {
  const auto document = read_json(text);
  if (!document) return {document.error().message + " " + document.error().path};
  return document->skipped;
}

const std::string kLine = R"("type":"bezier","points":[[0,0],[1,2]])";

// Documents are read all the same; what is said names the place and the field that was meant.
TEST(JsonMembers, DocumentsTellWhatNothingReads) {
  using Lines = std::vector<std::string>;
  EXPECT_EQ(told("{" + kLine + R"(,"name":"n","layer":"l","color":"#000000","unit":"mm"})"),
            Lines{});
  EXPECT_EQ(told("{" + kLine + R"(,"weihgts":[1,2]})"),
            Lines{R"("weihgts" is not a field of a bezier; did you mean "weights"?)"});
  EXPECT_EQ(told("{" + kLine + R"(,"closed":true})")[0].substr(0, 55),
            R"("closed" is not a field of a bezier; a path says so: {")");
  EXPECT_TRUE(told("{" + kLine + R"(,"closed":false})").empty());  // which is what a bezier is
  EXPECT_EQ(
      told(R"({"uint":"mm","curves":[{"nmae":"a","curve":{)" + kLine + R"(}}]})"),
      (Lines{R"("uint" is not a field of a document; did you mean "unit"?)",
             R"(curves[0]: "nmae" is not a field of an entry of a curve; did you mean "name"?)"}));
  EXPECT_EQ(told("[{" + kLine + R"(,"id":1},{)" + kLine + R"(,"id":2}])"),
            Lines{R"([0]: "id" is not a field of a bezier; it has points and weights (2 times))"});
  EXPECT_EQ(told(R"({"type":"path","curves":[{)" + kLine + R"(,"name":"n"}]})"),
            Lines{R"(curves[0]: "name" is not a field of a bezier; it has points and weights)"});
}

// The answer of an operation has fields of its own; a slip beside its curve is told.
TEST(JsonMembers, AnswersAreRead) {
  EXPECT_TRUE(told(R"({"deviation":{"max":1},"notes":[],"curve":{)" + kLine + "}}").empty());
  EXPECT_TRUE(told(R"({"curve":{"deviation":0.1,)" + kLine + "}}").empty());
  EXPECT_EQ(told(R"({"uint":"mm","curve":{)" + kLine + "}}").size(), 1U);
}

// What a document says around a value may stand in it.
TEST(JsonMembers, ValuesByThemselvesCarryWhatEntriesDo) {
  const auto line = read_json("{" + kLine + R"(,"stroke_width":2})");
  ASSERT_TRUE(line);
  EXPECT_EQ(line->paths[0].stroke_width, 2);
  const auto patch = read_json(
      R"([{"type":"bezier-surface","points":[[[0,0,0],[1,0,0]],[[0,1,0],[1,1,1]]],"trims":3}])");
  ASSERT_TRUE(patch);
  EXPECT_EQ(patch->surfaces[0].trims, 3);
}

TEST(JsonDocument, UnitsMayBeWords) {
  const auto unit = [](const char* given) {
    const auto read = read_json("{" + kLine + R"(,"unit":")" + given + "\"}");
    return read ? read->unit : read.error().message;
  };
  EXPECT_EQ(unit("Inches"), "in");
  EXPECT_EQ(unit("MM"), "mm");
  EXPECT_EQ(unit("furlong"), "furlong");
}

}  // namespace
}  // namespace keyline::exchange
