#include <array>
#include <cmath>
#include <complex>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "own_numerics.h"

/// Capabilities of the papers as operations, held against closed forms and sums made here.
namespace keyline::operations {
namespace {

using nlohmann::json;

using own::answered;
using own::result_of;

using Points = std::vector<std::array<double, 2>>;

double distance_of(const std::array<double, 2>& a, const std::array<double, 2>& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1]);
}

/// Area between a polygon and its chord, by the shoelace formula.
double polygon_area(const Points& p) {
  double twice = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const auto& a = p[i];
    const auto& b = p[(i + 1) % p.size()];
    twice += a[0] * b[1] - b[0] * a[1];
  }
  return std::abs(twice) / 2;
}

TEST(StandardBounds, AreWhereTheStandardFormEnds) {
  // rho = ((alpha - 1) lambda theta + 1)^(1/(alpha-1)) over the bound of theta gives that of s.
  for (const double alpha : {-2.0, -1.0, -0.3, 1.7, 2.0, 4.0}) {
    const json result = result_of(
        {{"op", "lac.segment"}, {"points", {{0, 0}, {1, 0}, {1.55, 0.7}}}, {"alpha", alpha}});
    const double lambda = result["lambda"];
    const json& bounds = result["bounds"];
    const int open = alpha < 1 ? 0 : 1;
    EXPECT_TRUE(bounds["theta"][open].is_null());
    const double end = bounds["theta"][1 - open];
    // Towards the end in shrinking steps: rho may run to infinity there, s does where alpha >= 0.
    double s = 0;
    double from = 0;
    for (int k = 0; k < 60; ++k) {
      const double to = from + (end - from) / 2;
      for (int i = 0; i < 200; ++i) {
        const double theta = from + (to - from) * (i + 0.5) / 200;
        s += std::pow((alpha - 1) * lambda * theta + 1, 1 / (alpha - 1)) * (to - from) / 200;
      }
      from = to;
    }
    const double told = bounds["s"][1 - open];
    EXPECT_NEAR(s / told, 1, alpha > -1 && alpha < 0 ? 1e-3 : 1e-5) << alpha;
  }
}

TEST(StandardBounds, OfACompoundCurveAreThoseOfItsPieces) {
  const json result = result_of({{"op", "lac.compound"},
                                 {"points", {{0, 0}, {2, 0}, {3, 1.5}}},
                                 {"alpha", {-1, 1.5}},
                                 {"ratio", 0.4}});
  const double first = result["lambda"][0];
  const double second = result["lambda"][1];
  EXPECT_NEAR(result["bounds"][0]["s"][1].get<double>(), 1 / first, 1e-12 / first);
  EXPECT_NEAR(result["bounds"][0]["theta"][1].get<double>(), 0.5 / first, 1e-12 / first);
  EXPECT_NEAR(result["bounds"][1]["s"][0].get<double>(), -1 / (1.5 * second), 1e-12 / second);
  EXPECT_NEAR(result["bounds"][1]["theta"][0].get<double>(), -2 / second, 1e-12 / second);
}

TEST(TaylorAnalysis, OfALogarithmicSpiralIsTheTailOfAnExponential) {
  // z(theta) = (e^{(lambda + i) theta} - 1) / (lambda + i): the terms left out are known.
  const double lambda = 0.5;
  const double angle = 1.2;
  const json result = result_of({{"op", "lac.taylor"},
                                 {"alpha", 1},
                                 {"lambda", lambda},
                                 {"interval", {0, angle}},
                                 {"degree", 14},
                                 {"tolerance", 1e-6}});
  EXPECT_TRUE(result["radius"].is_null());
  EXPECT_EQ(result["converges"], true);
  const std::complex<double> rate(lambda, 1);
  int enough = 0;
  for (const json& row : result["degrees"]) {
    const int degree = row["degree"];
    std::complex<double> tail = 0;
    std::complex<double> term = 1.0 / rate;
    for (int k = 1; k < 60; ++k) {
      term *= rate * angle / static_cast<double>(k);
      if (k > degree) tail += term;
    }
    EXPECT_NEAR(row["largest"].get<double>(), std::abs(tail), 1e-6 * std::abs(tail) + 1e-15);
    EXPECT_GE(row["bound"].get<double>(), std::abs(tail) * (1 - 1e-9));
    // Cauchy's estimate on few circles: a bound, not a measure.
    EXPECT_LT(row["bound"].get<double>(), 1e4 * std::abs(tail) + 1e-13);
    if (enough == 0 && row["bound"].get<double>() <= 1e-6) enough = degree;
  }
  EXPECT_EQ(result["enough"], enough);
  EXPECT_GT(enough, 5);
}

TEST(TaylorAnalysis, TellsTheCircleOfConvergence) {
  // An involute, rho^2 = 1 + 2 lambda s and rho = 1 + lambda theta: the cusp is 1/(2 lambda) before
  // the start in s, 1/lambda in theta; over theta in [0, 1] the length is 1 + lambda / 2.
  const double lambda = 0.8;
  json request{{"op", "lac.taylor"},
               {"alpha", 2},
               {"lambda", lambda},
               {"interval", {0, 1}},
               {"variable", "arc-length"}};
  const json by_arc = result_of(request);
  EXPECT_NEAR(by_arc["radius"].get<double>(), 1 / (2 * lambda) / (1 + lambda / 2), 1e-12);
  EXPECT_EQ(by_arc["converges"], false);
  EXPECT_TRUE(by_arc["degrees"][3]["bound"].is_null());
  request["about"] = 1;  // 1/(2 lambda) + length away from the cusp
  EXPECT_EQ(result_of(request)["converges"], true);
  request["variable"] = "tangent-angle";  // a polynomial there
  EXPECT_TRUE(result_of(request)["radius"].is_null());
}

TEST(TaylorAnalysis, RefusesWhereThereIsNoSeries) {
  json request{{"op", "lac.taylor"}, {"alpha", -2}, {"points", {{0, 0}, {1, 0}, {1.5, 1}}}};
  request["degree"] = 31;
  EXPECT_EQ(answered(request)["error"]["path"], "degree");
  EXPECT_EQ(answered({{"op", "lac.taylor"}, {"alpha", -2}})["error"]["path"], "points");
}

TEST(LacVolume, GivesEachOfTheFiveRhythmsAnyVolume) {
  struct Type {
    json alpha;
    json ratio;
  };
  const Type types[] = {
      {-1, nullptr}, {0, nullptr}, {1.5, nullptr}, {{-1, 1.5}, 0.4}, {{1.5, -1}, 0.6}};
  for (const Type& type : types)
    for (const double volume : {0.22, 0.3, 0.38}) {
      json request{{"op", "lac.volume"},  {"points", {{1, 1}, {3, 1}}}, {"direction", 0.45},
                   {"alpha", type.alpha}, {"volume", volume},           {"samples", 4001}};
      if (!type.ratio.is_null()) request["ratio"] = type.ratio;
      const json result = result_of(request);
      ASSERT_TRUE(result.contains("polyline")) << type.alpha << ' ' << volume;
      const Points points = result["polyline"]["points"];
      EXPECT_NEAR(polygon_area(points), volume, 1e-6 * volume) << type.alpha;
      EXPECT_NEAR(result["volume"].get<double>(), volume, 1e-10);
      EXPECT_LT(distance_of(points.back(), {3, 1}), 1e-11);
      EXPECT_NEAR(result["curve"]["direction"].get<double>(), 0.45, 1e-14);
    }
}

TEST(LacVolume, OfACompoundRhythmSharesItsTurning) {
  const json result = result_of({{"op", "lac.volume"},
                                 {"points", {{0, 0}, {2, 0}}},
                                 {"direction", 0.6},
                                 {"alpha", {-1, 1.5}},
                                 {"ratio", 0.3},
                                 {"volume", 0.45}});
  const json& pieces = result["curve"]["pieces"];
  ASSERT_EQ(pieces.size(), 2u);
  // A clothoid's turning is its length times its mean curvature.
  const std::size_t sharp = pieces[0]["alpha"] == -1 ? 0 : 1;
  const double turning =
      pieces[sharp]["length"].get<double>() *
      (pieces[sharp]["curvature"][0].get<double>() + pieces[sharp]["curvature"][1].get<double>()) /
      2;
  EXPECT_NEAR(turning / result["theta"].get<double>(), 0.3, 1e-9);
  json beyond{{"op", "lac.volume"}, {"points", {{0, 0}, {2, 0}}},
              {"direction", 0.6},   {"alpha", {-1, 1.5}},
              {"ratio", 0.3},       {"volume", 50}};
  EXPECT_EQ(answered(beyond)["error"]["code"], "undrawable");
  beyond.erase("ratio");
  EXPECT_EQ(answered(beyond)["error"]["path"], "ratio");
}

TEST(LacDrag, MovesThePointAndHoldsTheEnds) {
  const json curve{
      {"type", "log-aesthetic"}, {"start", {0, 0}}, {"direction", 0}, {"pieces", json::array()}};
  json dragged = curve;
  for (const auto& [from, to] : {std::pair{0.1, 0.6}, {0.6, 0.2}, {0.2, 0.4}})
    dragged["pieces"].push_back({{"alpha", -1}, {"length", 1}, {"curvature", {from, to}}});
  const json before = result_of({{"op", "curve.show"}, {"curve", dragged}, {"samples", 3}});
  const json result = result_of({{"op", "lac.drag"},
                                 {"curve", dragged},
                                 {"at", 0.5},
                                 {"to", {1.42, 0.31}},
                                 {"samples", 20001}});
  const Points points = result["polyline"]["points"];
  double nearest = 1e9;
  for (const auto& p : points) nearest = std::min(nearest, distance_of(p, {1.42, 0.31}));
  EXPECT_LT(nearest, 1e-4);  // half a step of the samples
  const Points old = before["polyline"]["points"];
  EXPECT_LT(distance_of(points.front(), old.front()), 1e-12);
  EXPECT_LT(distance_of(points.back(), old.back()), 1e-11);
  double turning = 0;
  const json& pieces = result["curve"]["pieces"];
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const double k0 = pieces[i]["curvature"][0];
    const double k1 = pieces[i]["curvature"][1];
    turning += pieces[i]["length"].get<double>() * (k0 + k1) / 2;
    if (i > 0) {
      EXPECT_EQ(k0, pieces[i - 1]["curvature"][1].get<double>());
    }
  }
  EXPECT_NEAR(turning, 0.35 + 0.4 + 0.3, 1e-11);
  const json wrong = answered({{"op", "lac.drag"},
                               {"curve", {{"type", "polyline"}, {"points", {{0, 0}, {1, 0}}}}},
                               {"at", 0.5},
                               {"to", {0, 1}}});
  EXPECT_EQ(wrong["error"]["code"], "unsupported");
}

json arc(double angle) {
  return {{"type", "log-aesthetic"},
          {"start", {0, 0}},
          {"direction", 0},
          {"pieces", {{{"alpha", -1}, {"length", angle}, {"curvature", {1, 1}}}}}};
}

json spiral(double alpha, double k1) {
  return {{"type", "log-aesthetic"},
          {"start", {0, 0}},
          {"direction", 0},
          {"pieces", {{{"alpha", alpha}, {"length", 1}, {"curvature", {0.4, k1}}}}}};
}

TEST(CurveDiagrams, MeasureEverySectionAndItsPieces) {
  const double angles[] = {0.6, 1.1, 1.7};
  const json result = result_of(
      {{"op", "curve.diagrams"}, {"curves", {arc(angles[0]), arc(angles[1]), arc(angles[2])}}});
  for (int i = 0; i < 3; ++i) {
    const double a = angles[i];
    const json& section = result["sections"][i];
    EXPECT_NEAR(section["relative_volume"].get<double>(), (a - std::sin(a)) / (2 * a * a), 1e-10);
    EXPECT_NEAR(section["pieces"][0]["volume"].get<double>(), (a - std::sin(a)) / 2, 1e-10);
    // All points of an arc of radius 1 fall into the bar of log10(1 / angle).
    EXPECT_NEAR(section["lddc"]["c_curve"][0][0].get<double>(), -std::log10(a), 0.025 + 1e-9);
  }
  EXPECT_LE(result["joint"]["x"][0].get<double>(), -std::log10(1.7) + 0.025);
  EXPECT_TRUE(result["joint"]["agreement"].is_null());  // no arc has a distance AB
}

TEST(CurveDiagrams, CountPairsThatIndexAndVolumeOrderAlike) {
  json curves = json::array();
  for (const double k1 : {0.9, 1.3, 2.0, 3.1}) curves.push_back(spiral(-1, k1));
  const json result = result_of({{"op", "curve.diagrams"}, {"curves", curves}});
  int agreeing = 0;
  for (int i = 0; i < 4; ++i)
    for (int k = i + 1; k < 4; ++k) {
      const json& a = result["sections"][i];
      const json& b = result["sections"][k];
      const bool shorter =
          a["lddc"]["distance_ab"].get<double>() < b["lddc"]["distance_ab"].get<double>();
      agreeing += shorter == (a["relative_volume"].get<double>() > b["relative_volume"]);
    }
  EXPECT_NEAR(result["joint"]["agreement"].get<double>(), agreeing / 6.0, 1e-15);
  ASSERT_EQ(result["pieces"].size(), 1u);
  curves.push_back({{"type", "polyline"}, {"points", {{0, 0}, {0, 0}}}});
  EXPECT_EQ(answered({{"op", "curve.diagrams"}, {"curves", curves}})["ok"], false);
}

TEST(CurveDiagrams, TellSelfAffinityOfEveryPiece) {
  const auto affinity = [](const json& curve) {
    const json result = result_of({{"op", "curve.diagrams"}, {"curves", {curve}}});
    return result["sections"][0]["pieces"][0]["self_affinity"];
  };
  // From its sharp end on the curvature falls evenly from 1.2 to 0.4; the rest, from 0.8 on, has
  // two thirds of it everywhere where the parent is looked at 3/2 times as far.
  const json clothoid = affinity(spiral(-1, 1.2));
  EXPECT_LT(clothoid["deviation"].get<double>(), 1e-6);
  EXPECT_NEAR(clothoid["length_scale"].get<double>(), 1.5, 1e-4);
  EXPECT_NEAR(clothoid["radius_scale"].get<double>(), 2.0 / 3, 1e-4);
  EXPECT_TRUE(affinity(arc(1)).is_null());
  const json parabola = affinity({{"type", "bezier"}, {"points", {{0, 0}, {1, 0}, {2, 4}}}});
  EXPECT_GT(parabola["deviation"].get<double>(), 1e-3);
}

TEST(SurfacePatch, StringsTheRowsAlongTheColumn) {
  const json row{{"type", "bezier"}, {"points", {{0, 0, 0}, {1, 0, 1}, {2, 0, 1}, {3, 0, 0}}}};
  const json higher{{"type", "bezier"}, {"points", {{5, 0, 0}, {6, 0, 2}, {7, 0, 2}, {8, 0, 0}}}};
  const json column{{"type", "bezier"}, {"points", {{0, 0, 0}, {0, 1, 0.2}, {0, 2, 0.5}}}};
  const json result =
      result_of({{"op", "surface.patch"}, {"rows", {row, row, higher}}, {"column", column}});
  const json& net = result["surface"]["points"];
  EXPECT_EQ(net[1][2], json({2.0, 1.0, 1.2}));
  EXPECT_EQ(net[2][0], json({0.0, 2.0, 0.5}));  // moved by (-5, 2, 0.5)
  EXPECT_EQ(net[2][1], json({1.0, 2.0, 2.5}));
  EXPECT_NEAR(result["moved"][2].get<double>(), std::sqrt(25 + 4 + 0.25), 1e-12);
  const json few = answered({{"op", "surface.patch"}, {"rows", {row, higher}}, {"column", column}});
  EXPECT_EQ(few["error"]["path"], "rows");
}

/// Equal rows strung along a column are a translational patch: all columns alike ([Oya] 3.4).
TEST(SurfacePatch, OfOneProfileIsValuedByItsTwoCurves) {
  const json a5{{"type", "bezier"},
                {"points", {{0, 0, 0}, {0, 1, 0}, {0, 2.2, 0.4}, {0, 3.3, 1.4}}}};
  const json a1{{"type", "bezier"},
                {"points", {{0, 0, 0}, {1, 0, 0}, {2.3, 0, 0.5}, {3.5, 0, 1.7}}}};
  const json patch =
      result_of({{"op", "surface.patch"}, {"rows", {a1, a1, a1, a1}}, {"column", a5}});
  const json sav = result_of({{"op", "surface.sav"}, {"surface", patch["surface"]}});
  const double row = result_of({{"op", "curve.cav"}, {"curve", a1}})["cav"];
  const double column = result_of({{"op", "curve.cav"}, {"curve", a5}})["cav"];
  EXPECT_NEAR(sav["sav"].get<double>(), 4 * row + 4 * column, 1e-9);
}

}  // namespace
}  // namespace keyline::operations
