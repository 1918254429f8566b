#include "keyline/exchange/json/json_surface.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace keyline::exchange {
namespace {

using nlohmann::json;
using surface::BezierSurface;
using surface::BSplineSurface;
using surface::Net;
using surface::Surface;

Net bumpy_net(int rows, int columns) {
  Net net{rows, columns, {}};
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) net.points.push_back({i / 3.0, j * 0.7, 0.1 * i * j});
  return net;
}

const Surface kBezier = BezierSurface{bumpy_net(3, 4), {}};
const Surface kSpline = BSplineSurface{{2, 3},
                                       {{{0, 0, 0, 1.0 / 3, 1, 1, 1}, {0, 0, 0, 0, 2, 2, 2, 2}}},
                                       bumpy_net(4, 4),
                                       std::vector<double>(16, 0.7)};

TEST(JsonSurface, ReadsBackToTheSameDoubles) {
  for (const Surface& s : {kBezier, kSpline}) {
    const auto back = surface_from_json(json::parse(to_json(s).dump()), "surface");
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_EQ(*back, s);
  }
}

TEST(JsonSurface, RowsOfTheNetGoWithTheFirstDegree) {
  const json j = to_json(kSpline);
  EXPECT_EQ(j["type"], "bspline-surface");
  EXPECT_EQ(j["degree"], json({2, 3}));
  EXPECT_EQ(j["points"].size(), 4U);
  EXPECT_EQ(j["knots"][0].size(), 7U);
}

std::string path_after(const Surface& s, const std::function<void(json&)>& change) {
  json j = to_json(s);
  change(j);
  const auto back = surface_from_json(j, "surface");
  return back ? "fine" : back.error().path;
}

TEST(JsonSurface, SaysWhereAMistakeIs) {
  const auto bezier = [](auto change) { return path_after(kBezier, change); };
  const auto spline = [](auto change) { return path_after(kSpline, change); };
  EXPECT_EQ(bezier([](json&) {}), "fine");
  EXPECT_EQ(bezier([](json& j) { j = 3; }), "surface");
  EXPECT_EQ(bezier([](json& j) { j["type"] = "bezier"; }), "surface.type");
  EXPECT_EQ(bezier([](json& j) { j.erase("points"); }), "surface.points");
  EXPECT_EQ(bezier([](json& j) { j["points"] = json::array(); }), "surface.points");
  EXPECT_EQ(bezier([](json& j) { j["points"] = {{{0, 0, 0}, {1, 0, 0}}}; }), "surface.points");
  EXPECT_EQ(bezier([](json& j) { j["points"][1].erase(0); }), "surface.points[1]");
  EXPECT_EQ(bezier([](json& j) { j["points"][1][2][0] = "x"; }), "surface.points[1][2][0]");
  EXPECT_EQ(bezier([](json& j) { j["points"][1][2] = {1}; }), "surface.points[1][2]");
  EXPECT_EQ(bezier([](json& j) { j["weights"] = {1, 2}; }), "surface.weights");
  EXPECT_EQ(spline([](json& j) { j["weights"][3][1] = 0; }), "surface.weights[3][1]");
  EXPECT_EQ(spline([](json& j) { j["weights"].erase(0); }), "surface.weights");
  EXPECT_EQ(spline([](json& j) { j["degree"] = 3; }), "surface.degree");
  EXPECT_EQ(spline([](json& j) { j["degree"][1] = 99; }), "surface.degree[1]");
  EXPECT_EQ(spline([](json& j) { j["degree"][1] = 2.5; }), "surface.degree[1]");
  EXPECT_EQ(spline([](json& j) { j["knots"].erase(0); }), "surface.knots");
  EXPECT_EQ(spline([](json& j) { j["knots"][0].erase(0); }), "surface.knots[0]");
  EXPECT_EQ(spline([](json& j) { j["knots"][1][4] = -1; }), "surface.knots[1][4]");
}

}  // namespace
}  // namespace keyline::exchange
