#include <cmath>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "keyline/operations/perform.h"

namespace keyline::operations {
namespace {

using nlohmann::json;

/// The joint of the line (-1, 0), (0, 0) to a curve.
json joint_to(const char* curve) {
  const json line{{"type", "polyline"}, {"points", {{-1, 0}, {0, 0}}}};
  const auto result =
      perform("curve.continuity", {{"curves", json::array({line, json::parse(curve)})}}, {});
  if (!result) return result.error().message;
  return (*result)["joints"][0];
}

/// Of a piece of length 1 with these two curvatures.
json joint_to_piece(double alpha, const std::string& curvatures) {
  const std::string piece =
      R"({"alpha":)" + std::to_string(alpha) + R"(,"length":1,)" + curvatures + "}";
  return joint_to(
      (R"({"type":"log-aesthetic","start":[0,0],"direction":0,"pieces":[)" + piece + "]}").c_str());
}

// kappa^-alpha is linear in arc length: of kappa = s^(-1 / alpha) the rate at 0 is infinite for
// alpha < -1, 1 for -1 (a clothoid), 0 above.
TEST(CurveContinuity, KnowsTheRateWhereAPieceLeavesStraight) {
  const json steep = joint_to_piece(-2, R"("curvature":[0,1])");
  EXPECT_EQ(steep["order"], "G2");
  EXPECT_EQ(steep["curvature_jump"], 0);
  EXPECT_TRUE(steep["curvature_rate_jump"].is_null());
  const json clothoid = joint_to_piece(-1, R"("curvature":[0,1])");
  EXPECT_EQ(clothoid["order"], "G2");
  EXPECT_NEAR(clothoid["curvature_rate_jump"].get<double>(), 1, 1e-12);
  EXPECT_EQ(joint_to_piece(-0.5, R"("curvature":[0,1])")["order"], "G3");
}

TEST(CurveContinuity, KnowsACuspAtAnEnd) {
  const json cusp = joint_to_piece(2, R"("radius":[0,1])");
  EXPECT_EQ(cusp["order"], "G1");
  for (const char* jump : {"curvature_jump", "relative_curvature_jump", "curvature_rate_jump"})
    EXPECT_TRUE(cusp.contains(jump) && cusp[jump].is_null()) << jump;
}

// x = 6 u^2 + ..., y = u^4: curvature y'' = 1 / 18 where the handle is drawn in.
TEST(CurveContinuity, KnowsTheCurvatureWhereAHandleIsDrawnIn) {
  const json joint = joint_to(R"({"type":"bezier","points":[[0,0],[0,0],[1,0],[2,0],[3,1]]})");
  EXPECT_EQ(joint["order"], "G1");
  EXPECT_NEAR(joint["curvature_jump"].get<double>(), 1.0 / 18, 1e-12);
  EXPECT_EQ(joint_to(R"({"type":"bezier","points":[[0,0],[0,0],[1,0],[2,0]]})")["order"], "G3");
}

// Four handles in the start: the direction is that of the fifth, along y.
TEST(CurveContinuity, KnowsTheDirectionWhereManyHandlesAreDrawnIn) {
  const json joint =
      joint_to(R"({"type":"bezier","points":[[0,0],[0,0],[0,0],[0,0],[0,1],[0,2]]})");
  EXPECT_EQ(joint["order"], "G0");
  EXPECT_NEAR(joint["angle"].get<double>(), std::acos(0.0), 1e-12);
}

// A curve of no length is none: what lies beside it meets.
TEST(CurveContinuity, CurvesOfNoLengthAreNone) {
  const json left{{"type", "polyline"}, {"points", {{-1, 0}, {0, 0}}}};
  const json right{{"type", "polyline"}, {"points", {{0, 0}, {2, 0}}}};
  const json dot{{"type", "bezier"}, {"points", {{0, 0}, {0, 0}, {0, 0}}}};
  const auto found =
      perform("curve.continuity", {{"curves", json::array({left, dot, right})}}, {}).value();
  ASSERT_EQ(found["joints"].size(), 1u);
  EXPECT_EQ(found["order"], "G3");
  EXPECT_FALSE(perform("curve.continuity", {{"curves", json::array({left, dot})}}, {}));
  EXPECT_FALSE(perform("curve.continuity", {{"curves", json::array({dot})}, {"closed", true}}, {}));
}

}  // namespace
}  // namespace keyline::operations
