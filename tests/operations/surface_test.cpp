#include <cmath>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "keyline/operations/perform.h"
#include "keyline/surface/conditions.h"

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

TEST(SurfaceOperations, InterrogateGivesNormalsWhereAskedFor) {
  // z = x y: the normal is along (-y, -x, 1)
  const json r = result_of({{"op", "surface.interrogate"},
                            {"surface", saddle()},
                            {"kind", "mean"},
                            {"grid", {3, 5}},
                            {"normals", true}});
  EXPECT_FALSE(r.contains("points"));
  const json& normal = r["normals"][2][1];  // at x = 1, y = 1/4
  const double length = std::sqrt(1 + 1 + 1.0 / 16);
  EXPECT_NEAR(normal[0].get<double>(), -0.25 / length, 1e-14);
  EXPECT_NEAR(normal[1].get<double>(), -1 / length, 1e-14);
  EXPECT_NEAR(normal[2].get<double>(), 1 / length, 1e-14);
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
  EXPECT_EQ(path("grid", {1, 5}), "grid[0]");
  EXPECT_EQ(path("grid", {2.5, 5}), "grid[0]");
  EXPECT_EQ(path("grid", {1e9, 1e9}), "grid[0]");
  EXPECT_EQ(path("view", {0, 0, 0}), "view");
  EXPECT_EQ(path("stripe_count", -3), "stripe_count");
  EXPECT_EQ(path("surface", {{"type", "bezier"}}), "surface.type");
}

TEST(SurfaceOperations, ContinuityPassesOrFails) {
  json r = result_of({{"op", "surface.continuity"}, {"surfaces", {plane(0, 1), plane(1, 2)}}});
  EXPECT_EQ(r["order"], "G3");
  EXPECT_EQ(r["edges"], json({"u1", "u0"}));
  EXPECT_EQ(r["along"].size(), 101U);
  EXPECT_EQ(r["stripe_turn"], 0);
  EXPECT_EQ(r["turning"], 0);  // no stripe crosses a line on which the normal stands still
  r = result_of({{"op", "surface.continuity"}, {"surfaces", {plane(0, 1), plane(1.0005, 2)}}});
  EXPECT_EQ(r["pass"]["G0"], false);  // 5e-4 of a size of about 1.4
  EXPECT_LT(r["tolerance"]["gap"].get<double>(), 1e-4);
  r = result_of(
      {{"op", "surface.continuity"}, {"surfaces", {plane(0, 1), plane(1.0005, 2)}}, {"gap", 1e-3}});
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
            "edges[1]");
}

json bicubic(double distortion) {
  json rows = json::array();
  for (int i = 0; i < 4; ++i) {
    json row = json::array();
    for (int j = 0; j < 4; ++j) {
      const double a = 1.7 * i + 2.9 * j;
      row.push_back({100.0 * i + distortion * std::sin(a), 70.0 * j + distortion * std::cos(a),
                     4.0 * i * i + 5.0 * j * j + distortion * std::sin(2.1 * a)});
    }
    rows.push_back(std::move(row));
  }
  return {{"type", "bezier-surface"}, {"points", rows}};
}

TEST(SurfaceOperations, SavNamesItsCurvesAndTheWorst) {
  const json r = result_of({{"op", "surface.sav"}, {"surface", bicubic(5)}});
  ASSERT_EQ(r["curves"].size(), 8U);
  EXPECT_EQ(r["curves"][0]["name"], "A1");
  double sum = 0;
  for (const json& c : r["curves"]) sum += c["cav"].get<double>();
  EXPECT_NEAR(r["sav"].get<double>(), sum, 1e-9);
  EXPECT_TRUE(r["worst"].is_string());
  double beside = 0;
  for (const json& c : r["curves"]) {
    ASSERT_GT(c["type"].get<int>(), 3);
    EXPECT_GT(c["nearest"]["distance"].get<double>(), 0);
    EXPECT_EQ(c["nearest"]["curve"]["points"].size(), 4U);
    beside += c["nearest"]["cav"].get<double>();
  }
  EXPECT_NEAR(r["nearest_sav"].get<double>(), beside, 1e-9);
  const json plain =
      result_of({{"op", "surface.sav"}, {"surface", bicubic(5)}, {"nearest", false}});
  EXPECT_FALSE(plain["curves"][0].contains("nearest"));
  EXPECT_EQ(error_of({{"op", "surface.sav"}, {"surface", bicubic(5)}, {"alpha_max", 1.6}})["path"],
            "alpha_max");
  json rational = saddle();
  rational["weights"] = {{1, 1}, {1, 2}};
  EXPECT_EQ(error_of({{"op", "surface.sav"}, {"surface", rational}})["code"], "unsupported");
}

TEST(SurfaceOperations, SavOfASplineGoesByPatch) {
  const json spline{{"type", "bspline-surface"},
                    {"degree", {1, 2}},
                    {"knots", {{0, 0, 1, 2, 2}, {0, 0, 0, 1, 1, 1}}},
                    {"points",
                     {{{0, 0, 0}, {0, 1, 0.1}, {0, 2, 0.5}},
                      {{1, 0, 0}, {1, 1, 0.1}, {1, 2, 0.5}},
                      {{2, 0, 1}, {2, 1, 1.1}, {2, 2, 1.5}}}}};
  const json r = result_of({{"op", "surface.sav"}, {"surface", spline}});
  ASSERT_EQ(r["patches"].size(), 2U);
  EXPECT_EQ(r["curves"].size(), 10U);
  EXPECT_EQ(r["curves"][9]["patch"], json({1, 0}));
}

TEST(SurfaceOperations, EditBringsSavDownAndSaysByHowMuchItDeparts) {
  const json r = result_of({{"op", "surface.edit"}, {"surface", bicubic(5)}});
  EXPECT_TRUE(r["limit"].is_null());
  EXPECT_GT(r["before"]["sav"].get<double>(), 100);
  EXPECT_LT(r["after"]["sav"].get<double>(), 1e-5);
  EXPECT_GT(r["departure"].get<double>(), 0);
  EXPECT_GE(r["tradeoff"].size(), 3U);
  const json again = result_of({{"op", "surface.sav"}, {"surface", r["surface"]}});
  EXPECT_LE(again["sav"].get<double>(), 1);
  EXPECT_EQ(error_of({{"op", "surface.edit"}, {"surface", bicubic(5)}, {"keep", "all"}})["path"],
            "keep");
}

/// Diagonal of the box around a net.
double diagonal(const json& surface) {
  std::array<double, 3> low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  for (const json& row : surface["points"])
    for (const json& p : row)
      for (std::size_t i = 0; i < 3; ++i) {
        low[i] = std::min(low[i], p[i].get<double>());
        high[i] = std::max(high[i], p[i].get<double>());
      }
  return std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
}

TEST(SurfaceOperations, SeveralPatchesGoNoFartherThanAHundredthUnasked) {
  const json patch = bicubic(5);
  const json wild = bicubic(14);
  const auto both = [&](json limit) {
    json request{{"op", "surface.edit_together"}, {"surfaces", {patch, wild}}};
    if (!limit.is_null()) request["limit"] = std::move(limit);
    return result_of(request)["surfaces"];
  };
  json all{{"points", patch["points"]}};
  for (const json& row : wild["points"]) all["points"].push_back(row);
  const double most = 0.01 * diagonal(all);
  const json unasked = both(nullptr);
  for (const json& one : unasked) {
    EXPECT_NEAR(one["edit"]["limit"].get<double>(), most, 1e-12 * most);
    EXPECT_LE(one["edit"]["departure"].get<double>(), most);
  }
  EXPECT_GT(unasked[0]["edit"]["tradeoff"].back()["departure"].get<double>(), most);  // still told
  // What is farther off than that stays; of a length that is given all is used.
  EXPECT_EQ(unasked[1]["edit"]["departure"], 0);
  EXPECT_EQ(unasked[1]["edit"]["surface"], wild);
  const json given = both(most);
  EXPECT_GT(given[1]["edit"]["departure"].get<double>(), 0.9 * most);
  EXPECT_LE(given[1]["edit"]["departure"].get<double>(), most);
  EXPECT_GT(both("none")[1]["edit"]["departure"].get<double>(), most);
  EXPECT_EQ(error_of({{"op", "surface.edit"}, {"surface", patch}, {"limit", "far"}})["path"],
            "limit");
}

// A patch without any Class A net beside one with: joints let go of cost nothing.
TEST(SurfaceOperations, JointsLetGoOfHaveNoPrice) {
  json rows = bicubic(200)["points"];
  const json more = bicubic(5)["points"];
  for (std::size_t i = 1; i < more.size(); ++i) {
    rows.push_back(more[i]);
    for (json& p : rows.back()) p[0] = p[0].get<double>() + 300;
  }
  const json spline{{"type", "bspline-surface"},
                    {"degree", {3, 3}},
                    {"knots", {{0, 0, 0, 0, 1, 1, 1, 2, 2, 2, 2}, {0, 0, 0, 0, 1, 1, 1, 1}}},
                    {"points", rows}};
  const json r =
      result_of({{"op", "surface.edit_together"}, {"surfaces", {spline}}, {"joints", "free"}});
  const json& edit = r["surfaces"][0]["edit"];
  EXPECT_TRUE(edit["patch_edits"][0].contains("why"));
  EXPECT_FALSE(edit.contains("sav_apart"));
}

TEST(SurfaceOperations, ASinglePatchGoesToItsTarget) {
  const json wild = bicubic(14);
  const json r = result_of({{"op", "surface.edit"}, {"surface", wild}});
  EXPECT_TRUE(r["limit"].is_null());
  EXPECT_GT(r["departure"].get<double>(), 0.01 * diagonal(wild));
  EXPECT_LT(r["after"]["sav"].get<double>(), 1e-3 * r["before"]["sav"].get<double>());
}

TEST(SurfaceOperations, EditOfASplineGoesByPatch) {
  json rows = json::array();
  for (int i = 0; i < 5; ++i) {
    json row = json::array();
    for (int j = 0; j < 4; ++j)
      row.push_back({100.0 * i, 70.0 * j, 4.0 * i * i + 5.0 * j * j + 3 * std::sin(2.0 * i + j)});
    rows.push_back(std::move(row));
  }
  const json spline{{"type", "bspline-surface"},
                    {"degree", {3, 3}},
                    {"knots", {{0, 0, 0, 0, 1, 2, 2, 2, 2}, {0, 0, 0, 0, 1, 1, 1, 1}}},
                    {"points", rows}};
  const json r = result_of({{"op", "surface.edit"}, {"surface", spline}});
  EXPECT_EQ(r["surface"]["type"], "bspline-surface");  // boundaries are kept unless told otherwise
  ASSERT_EQ(r["patch_edits"].size(), 2U);
  EXPECT_LE(r["after"]["sav"].get<double>(), r["before"]["sav"].get<double>());
  EXPECT_EQ(r["joints"]["before"]["G1"], 1);
  EXPECT_EQ(r["joints"]["after"]["G1"], 1);
  for (const char* when : {"before", "after"}) {  // a tangent joint: stripes meet, but may turn
    const json& zebra = r["joints"][when]["zebra"];
    EXPECT_LT(zebra["jump"].get<double>(), 1e-6);
    EXPECT_LE(zebra["mean_turn"].get<double>(), zebra["turn"].get<double>());
  }
  EXPECT_LT(r["joints"]["before"]["zebra"]["turn"].get<double>(), 1e-9);  // a spline's is smooth
  EXPECT_LT(r["joints"]["fold_growth"].get<double>(), 1e-6);
  // the joint wins over what each patch by itself would like
  const json loose = result_of({{"op", "surface.edit"}, {"surface", spline}, {"keep", "start"}});
  EXPECT_EQ(loose["surface"]["type"], "bspline-surface");
  EXPECT_EQ(loose["joints"]["after"]["G1"], 1);
}

TEST(SurfaceOperations, EditTakesConditionsPerCurve) {
  json request{{"op", "surface.edit"}, {"surface", bicubic(5)}};
  request["conditions"] = {{{"curve", "A1"}, {"s", {1.2, 1.3}}}, {{"alpha", {0.0, 1.0}}}};
  const json r = result_of(request);
  EXPECT_LE(r["after"]["curves"][0]["s"].get<double>(), 1.3 + 1e-6);
  EXPECT_TRUE(r["missed"].is_array());
  const auto path = [&](json conditions) {
    request["conditions"] = std::move(conditions);
    return error_of(request).value("path", "");
  };
  EXPECT_EQ(path(3), "conditions");
  EXPECT_EQ(path(json::array({3})), "conditions[0]");
  EXPECT_EQ(path({{{"s", {1, 2, 3}}}}), "conditions[0].s");
  EXPECT_EQ(path({{{"s", {1, "x"}}}}), "conditions[0].s[1]");
  EXPECT_EQ(path({{{"branch", "up"}}}), "conditions[0].branch");
  EXPECT_EQ(path({{{"colour", "red"}}}), "conditions[0].colour");
  EXPECT_EQ(path({{{"curve", "A77"}}}), "conditions[0].curve");
}

TEST(SurfaceOperations, ConditionsOfTheCommandLine) {
  using surface::CurveCondition;
  const auto read =
      CurveCondition::from_text("A1:s=1.1..1.4,alpha=0.2,end=0.1,branch=falling,tangent=kept");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->curve, "A1");
  EXPECT_EQ(read->s, (core::Interval{1.1, 1.4}));
  EXPECT_EQ(read->alpha, (core::Interval{0.2, 0.2}));
  EXPECT_EQ(read->end_tolerance, 0.1);
  EXPECT_EQ(read->branch, classa::Branch::falling);
  EXPECT_EQ(read->tangent, true);
  EXPECT_EQ(CurveCondition::from_text("s=1.3")->curve, "");
  for (const char* text :
       {"", "A1:", "s=1..2..3", "A1", "s=", "s=a..b", "tangent=1", "s=1..inf", "x=1"})
    EXPECT_FALSE(CurveCondition::from_text(text)) << text;
}

TEST(SurfaceOperations, NetworksTellTheirJointsAndZebra) {
  // arches along x at y = 0, 1.5 and 3, and along y at both ends, whose middles (z = 0.45) the one
  // at y = 1.5 stands on
  const auto arch = [](bool along_x, double at, double height, double up) {
    json points = json::array();
    for (int i = 0; i < 4; ++i) {
      const double z = height * i * (3 - i) / 2.0 + up;
      points.push_back(along_x ? json{1.0 * i, at, z} : json{at, 1.0 * i, z});
    }
    return json{{"type", "bezier"}, {"points", points}};
  };
  const json u = {arch(true, 0, 0.4, 0), arch(true, 1.5, 0.6, 0.45), arch(true, 3, 0.4, 0)};
  const json v = {arch(false, 0, 0.6, 0), arch(false, 3, 0.6, 0)};
  const json r =
      result_of({{"op", "surface.network"}, {"along_u", u}, {"along_v", v}, {"gap", 1e-3}});
  const json& joints = r["joints"];
  EXPECT_GE(joints["joints"], 1);
  EXPECT_EQ(joints["G2"], joints["joints"]);
  EXPECT_LT(joints["zebra"]["jump"].get<double>(), 1e-9);
  EXPECT_LT(joints["zebra"]["turn"].get<double>(), 1e-6);
}

}  // namespace
}  // namespace keyline::operations
