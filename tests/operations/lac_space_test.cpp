#include <array>
#include <cmath>
#include <utility>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "own_numerics.h"

namespace keyline::operations {
namespace {

using nlohmann::json;
using own::answered;
using own::result_of;

using Vector = std::array<double, 3>;

/// Curvature or torsion of a piece of a slope, and its rate along the length.
struct Law {
  double slope, from, to, length;
  double at(double v) const {
    if (from == to) return from;
    if (slope == 0) return from * std::pow(to / from, v);
    const auto power = [](double x, double e) {
      return std::copysign(std::pow(std::abs(x), e), x);
    };
    return power((1 - v) * power(from, -slope) + v * power(to, -slope), -1 / slope);
  }
  double rate(double v) const { return (at(v + 1e-6) - at(v - 1e-6)) / 2e-6 / length; }
};

Law law_of(const json& piece, const char* slope, const char* ends) {
  return {piece[slope], piece[ends][0], piece[ends][1], piece["length"]};
}

double apart(const Vector& a, const Vector& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

json space_request(const json& alpha, const json& beta) {
  return {{"op", "lac.space"},  {"start", {0, 0, 0}},
          {"end", {3, 1, 0.5}}, {"tangents", {{1, 0, 0}, {1, 1, 0.6}}},
          {"alpha", alpha},     {"beta", beta},
          {"omega", 0.1}};
}

/// Of f(s^2 / 2) over [0, 1]: a clothoid's end, by Simpson's rule.
double fresnel(double (*f)(double)) {
  constexpr int kParts = 2000;
  double sum = 0;
  for (int i = 0; i <= kParts; ++i) {
    const double s = i / static_cast<double>(kParts);
    sum += (i == 0 || i == kParts ? 1 : i % 2 == 1 ? 4 : 2) * f(s * s / 2);
  }
  return sum / (3 * kParts);
}

TEST(CompoundSpace, MeetsItsEndsWithAllRatesContinuous) {
  const double size = std::sqrt(1 + 1 + 0.36);
  for (const auto& [alpha, beta] :
       {std::pair<json, json>{{-1, 0.5}, {-1, -1}}, {{0.5, -1}, {-1, 1}}, {{-2, -0.5}, {0.5, 2}}}) {
    json request = space_request(alpha, beta);
    request["ratio"] = 0.35;
    const json result = result_of(request);
    const json& pieces = result["curve"]["pieces"];
    ASSERT_EQ(pieces.size(), 2u);
    const own::SpaceEnd end = own::integrated(result["curve"]);
    EXPECT_LT(apart(end.place, {3, 1, 0.5}), 1e-9);
    EXPECT_LT(apart(end.tangent, {1 / size, 1 / size, 0.6 / size}), 1e-9);
    const double first = pieces[0]["length"];
    EXPECT_NEAR(first / (first + pieces[1]["length"].get<double>()), 0.35, 1e-12);
    for (const auto& [slope, ends] : {std::pair{"alpha", "curvature"}, {"beta", "torsion"}}) {
      const Law before = law_of(pieces[0], slope, ends);
      const Law after = law_of(pieces[1], slope, ends);
      EXPECT_EQ(before.to, after.from);
      EXPECT_NEAR(before.rate(1), after.rate(0), 1e-7 * (1 + std::abs(before.rate(1))));
    }
    EXPECT_EQ(result["slopes"].size(), 2u);
  }
}

TEST(CompoundSpace, OfEqualSlopesIsTheCurveOfOne) {
  const json one = result_of(space_request(-1, 0.5));
  const json two = result_of(space_request({-1, -1}, {0.5, 0.5}));
  EXPECT_NEAR(two["lambda"].get<double>(), one["lambda"].get<double>(), 1e-9);
  EXPECT_NEAR(two["nu"].get<double>(), one["nu"].get<double>(), 1e-9);
  EXPECT_NEAR(two["length"].get<double>(), one["length"].get<double>(), 1e-10);
}

TEST(CompoundSpace, InAPlaneIsTheCompoundCurve) {
  const json flat = result_of({{"op", "lac.compound"},
                               {"points", {{0, 0}, {2, 0}, {3, 1.5}}},
                               {"alpha", {-1, 1.5}},
                               {"ratio", 0.4}});
  const json& planar = flat["curve"]["pieces"];
  const double share = planar[0]["length"].get<double>() /
                       (planar[0]["length"].get<double>() + planar[1]["length"].get<double>());
  const json space = result_of({{"op", "lac.space"},
                                {"start", {0, 0, 0}},
                                {"end", {3, 1.5, 0}},
                                {"tangents", {{1, 0, 0}, {1, 1.5, 0}}},
                                {"alpha", {planar[0]["alpha"], planar[1]["alpha"]}},
                                {"beta", -1},
                                {"omega", 0},
                                {"ratio", share}});
  EXPECT_EQ(space["planar"], true);
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t k = 0; k < 2; ++k)
      EXPECT_NEAR(space["curve"]["pieces"][i]["curvature"][k].get<double>(),
                  planar[i]["curvature"][k].get<double>(), 1e-9);
}

TEST(CompoundSpace, RefusesAShareOfNothing) {
  json request = space_request({-1, 0.5}, -1);
  request["ratio"] = 1;
  EXPECT_EQ(answered(request)["error"]["path"], "ratio");
}

// A clothoid of half a radian from its inflection, turning to either side: Fresnel's integrals.
TEST(SpaceInAPlane, LambdaIsNullWhereTheStartHasNoCurvature) {
  for (const double side : {1.0, -1.0}) {
    const json request = {{"op", "lac.space"},
                          {"start", {0, 0, 0}},
                          {"end", {0.97528778, side * 0.16371404, 0}},
                          {"tangents", {{1, 0, 0}, {std::cos(0.5), side * std::sin(0.5), 0}}},
                          {"alpha", -1},
                          {"beta", 0},
                          {"omega", 0}};
    const json near = result_of(request);
    EXPECT_GT(std::abs(near["lambda"].get<double>()), 1e10);  // eight digits do not say 0
    json exact = request;
    exact["end"] = {fresnel(std::cos), side * fresnel(std::sin), 0};
    const json result = result_of(exact);
    EXPECT_TRUE(result["lambda"].is_null());
    EXPECT_EQ(result["planar"], true);
    EXPECT_EQ(result["curve"]["pieces"][0]["curvature"][0], 0);
    EXPECT_NEAR(result["curve"]["pieces"][0]["curvature"][1].get<double>(), 1, 1e-9);
  }
}

TEST(SpaceGraphs, OfTheQuinticsTendToTheSlopes) {
  double before = 1e300;
  double variance = 1e300;
  for (const double tolerance : {1e-3, 1e-6, 1e-9}) {
    json request = space_request(-1, 0.5);
    request["graphs_within"] = tolerance;
    const json shown = result_of(request)["approximated"];
    EXPECT_LE(shown["deviation"].get<double>(), tolerance);
    const double off = std::abs(shown["curvature"]["slope"].get<double>() + 1);
    EXPECT_LT(off, before);
    // Torsion hangs on third derivatives and its rate on fourth ones: it takes closer curves.
    EXPECT_LT(shown["torsion"]["variance"].get<double>(), variance);
    before = off;
    variance = shown["torsion"]["variance"];
  }
  EXPECT_LT(before, 1e-6);
  EXPECT_LT(variance, 0.02);
}

}  // namespace
}  // namespace keyline::operations
