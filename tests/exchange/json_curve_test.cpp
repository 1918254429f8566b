#include "keyline/exchange/json/json_curve.h"

#include <array>
#include <cmath>
#include <variant>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace keyline::exchange {
namespace {

using nlohmann::json;

/// A chain of one piece with these ends under that key.
json piece(double alpha, const char* key, json ends) {
  return {{"type", "log-aesthetic"},
          {"start", {1, 2}},
          {"direction", 0.5},
          {"pieces", {{{"alpha", alpha}, {"length", 3}, {key, std::move(ends)}}}}};
}

struct EndsCase {
  double alpha;
  std::array<double, 2> radius, curvature;
};
const EndsCase kEnds[] = {
    {0.5, {2, 4}, {0.5, 0.25}},        {0.5, {-4, -0.5}, {-0.25, -2}}, {-1, {5, -2}, {0.2, -0.5}},
    {2, {0, 8}, {HUGE_VAL, 0.125}},  // a cusp turns the way the other end does
    {2, {-8, 0}, {-0.125, -HUGE_VAL}},
};

TEST(JsonCurve, EndsAreGivenByTheirRadiiOrTheirCurvatures) {
  for (const EndsCase& c : kEnds) {
    const auto by_radius = curve_from_json(piece(c.alpha, "radius", c.radius), "curve");
    ASSERT_TRUE(by_radius) << by_radius.error().message;
    const lac::Piece read = std::get<lac::Chain>(by_radius->value).pieces.at(0);
    EXPECT_EQ(read.alpha, c.alpha);
    EXPECT_EQ(read.length, 3);
    EXPECT_EQ(read.curvature_start, c.curvature[0]);
    EXPECT_EQ(read.curvature_end, c.curvature[1]);
    if (std::isinf(c.curvature[0]) || std::isinf(c.curvature[1])) continue;
    const auto by_curvature = curve_from_json(piece(c.alpha, "curvature", c.curvature), "curve");
    ASSERT_TRUE(by_curvature);
    EXPECT_EQ(std::get<lac::Chain>(by_curvature->value), std::get<lac::Chain>(by_radius->value));
  }
}

json line(json from, json to) { return {{"type", "bezier"}, {"points", {from, to}}}; }

TEST(JsonCurve, PathsAreEndToEnd) {
  json path{{"type", "path"}, {"curves", {line({0, 0}, {1, 1}), line({1, 1.5}, {2, 1})}}};
  const auto gap = path_from_json(path, "curve");
  ASSERT_FALSE(gap);
  EXPECT_EQ(gap.error().path, "curve.curves[1]");
  EXPECT_NE(gap.error().message.find("begins 0.5 away"), std::string::npos);
  path["curves"][1]["points"][0] = {1, 1.00001};  // 0.000005 of its size
  EXPECT_TRUE(path_from_json(path, "curve"));
  // a closed path comes back to its start
  path["closed"] = true;
  const auto closed = path_from_json(path, "curve");
  ASSERT_TRUE(closed);
  ASSERT_EQ(closed->curves.size(), 3U);
  EXPECT_EQ(evaluate(*closed, 1), (core::Point2{0, 0}));
}

TEST(JsonCurve, EndsAreOneOfTheTwo) {
  const auto path = [](const json& j) {
    const auto c = curve_from_json(j, "curve");
    return c ? std::string("fine") : c.error().path;
  };
  json both = piece(0.5, "radius", {2, 4});
  both["pieces"][0]["curvature"] = {0.5, 0.25};
  EXPECT_EQ(path(both), "curve.pieces[0]");
  json neither = piece(0.5, "radius", {2, 4});
  neither["pieces"][0].erase("radius");
  EXPECT_EQ(path(neither), "curve.pieces[0]");
  EXPECT_EQ(path(piece(0.5, "radius", {2, 4, 8})), "curve.pieces[0].radius");
  EXPECT_EQ(path(piece(0.5, "radius", {2})), "curve.pieces[0].radius");
  EXPECT_EQ(path(piece(0.5, "curvature", {2, "x"})), "curve.pieces[0].curvature[1]");
}

}  // namespace
}  // namespace keyline::exchange
