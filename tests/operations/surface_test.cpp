#include <cmath>

#include <gtest/gtest.h>

#include "keyline/operations/operation.h"

namespace keyline::operations {
namespace {

using nlohmann::json;

json plane(double from, double to) {
  return {{"type", "bezier-surface"},
          {"points", {{{from, 0, 0}, {from, 1, 0}}, {{to, 0, 0}, {to, 1, 0}}}}};
}

json saddle() {
  return {{"type", "bezier-surface"}, {"points", {{{0, 0, 0}, {0, 1, 0}}, {{1, 0, 0}, {1, 1, 1}}}}};
}

json result_of(json request) {
  const json a = answer(request, {});
  EXPECT_TRUE(a["ok"].get<bool>()) << a.dump();
  return a.value("result", json::object());
}

json error_of(json request) {
  const json a = answer(request, {});
  EXPECT_FALSE(a["ok"].get<bool>());
  return a.value("error", json::object());
}

TEST(SurfaceOperations, InterrogateGivesAGridOfValuesAndTheirRange) {
  // z = x y: K = -1 / (1 + x^2 + y^2)^2
  const json r = result_of({{"op", "surface.interrogate"},
                            {"surface", saddle()},
                            {"kind", "gaussian"},
                            {"grid", {3, 5}}});
  EXPECT_EQ(r["values"].size(), 3U);
  EXPECT_EQ(r["values"][0].size(), 5U);
  EXPECT_NEAR(r["values"][0][0].get<double>(), -1, 1e-14);
  EXPECT_NEAR(r["values"][1][4].get<double>(), -1 / (2.25 * 2.25), 1e-14);
  EXPECT_NEAR(r["range"][0].get<double>(), -1, 1e-14);
  EXPECT_NEAR(r["range"][1].get<double>(), -1.0 / 9, 1e-14);
  const json p = result_of(
      {{"op", "surface.interrogate"}, {"surface", saddle()}, {"kind", "principal"}, {"grid", 2}});
  EXPECT_NEAR(p["values"][0][0][0].get<double>(), 1, 1e-14);
  EXPECT_NEAR(p["values"][0][0][1].get<double>(), -1, 1e-14);
  for (const char* kind : {"mean", "zebra", "isophote", "reflection", "highlight"})
    result_of({{"op", "surface.interrogate"}, {"surface", saddle()}, {"kind", kind}});
}

TEST(SurfaceOperations, ACollapsedNetHasNullsAndNoNumbersThatAreNone) {
  json point = saddle();
  for (auto& row : point["points"])
    for (auto& p : row) p = {1, 2, 3};
  const json r =
      result_of({{"op", "surface.interrogate"}, {"surface", point}, {"kind", "mean"}, {"grid", 2}});
  EXPECT_TRUE(r["values"][1][1].is_null());
  EXPECT_EQ(r["range"], json({0.0, 0.0}));
}

TEST(SurfaceOperations, InterrogateNamesTheMistake) {
  const auto path = [](const char* field, json value) {
    json request{{"op", "surface.interrogate"}, {"surface", saddle()}, {"kind", "zebra"}};
    request[field] = std::move(value);
    const json e = error_of(request);
    EXPECT_EQ(e["code"], "bad-input");
    return e.value("path", "");
  };
  EXPECT_EQ(path("kind", "stripes"), "kind");
  EXPECT_EQ(path("grid", {1, 5}), "grid");
  EXPECT_EQ(path("grid", {2.5, 5}), "grid");
  EXPECT_EQ(path("grid", {1e9, 1e9}), "grid");
  EXPECT_EQ(path("view", {0, 0, 0}), "view");
  EXPECT_EQ(path("stripe_count", -3), "stripe_count");
  EXPECT_EQ(path("surface", {{"type", "bezier"}}), "surface.type");
}

TEST(SurfaceOperations, ContinuityPassesOrFails) {
  json r = result_of({{"op", "surface.continuity"}, {"surfaces", {plane(0, 1), plane(1, 2)}}});
  EXPECT_EQ(r["order"], "G3");
  EXPECT_EQ(r["edges"], json({"u1", "u0"}));
  EXPECT_EQ(r["along"].size(), 101U);
  r = result_of({{"op", "surface.continuity"}, {"surfaces", {plane(0, 1), plane(1.0005, 2)}}});
  EXPECT_EQ(r["pass"]["G0"], true);
  EXPECT_NEAR(r["gap"].get<double>(), 0.0005, 1e-12);
  r = result_of(
      {{"op", "surface.continuity"}, {"surfaces", {plane(0, 1), plane(1.0005, 2)}}, {"gap", 1e-4}});
  EXPECT_EQ(r["pass"]["G0"], false);
  EXPECT_EQ(error_of({{"op", "surface.continuity"}, {"surfaces", {plane(0, 1)}}})["path"],
            "surfaces");
  EXPECT_EQ(error_of({{"op", "surface.continuity"},
                      {"surfaces", {plane(0, 1), plane(1, 2)}},
                      {"edges", {"u1", "top"}}})["path"],
            "edges");
}

}  // namespace
}  // namespace keyline::operations
