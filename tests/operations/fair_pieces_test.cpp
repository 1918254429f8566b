#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "random_values.h"

/// A number of pieces asked of `fair`.
namespace keyline::operations {
namespace {

using nlohmann::json;
using own::Random;
using own::uniform;

/// With errors up to a share of its length.
json measured(const std::vector<std::array<double, 2>>& curve, double error, Random& random) {
  double length = 0;
  for (std::size_t i = 1; i < curve.size(); ++i)
    length += std::hypot(curve[i][0] - curve[i - 1][0], curve[i][1] - curve[i - 1][1]);
  json points = json::array();
  const auto off = [&] { return error * length * uniform(random, -1, 1); };
  for (const auto& [x, y] : curve) {
    const double there = x + off();
    points.push_back({there, y + off()});
  }
  return points;
}

/// Of a circle: radius t, length t^2 / 2.
std::vector<std::array<double, 2>> involute(double from, double to) {
  std::vector<std::array<double, 2>> points;
  for (int i = 0; i < 100; ++i) {
    const double t = std::sqrt(std::lerp(from * from, to * to, i / 99.0));
    points.push_back({std::cos(t) + t * std::sin(t), std::sin(t) - t * std::cos(t)});
  }
  return points;
}

/// One curve whose radius only grows comes out as that many pieces, none of them a needle: its
/// curvature runs from 1 / from to 1 / to.
TEST(FairPieces, AreAsManyAsAskedForAndNoNeedles) {
  Random random(5);
  for (int n = 0; n < 6; ++n) {
    const double from = uniform(random, 0.3, 1), to = from + uniform(random, 1, 2);
    const json points = measured(involute(from, to), 5e-4, random);
    for (const int wanted : {1, 3, 5}) {
      const json request{{"op", "fair"}, {"points", points}, {"pieces", wanted}};
      SCOPED_TRACE(request.dump());
      const json result = own::result_of(request);
      EXPECT_EQ(result["within_tolerance"], true);
      const json& pieces = result["curve"]["pieces"];
      EXPECT_EQ(pieces.size(), static_cast<std::size_t>(wanted)) << result["report"];
      for (const json& p : pieces)
        for (const json& bend : p["curvature"]) EXPECT_LT(std::abs(bend.get<double>()), 2 / from);
    }
  }
}

}  // namespace
}  // namespace keyline::operations
