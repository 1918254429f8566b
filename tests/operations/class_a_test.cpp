#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "keyline/operations/perform.h"

namespace keyline::operations {
namespace {

using nlohmann::json;

json perform_well(const char* name, const json& request) {
  const auto result = perform(name, request, {});
  EXPECT_TRUE(result) << (result ? "" : result.error().message);
  return result ? *result : json{};
}

std::string code_of(const char* name, const json& request) {
  json full = request;
  full["op"] = name;
  const json reply = answer(full, {});
  return reply["ok"] == true ? "ok" : reply["error"]["code"].get<std::string>();
}

const json kOya{
    {"alpha", 0.7853981633974483}, {"s", 1.05}, {"tangent", {1, 2}}, {"end_tolerance", 0.01}};

TEST(CurveCav, ExampleOfThePaper) {
  const json result = perform_well("curve.cav", kOya);
  EXPECT_EQ(result["type"], 3);
  EXPECT_NEAR(result["minimum"]["alpha"].get<double>(), 0.6474, 5e-5);
  EXPECT_NEAR(result["minimum"]["s"].get<double>(), 1.4404, 5e-5);
  EXPECT_NEAR(result["minimum"]["beta"].get<double>(), 0.6435, 5e-5);
  EXPECT_NEAR(result["energy"].get<double>(), 0.3925, 5e-5);
  EXPECT_NEAR(result["minimum"]["energy"].get<double>(), 0.3287, 5e-5);
}

TEST(CurveCav, FreeFormCurves) {
  const json log_aesthetic{{"type", "log-aesthetic"},
                           {"start", {0, 0}},
                           {"direction", 0.3},
                           {"pieces", {{{"alpha", 1}, {"length", 4}, {"curvature", {0.2, 0.6}}}}}};
  const json result = perform_well("curve.cav", {{"curve", log_aesthetic}});
  EXPECT_GE(result["type"].get<int>(), 4);
  EXPECT_LE(result["approximation"]["deviation"].get<double>(),
            result["approximation"]["tolerance"].get<double>());
  EXPECT_GE(result["approximation"]["degree"].get<int>(), 3);
  EXPECT_LE(result["nearest"]["distance"].get<double>(), 0.05);
  EXPECT_TRUE(result["nearest"]["cav"].is_number());
  EXPECT_TRUE(result["alpha"].is_null());
  EXPECT_EQ(result["approximation"]["given_monotone"], "yes");
}

TEST(CurveCav, InSpace) {
  const json matrix{{1.04, -0.7, -2.8}, {0.99, 4.89, -1.15}, {2.73, -0.04, 3.44}};
  const json result =
      perform_well("curve.cav", {{"matrix", matrix}, {"tangent", {-0.99, 0.09, 0.09}}});
  EXPECT_EQ(result["type"], 5);
  EXPECT_EQ(result["farin"]["singular_values"], true);
  EXPECT_EQ(result["farin"]["expands"], true);
  EXPECT_EQ(result["monotone"], "no");
  const json tilted{{"type", "bezier"}, {"points", {{0, 0, 0}, {1, 0, 1}, {2, 1, 2}}}};
  EXPECT_EQ(perform_well("curve.cav", {{"curve", tilted}})["type"], 2);
}

TEST(CurveEdit, SlidesToTheMinimum) {
  json request = kOya;
  const json whole = perform_well("curve.edit", request);
  EXPECT_EQ(whole["after"]["type"], 1);
  EXPECT_EQ(whole["after"]["cav"], 0);
  request["amount"] = 0;
  const json none = perform_well("curve.edit", request);
  EXPECT_EQ(none["curve"]["points"][1], (json{1.0, 2.0}));
  EXPECT_EQ(none["after"]["cav"], none["before"]["cav"]);
  request["amount"] = 1;
  request["target"] = {{"alpha", 0.7}, {"s", 1.4}};
  request["hold"] = "ends";
  EXPECT_NEAR(perform_well("curve.edit", request)["after"]["s"].get<double>(), 1.4, 1e-9);
}

TEST(CurveEdit, InSpace) {
  const json tilted{{"type", "bezier"}, {"points", {{0, 0, 0}, {1, 0, 1}, {2, 1, 2}, {2, 3, 2}}}};
  const json edited = perform_well("curve.edit", {{"curve", tilted}, {"end_tolerance", 0}});
  EXPECT_EQ(edited["after"]["type"], 1);
  EXPECT_EQ(edited["curve"]["points"][3].size(), 3U);
  json twisted = tilted;
  twisted["points"][3][2] = 1;
  EXPECT_EQ(code_of("curve.edit", {{"curve", twisted}}), "unsupported");
}

TEST(CurveCav, RangesOfTheMinimum) {
  json request = kOya;
  request["alpha_range"] = {0.0, 0.6};
  EXPECT_LE(perform_well("curve.cav", request)["minimum"]["alpha"].get<double>(), 0.6);
  request = kOya;
  request["s_range"] = {1.0, 1.42};
  EXPECT_LE(perform_well("curve.cav", request)["minimum"]["s"].get<double>(), 1.42 + 1e-9);
  request = kOya;
  request["branch"] = "falling";  // too far round for a cubic whose edges shrink
  EXPECT_EQ(code_of("curve.cav", request), "undrawable");
  request["degree"] = 6;
  request["alpha"] = 0.3;
  EXPECT_LE(perform_well("curve.cav", request)["minimum"]["s"].get<double>(), 1);
}

TEST(CurveEdit, GivesTheOtherForms) {
  json request = kOya;
  request["samples"] = 5;
  EXPECT_EQ(perform_well("curve.edit", request)["polyline"]["points"].size(), 5U);
}

TEST(CurveCav, BadInput) {
  const auto with = [](const char* name, const json& value) {
    json request = kOya;
    request[name] = value;
    return code_of("curve.cav", request);
  };
  EXPECT_EQ(with("alpha_max", 1.58), "bad-input");
  EXPECT_EQ(with("alpha_max", 0), "bad-input");
  EXPECT_EQ(with("tangent", {0, 0}), "bad-input");
  EXPECT_EQ(with("tangent", "x"), "bad-input");
  EXPECT_EQ(with("degree", 31), "bad-input");
  EXPECT_EQ(with("degree", 1), "ok");
  EXPECT_EQ(with("degree", 15), "ok");
  EXPECT_EQ(with("s", 0), "bad-input");
  EXPECT_EQ(with("s", nullptr), "bad-input");
  EXPECT_EQ(with("direction", "up"), "bad-input");
  EXPECT_EQ(with("branch", "up"), "bad-input");
  EXPECT_EQ(with("alpha_range", {0.5, 0.2}), "bad-input");
  EXPECT_EQ(with("alpha_range", {0.0, 0.1}), "undrawable");
  EXPECT_EQ(with("matrix", {1, 2}), "bad-input");
  EXPECT_EQ(code_of("curve.cav", json::object()), "bad-input");
  const json point{{"type", "bezier"}, {"points", {{1, 1}, {1, 1}, {1, 1}}}};
  EXPECT_EQ(code_of("curve.cav", {{"curve", point}}), "bad-input");
  const json closed{{"type", "bezier"}, {"points", {{0, 0}, {1, 0}, {1, 1}, {0, 0}}}};
  EXPECT_EQ(code_of("curve.cav", {{"curve", closed}}), "ok");  // type 5; says why no minimum
  EXPECT_EQ(code_of("curve.edit", {{"curve", closed}}), "undrawable");
}

}  // namespace
}  // namespace keyline::operations
