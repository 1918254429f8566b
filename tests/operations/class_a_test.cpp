#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "keyline/core/point.h"
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

/// The paper's curve again: what the plane shows agrees with what editing makes of its places.
TEST(CurvePlane, ShowsWhatEditingMeets) {
  const json plane = perform_well("curve.plane", kOya);
  EXPECT_EQ(plane["value"]["type"], 3);
  EXPECT_NEAR(plane["growing"].back()[1].get<double>(), 1 / std::cos(1.0982), 1e-12);
  EXPECT_NEAR(plane["falling"].back()[1].get<double>(), std::cos(1.0982), 1e-12);
  ASSERT_GT(plane["reach"].size(), 20U);
  for (const std::size_t i : {plane["reach"].size() / 3, plane["reach"].size() / 2}) {
    json request = kOya;
    request["target"] = {{"alpha", plane["reach"][i][0]}, {"s", plane["reach"][i][1]}};
    const json edited = perform_well("curve.edit", request);
    EXPECT_NEAR(edited["target"]["s"].get<double>(), plane["reach"][i][1].get<double>(), 1e-5);
    // of a curve with these ends the energy in the plane is its own
    const json& energy = plane["energy"];
    const double rows = static_cast<double>(energy.size() - 1);
    const double s_low = plane["s"][0].get<double>();
    const double s_high = plane["s"][1].get<double>();
    const auto column =
        static_cast<std::size_t>(std::lround(plane["reach"][i][0].get<double>() / 1.0982 * rows));
    const auto row = static_cast<std::size_t>(
        std::lround((plane["reach"][i][1].get<double>() - s_low) / (s_high - s_low) * rows));
    EXPECT_NEAR(energy[row][column].get<double>(), edited["after"]["energy"].get<double>(), 0.03);
  }
  EXPECT_EQ(code_of("curve.plane", {{"curve", {{"type", "bezier"}, {"points", {{0, 0}, {1, 0}}}}}}),
            "undrawable");
  json narrow = kOya;
  narrow["show"] = {0, 1};
  EXPECT_EQ(code_of("curve.plane", narrow), "bad-input");
}

/// The paper's curve laid into a slanted plane of space has the same plane about it; with one point
/// lifted out it lies in none, and only what the ends and the start tangent say is left.
TEST(CurvePlane, ShowsACurveInSpaceInItsPlane) {
  const json flat = perform_well(
      "curve.plane",
      {{"curve", {{"type", "bezier"}, {"points", {{0, 0}, {1, 2}, {0, 4}, {-2, 5}}}}}});
  const auto laid = [](double x, double y) {  // unit axes (2, 1, 2)/3 and (-2, 2, 1)/3
    return json{(2 * x - 2 * y) / 3 + 7, (x + 2 * y) / 3 - 3, (2 * x + y) / 3 + 1};
  };
  json points{laid(0, 0), laid(1, 2), laid(0, 4), laid(-2, 5)};
  const json given{{"type", "bezier"}, {"points", points}};
  const json space = perform_well("curve.plane", {{"curve", given}});
  EXPECT_NEAR(space["value"]["cav"].get<double>(), flat["value"]["cav"].get<double>(), 1e-9);
  ASSERT_EQ(space["reach"].size(), flat["reach"].size());
  for (std::size_t i = 0; i < flat["reach"].size(); ++i)
    EXPECT_NEAR(space["reach"][i][1].get<double>(), flat["reach"][i][1].get<double>(), 1e-9);
  EXPECT_NEAR(space["energy"][40][40].get<double>(), flat["energy"][40][40].get<double>(), 1e-9);

  points[2][2] = points[2][2].get<double>() + 1;
  const json bent{{"type", "bezier"}, {"points", points}};
  const json off = perform_well("curve.plane", {{"curve", bent}});
  EXPECT_EQ(off["value"]["type"], 5);
  ASSERT_EQ(off["reach"].size(), flat["reach"].size());
  for (std::size_t i = 0; i < flat["reach"].size(); ++i)
    EXPECT_NEAR(off["reach"][i][1].get<double>(), flat["reach"][i][1].get<double>(), 1e-9);
}

/// An evenly run line: a fraction of its length is its parameter.
TEST(FitCurvature, TakesPlacesAlongTheLength) {
  json points = json::array();
  for (int i = 0; i <= 5; ++i) points.push_back({2 * i, 0.3 * (i % 2)});
  const json curve{{"type", "path"}, {"curves", {{{"type", "bezier"}, {"points", points}}}}};
  const auto driven = [&](const char* name, const std::vector<double>& places) {
    json target = json::array();
    for (const double p : places) target.push_back({{name, p}, {"curvature", 0.01}});
    return perform_well("fit.curvature",
                        {{"curve", curve}, {"target", target}, {"hold_end", true}});
  };
  // ends and middle are the same places in both, the middle by symmetry under half a turn
  const json by_t = driven("t", {0, 0.5, 1})["curve"]["curves"][0]["points"];
  const json along = driven("along", {0, 0.5, 1})["curve"]["curves"][0]["points"];
  for (std::size_t k = 0; k < 6; ++k)
    for (const std::size_t axis : {0, 1})
      EXPECT_NEAR(by_t[k][axis].get<double>(), along[k][axis].get<double>(), 1e-6);
  const auto wrong = [&](const json& place) {
    return code_of("fit.curvature", {{"curve", curve}, {"target", {place}}});
  };
  EXPECT_EQ(wrong({{"curvature", 0}}), "bad-input");
  EXPECT_EQ(wrong({{"curvature", 0}, {"t", 0.5}, {"along", 0.5}}), "bad-input");
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

TEST(CurveCav, TakesMatricesAndCurvesInSpace) {
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

TEST(CurveEdit, CurvesInSpaceKeepTheirDimensionAndStart) {
  const json tilted{{"type", "bezier"}, {"points", {{0, 0, 0}, {1, 0, 1}, {2, 1, 2}, {2, 3, 2}}}};
  const json edited = perform_well("curve.edit", {{"curve", tilted}, {"end_tolerance", 0}});
  EXPECT_EQ(edited["after"]["type"], 1);
  EXPECT_EQ(edited["curve"]["points"][3].size(), 3U);
  json twisted = tilted;
  twisted["points"][3][2] = 1;
  const json fair = perform_well("curve.edit", {{"curve", twisted}, {"end_tolerance", 0}});
  EXPECT_EQ(fair["before"]["type"], 5);
  EXPECT_EQ(fair["after"]["type"], 1);
  EXPECT_EQ(fair["curve"]["points"][0], twisted["points"][0]);
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

/// Points of a cubic by its polynomial, so many and one.
std::vector<core::Point3> along(const json& points, int n) {
  std::vector<core::Point3> all;
  for (int i = 0; i <= n; ++i) {
    const double t = 1.0 * i / n;
    const double w[] = {(1 - t) * (1 - t) * (1 - t), 3 * t * (1 - t) * (1 - t), 3 * t * t * (1 - t),
                        t * t * t};
    core::Point3 p{};
    for (std::size_t k = 0; k < 4; ++k)
      for (std::size_t c = 0; c < points[k].size(); ++c)
        (c == 0 ? p.x : c == 1 ? p.y : p.z) += w[k] * points[k][c].get<double>();
    all.push_back(p);
  }
  return all;
}

double farthest(const std::vector<core::Point3>& from, const std::vector<core::Point3>& to) {
  double far = 0;
  for (const core::Point3 p : from) {
    double least = INFINITY;
    for (const core::Point3 q : to) least = std::min(least, core::distance(p, q));
    far = std::max(far, least);
  }
  return far;
}

// Judged by points of both curves, whose nearest ones lie no farther apart than half their steps.
TEST(CurveEdit, TellsHowFarItDeparts) {
  const json planar{{"type", "bezier"}, {"points", {{0, 0}, {1, 2}, {0, 4}, {-2, 5}}}};
  const json twisted{{"type", "bezier"}, {"points", {{0, 0, 0}, {1, 0, 1}, {2, 1, 2}, {2, 3, 1}}}};
  for (const json& given : {planar, twisted}) {
    const json r = perform_well("curve.edit", {{"curve", given}, {"end_tolerance", 0}});
    const auto before = along(given["points"], 500);
    const auto after = along(r["curve"]["points"], 500);
    const double far = std::max(farthest(before, after), farthest(after, before));
    EXPECT_GT(far, 0.01);
    EXPECT_GE(r["departure"].get<double>(), far - 0.01);
    EXPECT_LE(r["departure"].get<double>(), 1.05 * far);
  }
  const json none = perform_well("curve.edit", {{"curve", planar}, {"amount", 0}});
  EXPECT_EQ(none["departure"], 0);
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

// A closed path of four cubics with one direction at every joint (the egg) and a corner: judged by
// the edges at the joints and by curvature along each piece, not by what the answer says of itself.
// A circle of rational Beziers is made of cubics first: how far they lie off it is told.
TEST(CurveEditPieces, TellsHowFarItsBeziersLieOff) {
  const double w = std::sqrt(0.5);
  const json circle = {
      {"type", "bspline"},
      {"degree", 2},
      {"knots", {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4}},
      {"points", {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}, {1, 0}}},
      {"weights", {1, w, 1, w, 1, w, 1, w, 1}}};
  const json r = perform_well("curve.edit_pieces", {{"curve", circle}});
  double most = 0;
  for (const json& piece : r["curve"]["curves"]) {
    const json& p = piece["points"];
    ASSERT_EQ(p.size(), 4U);
    for (double t = 0; t <= 1; t += 1e-3) {
      const double u = 1 - t;
      const auto at = [&](int i) {
        return u * u * u * p[0][i].get<double>() + 3 * u * u * t * p[1][i].get<double>() +
               3 * u * t * t * p[2][i].get<double>() + t * t * t * p[3][i].get<double>();
      };
      most = std::max(most, std::abs(std::hypot(at(0), at(1)) - 1));
    }
  }
  EXPECT_EQ(r["curve"]["closed"], true);  // its ends meet
  EXPECT_EQ(r["joints_after"]["g1"], r["curve"]["curves"].size());
  EXPECT_GE(r["departure"].get<double>(), most);
  EXPECT_LE(r["approximated"].get<double>(), 1e-3 * 6.3);  // of the length
}

/// A loop has no line to lie on.
TEST(CurveEdit, APieceThatEndsWhereItBeginsIsKeptAndNotStraight) {
  for (const json& loop :
       {json{{0, 0}, {2, 0}, {0, 2}, {0, 0}}, json{{0, 0, 0}, {2, 0, 0}, {0, 2, 1}, {0, 0, 0}}}) {
    const json r =
        perform_well("curve.edit_pieces", {{"curve", {{"type", "bezier"}, {"points", loop}}}});
    EXPECT_EQ(r["pieces"][0]["became"], "kept") << loop;
    EXPECT_NE(r["pieces"][0]["before"]["type"], 1) << loop;
  }
  const json back{{"type", "bezier"}, {"points", {{0, 0}, {3, 3}, {-1, -1}, {0, 0}}}};
  EXPECT_EQ(perform_well("curve.edit_pieces", {{"curve", back}})["pieces"][0]["became"],
            "straight");
}

// Between two ends at one place lies a point: it was given for a circle.
TEST(CurveEdit, OfWhatEndsWhereItBeginsIsRefused) {
  const json round = {{"type", "bezier"}, {"points", {{0, 0}, {3, 0}, {3, 3}, {-3, 3}, {0, 0}}}};
  EXPECT_EQ(code_of("curve.edit", {{"curve", round}}), "undrawable");
}

TEST(CurveEditPieces, KeepsDirectionsAndCornersOfAClosedPath) {
  const json path = json::parse(R"({"type":"path","closed":true,"curves":[
    {"type":"bezier","points":[[0,0],[0,30],[20,50],[60,50]]},
    {"type":"bezier","points":[[60,50],[90,50],[100,40],[100,10]]},
    {"type":"bezier","points":[[100,10],[100,4],[98,0],[90,-2]]},
    {"type":"bezier","points":[[90,-2],[60,-2]]},
    {"type":"bezier","points":[[60,-2],[30,-10],[0,-30],[0,0]]}]})");
  const json r = perform_well("curve.edit_pieces", {{"curve", path}});
  EXPECT_EQ(r["curve"]["closed"], true);
  const json& after = r["curve"]["curves"];
  ASSERT_EQ(after.size(), 5U);
  const auto edge = [](const json& c, bool first) {
    const json& p = c["points"];
    const std::size_t i = first ? 0 : p.size() - 2;
    return std::atan2(p[i + 1][1].get<double>() - p[i][1].get<double>(),
                      p[i + 1][0].get<double>() - p[i][0].get<double>());
  };
  for (std::size_t i = 0; i < 5; ++i) {
    const json& given = path["curves"][i];
    EXPECT_NEAR(edge(after[i], true), edge(given, true), 1e-9) << i;
    EXPECT_NEAR(edge(after[i], false), edge(given, false), 1e-9) << i;
    EXPECT_EQ(after[i]["points"].front(), given["points"].front()) << i;
    EXPECT_EQ(after[i]["points"].back(), given["points"].back()) << i;
  }
  for (const std::size_t i : {1U, 3U}) EXPECT_EQ(after[i], path["curves"][i]);  // an arc, a line
  EXPECT_EQ(r["edited"], 3);
  for (const std::size_t i : {0U, 2U, 4U}) {
    const json value = perform_well("curve.cav", {{"curve", after[i]}});
    EXPECT_EQ(value["monotone"], "yes") << i;
    EXPECT_LE(value["type"].get<int>(), 2) << i;
  }
  const json kept = perform_well("curve.edit_pieces", {{"curve", path}, {"limit", 0}});
  EXPECT_EQ(kept["edited"], 0);
  EXPECT_EQ(kept["curve"], path);
}

}  // namespace
}  // namespace keyline::operations
