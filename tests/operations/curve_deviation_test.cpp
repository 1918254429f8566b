#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "keyline/operations/perform.h"
namespace keyline::operations {
namespace {

using nlohmann::json;

json measured(const json& curve, const json& points) {
  auto result = perform("curve.deviation", {{"curve", curve}, {"points", points}}, {});
  return result ? *result : json(result.error().message);
}

TEST(CurveDeviation, TellsPlaceAndSideOfPoints) {
  const json line{{"type", "bezier"}, {"points", {{0, 0}, {5, 0}, {10, 0}}}};
  const json told = measured(line, {{1, 0.5}, {4, -2}, {13, 4}});
  EXPECT_NEAR(told["arc_length"][0].get<double>(), 1, 1e-9);
  EXPECT_NEAR(told["distance"][0].get<double>(), 0.5, 1e-12);
  EXPECT_NEAR(told["distance"][1].get<double>(), -2, 1e-12);
  EXPECT_NEAR(told["distance"][2].get<double>(), 5, 1e-12);
  EXPECT_NEAR(told["feet"][2][0].get<double>(), 10, 1e-9);
  EXPECT_NEAR(told["max"].get<double>(), 5, 1e-12);
  EXPECT_NEAR(told["rms"].get<double>(), std::sqrt((0.25 + 4 + 25) / 3), 1e-12);
}

TEST(CurveDeviation, TellsTheDirectionInWhichACurveArrives) {
  const json drawn_in{{"type", "bezier"}, {"points", {{0, 0}, {0, 0}, {3, 0}, {3, 0}}}};
  EXPECT_EQ(measured(drawn_in, {{3, 1}})["direction"][0], 0);
}

/// Of each point, whether it is told to lie on the left of travel.
std::vector<bool> left_of(const json& curve, const json& points) {
  std::vector<bool> left;
  const json told = measured(curve, points);
  for (const json& d : told["distance"]) left.push_back(d.get<double>() > 0);
  return left;
}
void expect_right(json curve, const json& points) {
  SCOPED_TRACE(curve.dump());
  EXPECT_EQ(left_of(curve, points), std::vector<bool>(points.size(), false));
  std::reverse(curve["points"].begin(), curve["points"].end());
  EXPECT_EQ(left_of(curve, points), std::vector<bool>(points.size(), true));
}

TEST(CurveDeviation, TellsPointsOutsideOfASharpTurn) {
  expect_right({{"type", "polyline"}, {"points", {{0, 0}, {1, 0}, {0, 0.2}}}},
               {{1.2, -0.3}, {1.2, 0.01}, {1.1, 0.3}, {0.5, -0.1}, {0.5, 0.2}});
}

// A needle of a triangle, once around each way: all outside of it is on one side, all inside on the
// other, also where it ends as it begins.
TEST(CurveDeviation, TellsPointsOutsideOfAnOutline) {
  const json outside{{-0.3, 0.2}, {-0.3, -0.2}, {-0.3, 0}, {3.2, 0.4}, {3.2, -0.2}, {1, 0.2}};
  const json inside{{0.1, 0.001}, {0.1, -0.001}, {0.01, 0}, {2.9, 0.2}};
  expect_right({{"type", "polyline"}, {"points", {{0, 0}, {3, -0.3}, {3, 0.3}, {0, 0}}}}, outside);
  expect_right({{"type", "polyline"}, {"points", {{0, 0}, {3, 0.3}, {3, -0.3}, {0, 0}}}}, inside);
}

// (u^2, u^3) from u = 1 to -1 comes to its cusp at the origin above the way it goes on: it turns
// left.
TEST(CurveDeviation, TellsPointsBeyondACusp) {
  const double third = 1.0 / 3;
  expect_right({{"type", "bezier"}, {"points", {{1, 1}, {-third, -1}, {-third, 1}, {1, -1}}}},
               {{-0.5, 0.1}, {-0.5, -0.1}, {-0.05, 0.02}, {-0.05, -0.02}, {-0.2, 0}});
}

}  // namespace
}  // namespace keyline::operations
