#include <cmath>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "own_numerics.h"

namespace keyline::operations {
namespace {

using nlohmann::json;
using own::answered;
using own::result_of;

json wave_request() {
  json request{{"op", "fit.spline"}, {"trials", 2}, {"generations", 15}, {"population", 20}};
  for (int i = 0; i < 60; ++i) {
    request["x"].push_back(i * 0.1);
    request["y"].push_back(std::sin(i * 0.17) + 0.01 * std::cos(i * 2.3));
  }
  return request;
}

TEST(FitSpline, ReachesOverAnIntervalBeyondTheData) {
  json request = wave_request();
  const json narrow = result_of(request);
  request["interval"] = {-1, 7.5};
  const json wide = result_of(request);
  EXPECT_EQ(wide["curve"]["knots"].front(), -1.0);
  EXPECT_EQ(wide["curve"]["knots"].back(), 7.5);
  EXPECT_EQ(wide["knots"], narrow["knots"]);
  // The same polynomials: the squares that are left do not change.
  EXPECT_NEAR(wide["sse"].get<double>(), narrow["sse"].get<double>(),
              1e-8 * narrow["sse"].get<double>());
  request["interval"] = {0, 5};
  EXPECT_EQ(answered(request)["error"]["path"], "interval");
}

TEST(FitSpline, TakesTheRatesOfItsGeneticSearch) {
  json request = wave_request();
  request["knots"] = "ga";
  const double usual = result_of(request)["bic"];
  // Nothing crosses and nothing mutates: every generation is the first one over again.
  request["rates"] = {{"crossover", 0}, {"mutation", 0}, {"minimum", 0}};
  const double still = result_of(request)["bic"];
  request["generations"] = 0;
  EXPECT_EQ(result_of(request)["bic"].get<double>(), still);
  EXPECT_LT(usual, still);
  // Insertions alone: knots only grow in number, so that the criterion ends higher.
  request = wave_request();
  request["knots"] = "ga";
  request["rates"] = {{"crossover", 0}, {"mutation", 1}, {"insertion", 0}};
  const std::size_t fewer = result_of(request)["knots"].size();
  request["rates"]["insertion"] = 1;
  EXPECT_LE(fewer, result_of(request)["knots"].size());
  request["rates"]["mutation"] = 2;
  EXPECT_EQ(answered(request)["error"]["path"], "rates.mutation");
}

}  // namespace
}  // namespace keyline::operations
