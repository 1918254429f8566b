#include <cmath>

#include <gtest/gtest.h>

#include "random_values.h"
#include "worst.h"

/// Requests to lac.space drawn at random (see random_requests_test.cpp).
namespace keyline::operations {
namespace {

using nlohmann::json;
using own::Random;
using own::requests;
using own::uniform;
using own::Worst;

TEST(RandomRequests, SpaceCurvesMeetBothTangentsAlsoInAMirror) {
  Random random(own::seed(8));
  constexpr double kJudged = 1e-6;  // of Runge and Kutta's, whose steps shrink towards inflections
  Worst worst("end");
  for (int n = 0; n < requests(0.008); ++n) {
    const auto vector = [&] { return json{1.0, uniform(random, -1, 1), uniform(random, -1, 1)}; };
    const json first = vector(), last = vector();
    json request{{"op", "lac.space"},
                 {"start", {0, 0, 0}},
                 {"end", {2, 0, 0}},
                 {"tangents", {first, last}},
                 {"alpha", uniform(random, -2, 0)},
                 {"beta", uniform(random, -2, 2)},
                 {"omega", uniform(random, -0.2, 0.2)}};
    SCOPED_TRACE(request.dump());
    const json result = own::result_of(request);
    const own::SpaceEnd end = own::integrated(result["curve"], 400);
    const double size = std::hypot(1.0, last[1].get<double>(), last[2].get<double>());
    for (std::size_t i = 0; i < 3; ++i) {
      worst.expect_below(std::abs(end.place[i] - (i == 0 ? 2 : 0)) / 2, kJudged);
      worst.expect_below(std::abs(end.tangent[i] - last[i].get<double>() / size), kJudged);
    }
    for (json& t : request["tangents"]) t[2] = -t[2].get<double>();
    EXPECT_NEAR(own::result_of(request)["length"], result["length"].get<double>(), 1e-9);
  }
}

}  // namespace
}  // namespace keyline::operations
