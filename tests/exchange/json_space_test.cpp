#include "keyline/exchange/json/json_space.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace keyline::exchange {
namespace {

using nlohmann::json;

const lac::SpaceChain kChain{
    {{1, 2, 3}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}},
    {{-1, 0.1, 2, 1, 1.0 / 3, 0.3, 0.9}, {2, -2, 3, 1.0 / 3, 0.7, 0.9, -0.2}}};

TEST(JsonSpace, ReadsBackToTheSameDoubles) {
  const json text = json::parse(to_json(kChain).dump());
  const auto back = space_chain_from_json(text, "curve");
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(*back, kChain);
}

TEST(JsonSpace, SaysWhereAMistakeIs) {
  const auto path = [](auto change) {
    json j = to_json(kChain);
    change(j);
    const auto chain = space_chain_from_json(j, "curve");
    return chain ? std::string("fine") : chain.error().path;
  };
  EXPECT_EQ(path([](json& j) { j["type"] = "log-aesthetic"; }), "curve");
  EXPECT_EQ(path([](json& j) { j.erase("frame"); }), "curve.frame");
  EXPECT_EQ(path([](json& j) { j["frame"][1][2] = 0; }), "curve.frame");
  EXPECT_EQ(path([](json& j) { j["frame"][2] = 0; }), "curve.frame[2]");
  EXPECT_EQ(path([](json& j) { j["pieces"] = json::array(); }), "curve.pieces");
  EXPECT_EQ(path([](json& j) { j["pieces"][1]["torsion"] = {1}; }), "curve.pieces[1].torsion");
  EXPECT_EQ(path([](json& j) { j["pieces"][0]["length"] = "x"; }), "curve.pieces[0].length");
  EXPECT_EQ(path([](json& j) { j["pieces"][1]["curvature"] = {1, -1}; }), "curve.pieces[1]");
  EXPECT_EQ(path([](json&) {}), "fine");
}

}  // namespace
}  // namespace keyline::exchange
