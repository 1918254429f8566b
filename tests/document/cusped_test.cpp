#include "keyline/operations/cusped.h"

#include <cmath>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "keyline/operations/perform.h"

namespace keyline::operations {
namespace {

using nlohmann::json;

constexpr double kInfinity = HUGE_VAL;

TEST(Cusped, JetsTellTheCuspsOfAPath) {
  const lac::Chain to_cusp{{{0, 0}, 0.3}, {{2, 1, 0.5, 2}, {2, 3, 2, kInfinity}}, false};
  const lac::Chain from_cusp{{{0, 0}, 0.3}, {{3, 2, -kInfinity, -1}}, false};
  const document::Path path{{{to_cusp}, {from_cusp}}, false};
  ASSERT_EQ(cusps_of(path).size(), 2U);
  EXPECT_EQ(cusps_of(path)[0].t, 0.5);
  EXPECT_EQ(cusps_of(path)[0].sign, 1);
  EXPECT_EQ(cusps_of(path)[1].sign, -1);
  const document::Path one{{{from_cusp}}, false};
  const CuspedPath cusped(one);
  EXPECT_EQ(curve::curvature(jet(cusped, 0)), -kInfinity);
  EXPECT_EQ(jet(cusped, 1), jet(one, 1));
}

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
  }
}

}  // namespace
}  // namespace keyline::operations
