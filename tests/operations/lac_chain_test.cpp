#include <cmath>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "keyline/exchange/json/json_curve.h"
#include "keyline/exchange/json/json_space.h"
#include "keyline/operations/perform.h"

namespace keyline::operations {
namespace {

using nlohmann::json;

json asked(const json& request) { return json::parse(answer_line(request.dump(), {})); }

document::Path path_of_result(const json& answer) {
  return exchange::path_from_json(answer["result"]["curve"], "curve").value();
}

TEST(LacSpline, PassesItsPointsAndReportsOverriddenSlopes) {
  const json points = {{0, 0}, {1, 1}, {2, 0.2}, {3, -0.8}, {4, 0}};
  const json answer = asked({{"op", "lac.spline"}, {"points", points}, {"alpha", 1}});
  ASSERT_EQ(answer["ok"], true) << answer;
  EXPECT_LT(answer["result"]["report"]["deviation"].get<double>(), 1e-10);
  EXPECT_FALSE(answer["result"]["report"]["overridden"].empty());
  EXPECT_LT(distance(evaluate(path_of_result(answer), 1), {4, 0}), 1e-10);
}

TEST(LacSpline, TakesEndConditionsWithNull) {
  json request{{"op", "lac.spline"},
               {"points", {{0, 0}, {1, 0.5}, {2, 0.6}}},
               {"directions", {1.1, nullptr}}};
  const json answer = asked(request);
  ASSERT_EQ(answer["ok"], true) << answer;
  EXPECT_NEAR(answer["result"]["curve"]["direction"].get<double>(), 1.1, 1e-12);
  request["directions"] = {1.1};
  EXPECT_EQ(asked(request)["error"]["path"], "directions");
  request["directions"] = {1.1, "x"};
  EXPECT_EQ(asked(request)["error"]["path"], "directions[1]");
}

TEST(LacSpline, ClosesAndTakesASlopePerSpan) {
  json request{{"op", "lac.spline"},
               {"points", {{1, 0}, {0, 1}, {-1, 0}, {0, -1}}},
               {"alpha", {-1, 1, -2, 0.5}},
               {"closed", true}};
  const json answer = asked(request);
  ASSERT_EQ(answer["ok"], true) << answer;
  EXPECT_EQ(answer["result"]["curve"]["closed"], true);
  request["alpha"] = {1, 2, 3, 4, 5};
  EXPECT_EQ(asked(request)["error"]["path"], "alpha");
  EXPECT_EQ(asked({{"op", "lac.spline"}, {"points", {{1, 0}}}})["error"]["code"], "bad-input");
}

TEST(LacBlend, JoinsTwoLines) {
  const json first{{"type", "polyline"}, {"points", {{0, 0}, {1, 0}}}};
  const json second{{"type", "polyline"}, {"points", {{3, 1}, {3, 2}}}};
  for (const char* order : {"G1", "G2", "G3"}) {
    const json answer = asked({{"op", "lac.blend"}, {"curves", {first, second}}, {"order", order}});
    ASSERT_EQ(answer["ok"], true) << answer;
    const document::Path path = path_of_result(answer);
    EXPECT_LT(distance(evaluate(path, 0), {1, 0}), 1e-10);
    EXPECT_LT(distance(evaluate(path, 1), {3, 1}), 1e-10);
    if (std::string(order) != "G1") {
      EXPECT_NEAR(answer["result"]["curve"]["pieces"][0]["curvature"][0].get<double>(), 0, 1e-12);
    }
  }
  EXPECT_EQ(asked({{"op", "lac.blend"}, {"curves", {first}}})["error"]["path"], "curves");
  EXPECT_EQ(
      asked({{"op", "lac.blend"}, {"curves", {first, second}}, {"order", "G9"}})["error"]["path"],
      "order");
  EXPECT_EQ(
      asked({{"op", "lac.blend"}, {"curves", {first, second}}, {"at", {0, 2}}})["error"]["path"],
      "at[1]");
}

/// Close to 0 from below a piece from curvature 0 is a line that bends at its very end only; a step
/// in the power of curvature that is linear along it once led to turns of 1e43 radians.
TEST(LacBlend, JoinsTwoLinesWithSlopesCloseToZero) {
  const json first{{"type", "polyline"}, {"points", {{0.5, 0}, {1, 0}}}};
  const json second{{"type", "polyline"}, {"points", {{3, 1}, {3, 2}}}};
  for (const double alpha : {-0.1, -1e-3, -1e-4, -1e-6, -1e-8, -1e-10, -1e-12}) {
    for (const char* order : {"G1", "G2", "G3"}) {
      SCOPED_TRACE(std::to_string(alpha) + " " + order);
      const json answer = asked(
          {{"op", "lac.blend"}, {"curves", {first, second}}, {"order", order}, {"alpha", alpha}});
      ASSERT_EQ(answer["ok"], true) << answer;
      EXPECT_LT(distance(evaluate(path_of_result(answer), 1), {3, 1}), 1e-10);
      EXPECT_LT(answer["result"]["absolute_turning"].get<double>(), 1.7);
    }
  }
}

/// What cannot be drawn is refused, in no time.
TEST(LacHermite, SlopesCloseToZeroAndOneHaveAnAnswer) {
  int drawn = 0;
  for (const double near : {1e-12, 1e-8, 1e-4, 1e-2}) {
    for (const double alpha : {-near, near, 1 - near, 1 + near}) {
      for (const auto& curvatures : {json{0, 0}, json{1, 2}, json{-1, 1}, json{30, 30}}) {
        const json answer = asked({{"op", "lac.hermite"},
                                   {"start", {0, 0}},
                                   {"end", {3, 1}},
                                   {"directions", {-0.8, 0.9}},
                                   {"curvatures", curvatures},
                                   {"samples", 5},
                                   {"alpha", alpha}});
        if (answer["ok"] != true) {
          EXPECT_EQ(answer["error"]["code"], "undrawable") << answer;
          continue;
        }
        ++drawn;
        const json& line = answer["result"]["polyline"]["points"];
        EXPECT_NEAR(line.front()[0], 0, 1e-12);
        EXPECT_NEAR(line.back()[0], 3, 1e-8);
        EXPECT_NEAR(line.back()[1], 1, 1e-8);
      }
    }
  }
}

TEST(LacVolume, GivesTheAreaOrTheNearest) {
  json request{{"op", "lac.volume"},
               {"points", {{0, 0}, {2, 0}}},
               {"direction", 0.6},
               {"alpha", -1},
               {"volume", 0.4}};
  const json answer = asked(request);
  ASSERT_EQ(answer["ok"], true) << answer;
  EXPECT_NEAR(answer["result"]["volume"].get<double>(), 0.4, 1e-10);
  request["volume"] = 1e6;
  const json far = asked(request);
  EXPECT_EQ(far["error"]["code"], "undrawable");
  EXPECT_FALSE(far["error"]["hint"].get<std::string>().empty());
  request["volume"] = -1;
  EXPECT_EQ(asked(request)["error"]["code"], "bad-input");
}

TEST(LacQuasi, DrawsEveryFormFromHandlesAndStandardForm) {
  for (const char* form :
       {"taylor-angle", "taylor-arc", "discrete-angle", "discrete-arc", "rational-cubic", "best"}) {
    SCOPED_TRACE(form);
    const json from_handles = asked({{"op", "lac.quasi"},
                                     {"points", {{0, 0}, {2, 0}, {3, 1.5}}},
                                     {"alpha", -1},
                                     {"form", form}});
    ASSERT_EQ(from_handles["ok"], true) << from_handles;
    const json& result = from_handles["result"];
    EXPECT_EQ(result["curve"]["type"], "bezier");
    EXPECT_EQ(result["form"], form);
    EXPECT_LT(distance(evaluate(path_of_result(from_handles), 1), {3, 1.5}), 1e-12);
    EXPECT_LT(result["deviation"].get<double>(), 0.1);
    const json standard = asked(
        {{"op", "lac.quasi"}, {"alpha", 2}, {"lambda", 0.4}, {"interval", {0, 1}}, {"form", form}});
    EXPECT_EQ(standard["ok"], true) << standard;
  }
}

/// A chord near its limit at a slope close to 1: the sharp end has a curvature of 1e9 per length.
TEST(LacQuasi, TheBestFormOfANeedlePointIsClose) {
  const json answer = asked({{"op", "lac.quasi"},
                             {"points", {{0, 0}, {2, 0}, {2.1, 0.2}}},
                             {"alpha", 0.999999999999},
                             {"form", "best"}});
  ASSERT_EQ(answer["ok"], true) << answer;
  EXPECT_LT(answer["result"]["deviation"], 1e-8);
}

TEST(LacQuasi, ChoosesThePlaceAndRefusesNonsense) {
  const auto path = [](const json& changes) {
    json request{{"op", "lac.quasi"}, {"points", {{0, 0}, {2, 0}, {3, 1.5}}}, {"alpha", -1}};
    request.update(changes);
    const json answer = asked(request);
    return answer["ok"] == true ? std::string("drawn")
                                : answer["error"].value("path", std::string("?"));
  };
  EXPECT_EQ(path({{"about", "auto"}}), "drawn");
  EXPECT_EQ(path({{"about", 0.5}}), "drawn");
  EXPECT_EQ(path({{"about", 2}}), "about");
  EXPECT_EQ(path({{"about", "middle"}}), "about");
  EXPECT_EQ(path({{"degree", 2}}), "degree");
  EXPECT_EQ(path({{"degree", 31}}), "degree");
  EXPECT_EQ(path({{"form", "spiral"}}), "form");
  EXPECT_EQ(path({{"lambda", 1}}), "points");
  EXPECT_NE(path({{"degree", 4}, {"form", "best"}}), "drawn");
}

TEST(LacSpace, MeetsItsDataAndConverts) {
  const json request{{"op", "lac.space"},
                     {"start", {0, 0, 0}},
                     {"end", {3, 1, 0.5}},
                     {"tangents", {{1, 0, 0}, {1, 1, 0.6}}},
                     {"alpha", -1},
                     {"beta", -1},
                     {"omega", 0.1},
                     {"samples", 5},
                     {"bezier", {{"tolerance", 1e-6}}},
                     {"nurbs", {{"tolerance", 1e-4}}}};
  const json answer = asked(request);
  ASSERT_EQ(answer["ok"], true) << answer;
  const json& result = answer["result"];
  const auto chain = exchange::space_chain_from_json(result["curve"], "curve");
  ASSERT_TRUE(chain);
  const lac::SpaceFrame end = frame_at(*chain, 1);
  EXPECT_LT(distance(end.position, {3, 1, 0.5}), 1e-11);
  EXPECT_LT(norm(cross(end.tangent, {1, 1, 0.6})), 1e-11);
  EXPECT_NEAR(result["slopes"]["curvature"].get<double>(), -1, 1e-9);
  EXPECT_EQ(result["polyline"]["points"].size(), 5U);
  EXPECT_LE(result["bezier"]["deviation"].get<double>(), 1e-6);
  EXPECT_LE(result["nurbs"]["deviation"].get<double>(), 1e-4);
}

TEST(LacSpace, SaysWhatIsWrong) {
  json request{{"op", "lac.space"}, {"start", {0, 0, 0}},
               {"end", {0, 0, 0}},  {"tangents", {{1, 0, 0}, {1, 1, 1}}},
               {"alpha", -1},       {"beta", -1},
               {"omega", 0}};
  EXPECT_EQ(asked(request)["error"]["path"], "end");
  request["end"] = {1, 0, "x"};
  EXPECT_EQ(asked(request)["error"]["path"], "end[2]");
  request["end"] = {1, 0, 0};
  request["tangents"] = {{1, 0, 0}};
  EXPECT_EQ(asked(request)["error"]["path"], "tangents");
}

}  // namespace
}  // namespace keyline::operations
