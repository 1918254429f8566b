#include <cmath>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "keyline/operations/perform.h"

namespace keyline::operations {
namespace {

using nlohmann::json;

// Slope 2 from radius 0 to 3: the curvature falls all along, to 1/3; reversed it rises.
TEST(CurveAnalyze, CurvatureHasNoBoundAtACusp) {
  for (const bool back : {false, true}) {
    const json curve = {
        {"type", "log-aesthetic"},
        {"start", {0, 0}},
        {"direction", 0},
        {"pieces", {{{"alpha", 2}, {"length", 4}, {"radius", back ? json{-3, 0} : json{0, 3}}}}}};
    const auto r = perform("curve.analyze", {{"curve", curve}}, {});
    ASSERT_TRUE(r) << r.error().message;
    const json& curvature = (*r)["curvature"];
    EXPECT_TRUE(curvature[back ? "min" : "max"].is_null());
    EXPECT_NEAR(curvature[back ? "max" : "min"].get<double>(), back ? -1 / 3.0 : 1 / 3.0, 1e-12);
    EXPECT_EQ((*r)["extrema"].size(), 0U);
    EXPECT_EQ((*r)["pieces"].size(), 1U);
    for (const json& place : curvature["plot"]) EXPECT_NE(place[1], 0);
    EXPECT_TRUE((*r)["pieces"][0]["curvature"][back ? 1 : 0].is_null());
    EXPECT_TRUE((*r)["comb"]["energy"].is_null());
    EXPECT_TRUE((*r)["comb"]["jolt"].is_null());
  }
}

json analyzed(const json& points) {
  const auto r =
      perform("curve.analyze", {{"curve", {{"type", "bezier"}, {"points", points}}}}, {});
  EXPECT_TRUE(r) << r.error().message;
  return r.value_or(json());
}

// Least curvature of the cubic lies at t = 0.4606553370833689 (mpmath, the root of the rate), of
// that whose handle has length 1e-9 at the same to 1e-9.
TEST(CurveAnalyze, HandlesDrawnInAreCusps) {
  constexpr double kLeast = 0.4606553370833689;
  const json drawn_in = analyzed({{0, 0}, {0, 0}, {2, 1}, {3, 3}});
  const json back = analyzed({{3, 3}, {2, 1}, {0, 0}, {0, 0}});
  const json nearly = analyzed({{0, 0}, {1e-9, 0}, {2, 1}, {3, 3}});
  for (const json* r : {&drawn_in, &back, &nearly}) {
    ASSERT_EQ((*r)["extrema"].size(), 1U) << r->dump();
    const double t = (*r)["extrema"][0]["t"];
    EXPECT_NEAR(r == &back ? 1 - t : t, kLeast, 1e-8);
    EXPECT_EQ((*r)["pieces"].size(), 2U);
    EXPECT_EQ((*r)["monotone"], "no");
  }
  EXPECT_TRUE(drawn_in["curvature"]["max"].is_null());
  EXPECT_NEAR(drawn_in["curvature"]["min"], 0.12141239964133721, 1e-12);
  EXPECT_TRUE(back["curvature"]["min"].is_null());
  EXPECT_NEAR(back["curvature"]["max"], -0.12141239964133721, 1e-12);
  EXPECT_FALSE(nearly["curvature"]["max"].is_null());
  EXPECT_TRUE(drawn_in["comb"]["energy"].is_null());
  EXPECT_TRUE(back["comb"]["energy"].is_null());
  EXPECT_EQ(drawn_in["comb"]["waves"], back["comb"]["waves"]);
  EXPECT_EQ(drawn_in["pieces"][0]["rhythm"], back["pieces"][1]["rhythm"]);
  EXPECT_NEAR(drawn_in["pieces"][0]["lcg"]["slope"], back["pieces"][1]["lcg"]["slope"], 1e-6);
}

TEST(CurveAnalyze, ACuspInsideIsACornerBetweenTwoPieces) {
  const json r = analyzed({{0, 0}, {1, 1}, {0, 1}, {1, 0}});
  ASSERT_EQ(r["corners"].size(), 1U);
  EXPECT_NEAR(r["corners"][0]["t"], 0.5, 1e-12);
  EXPECT_TRUE(r["corners"][0]["curvature"].is_null());
  EXPECT_EQ(r["extrema"].size(), 0U);
  EXPECT_EQ(r["pieces"].size(), 2U);
  EXPECT_TRUE(r["pieces"][0]["curvature"][1].is_null());
  EXPECT_TRUE(r["pieces"][1]["curvature"][0].is_null());
}

// Nothing is below a radius of 0; to the other side the curve bends away.
TEST(CurveOffset, TellsACuspWhereItsRadiusIsNone) {
  const json curve = {{"type", "bezier"}, {"points", {{0, 0}, {0, 0}, {2, 1}, {3, 3}}}};
  const auto inward = perform("curve.offset", {{"curve", curve}, {"distance", 0.1}}, {});
  ASSERT_FALSE(inward);
  EXPECT_NE(inward.error().message.find("a cusp at (0, 0)"), std::string::npos);
  EXPECT_EQ(inward.error().hint, "take the other side");
  EXPECT_TRUE(perform("curve.offset", {{"curve", curve}, {"distance", -0.1}}, {}));
}

TEST(CurveCompare, CombsHaveNoBoundAtACusp) {
  const json drawn_in = {{"type", "bezier"}, {"points", {{0, 0}, {0, 0}, {2, 1}, {3, 3}}}};
  const json other = {{"type", "bezier"}, {"points", {{0, 0}, {1, 0}, {2, 1}, {3, 3}}}};
  const auto r = perform("curve.compare", {{"curves", {drawn_in, other}}}, {});
  ASSERT_TRUE(r);
  EXPECT_TRUE((*r)["combs"][0]["curvature_max"].is_null());
  EXPECT_FALSE((*r)["combs"][1]["curvature_max"].is_null());
}

// 1/9 at the start, from the parabola y = x^2 / 18 there; no extremum beside it.
TEST(CurveAnalyze, AHandleDrawnInMayLeaveCurvatureFinite) {
  const json r = analyzed({{0, 0}, {0, 0}, {1, 0}, {2, 0}, {3, 2}});
  EXPECT_NEAR(r["pieces"][0]["curvature"][0], 1.0 / 9, 1e-12);
  EXPECT_EQ(r["extrema"].size(), 1U);
  EXPECT_FALSE(r["comb"]["energy"].is_null());
}

}  // namespace
}  // namespace keyline::operations
