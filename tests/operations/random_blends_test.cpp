#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "random_values.h"

/// Blends between curves drawn at random, as random_requests_test.cpp does for other operations.
namespace keyline::operations {
namespace {

using nlohmann::json;
using own::answered;
using own::any_slope;
using own::Random;
using own::requests;
using own::uniform;
using own::wrapped;

TEST(RandomRequests, BlendsLeaveAndJoinTheirCurves) {
  Random random(own::seed(6));
  int drawn = 0;
  for (int n = 0; n < requests(0.04); ++n) {
    const auto curve = [&] {
      return json{{"type", "log-aesthetic"},
                  {"start", {uniform(random, 0, 2), uniform(random, 0, 2)}},
                  {"direction", uniform(random, -3, 3)},
                  {"pieces",
                   {{{"alpha", -1},
                     {"length", uniform(random, 0.5, 2)},
                     {"curvature", {uniform(random, -1, 1), uniform(random, -1, 1)}}}}}};
    };
    const char* orders[] = {"G1", "G2", "G3"};
    const json request{{"op", "lac.blend"},
                       {"curves", {curve(), curve()}},
                       {"order", orders[n % 3]},
                       {"alpha", random() % 2 == 0 ? -1 : any_slope(random)}};
    SCOPED_TRACE(request.dump());
    const json answer = answered(request);
    if (answer["ok"] == false) {
      // With curvatures a chain may not be found; that claims nothing.
      const std::string code = answer["error"]["code"];
      EXPECT_TRUE(code == "undrawable" || (n % 3 > 0 && code == "not-converged")) << answer;
      continue;
    }
    ++drawn;
    EXPECT_EQ(own::holes(answer["result"]), std::vector<std::string>{});
    EXPECT_EQ(own::faults(answer["result"]["curve"]), std::vector<std::string>{});
    const own::Place from = own::walked(request["curves"][0]).end();
    const own::Place to = own::walked(request["curves"][1]).places[0];
    const own::Track track = own::walked(answer["result"]["curve"]);
    EXPECT_LT(std::hypot(track.places[0].x - from.x, track.places[0].y - from.y), 1e-12);
    EXPECT_LT(std::hypot(track.end().x - to.x, track.end().y - to.y), 1e-11);
    EXPECT_LT(std::abs(wrapped(track.places[0].direction - from.direction)), 1e-12);
    EXPECT_LT(std::abs(wrapped(track.end().direction - to.direction)), 1e-11);
  }
  EXPECT_GT(drawn, requests(0.04) / 4);
}

}  // namespace
}  // namespace keyline::operations
