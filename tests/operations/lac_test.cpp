#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "keyline/core/angle.h"
#include "keyline/exchange/json/json_curve.h"
#include "keyline/operations/perform.h"

#include "../lac/reference_table.h"
#include "tests/shared_data.h"

namespace keyline::operations {
namespace {

using lac::read_reference;
using lac::ReferenceRow;
using nlohmann::json;

/// The handles of a table row: chord from (0, 0) to (1, 0), below it the turning point.
json handles(double theta, double psi) {
  const double reach = std::sin(theta - psi) / std::sin(theta);
  return {{0, 0}, {reach * std::cos(psi), -reach * std::sin(psi)}, {1, 0}};
}

/// The answer as a client sees it: through text, both ways.
json asked(const json& request) { return json::parse(answer_line(request.dump(), {})); }

double value_of(const ReferenceRow& row, const char* name) { return std::stod(row.at(name)); }

void expect_near(const json& got, const ReferenceRow& row, const char* name) {
  const double wanted = value_of(row, name);
  EXPECT_LT(std::abs(got.get<double>() - wanted) / std::abs(wanted), 1e-10)
      << name << ' ' << got << ' ' << wanted;
}

void expect_undrawable(const json& answer) {
  ASSERT_EQ(answer["ok"], false) << answer;
  EXPECT_EQ(answer["error"]["code"], "undrawable");
  EXPECT_FALSE(answer["error"].value("hint", "").empty());
}

TEST(LacSegment, AnswersTheReferenceTable) {
  const auto rows = read_reference("g1.csv");
  KEYLINE_NEEDS_SHARED_DATA(!rows.empty(), "reference tables");
  for (const ReferenceRow& row : rows) {
    SCOPED_TRACE(row.at("alpha") + " " + row.at("theta_d") + " " + row.at("psi"));
    const json answer = asked({{"op", "lac.segment"},
                               {"points", handles(value_of(row, "theta_d"), value_of(row, "psi"))},
                               {"alpha", value_of(row, "alpha")}});
    if (row.at("lambda") == "none") {
      expect_undrawable(answer);
      continue;
    }
    ASSERT_EQ(answer["ok"], true) << answer;
    const json& result = answer["result"];
    const json& piece = result["curve"]["pieces"][0];
    expect_near(result["lambda"], row, "lambda");
    expect_near(piece["length"], row, "arc_over_chord");
    expect_near(piece["curvature"][0], row, "k0_chord");
    expect_near(piece["curvature"][1], row, "k1_chord");
    EXPECT_EQ(result["reversed"], false);
  }
}

TEST(LacCompound, AnswersTheReferenceTable) {
  const auto rows = read_reference("compound.csv");
  KEYLINE_NEEDS_SHARED_DATA(!rows.empty(), "reference tables");
  for (const ReferenceRow& row : rows) {
    SCOPED_TRACE(row.at("alpha0") + " " + row.at("alpha1") + " " + row.at("theta_d") + " " +
                 row.at("psi"));
    // One row is marked "none" although the curve exists: tests/lac/compound_test.cpp.
    if (row.at("alpha0") == "0.5" && row.at("alpha1") == "-1.615") continue;
    const json answer = asked({{"op", "lac.compound"},
                               {"points", handles(value_of(row, "theta_d"), value_of(row, "psi"))},
                               {"alpha", {value_of(row, "alpha0"), value_of(row, "alpha1")}},
                               {"ratio", value_of(row, "r_theta")}});
    if (row.at("lambda0") == "none") {
      expect_undrawable(answer);
      continue;
    }
    ASSERT_EQ(answer["ok"], true) << answer;
    const json& result = answer["result"];
    const json& pieces = result["curve"]["pieces"];
    expect_near(result["lambda"][0], row, "lambda0");
    expect_near(result["lambda"][1], row, "lambda1");
    expect_near(pieces[0]["length"].get<double>() + pieces[1]["length"].get<double>(), row,
                "arc_over_chord");
    expect_near(pieces[0]["curvature"][0], row, "k0_chord");
    expect_near(pieces[0]["curvature"][1], row, "kc_chord");
    expect_near(pieces[1]["curvature"][1], row, "k1_chord");
    expect_near(result["joint"][0], row, "joint_x");
    expect_near(result["joint"][1], row, "joint_y");
  }
}

TEST(LacCompound, RefusesBadRatiosAndCounts) {
  const auto path = [](const json& changes) {
    json request{{"points", {{0, 0}, {2, 0}, {3, 1.5}}}, {"alpha", {-1, 1.5}}, {"ratio", 0.4}};
    request.update(changes);
    const auto result = perform("lac.compound", request, {});
    return result ? std::string("drawn") : result.error().path;
  };
  EXPECT_EQ(path(json::object()), "drawn");
  for (const double ratio : {0.0, 1.0, -1.0, 2.0}) EXPECT_EQ(path({{"ratio", ratio}}), "ratio");
  EXPECT_EQ(path({{"alpha", {1}}}), "alpha");
  EXPECT_EQ(path({{"alpha", {1, 2, 3}}}), "alpha");
  EXPECT_EQ(path({{"points", {{0, 0}, {1, 0}}}}), "points");
}

TEST(LacSpline, AFirstPointThatRepeatsMakesNoSpan) {
  json request{{"op", "lac.spline"},
               {"points", {{0, 0}, {3, 0}, {3, 2}, {0, 2}, {0, 0}}},
               {"closed", true},
               {"alpha", {-1, -1, -1, -1}}};
  const json result = asked(request).at("result");
  EXPECT_EQ(result.at("curve").at("pieces").size(), 4U);
  EXPECT_EQ(result.at("report").at("spans"), 4);
  request["alpha"].push_back(-1);
  const json refused = asked(request);
  EXPECT_EQ(refused["error"]["hint"], "give 1, or one for each of the 4 spans") << refused;
}

TEST(LacRegion, HoldsWhatCanBeDrawn) {
  for (const json& alpha : {json(-1.5), json(0.5), json(2), json{-1, 1.5}, json{2.0, -2.0}}) {
    SCOPED_TRACE(alpha.dump());
    json request{{"op", "lac.region"}, {"theta", 1.2}, {"alpha", alpha}};
    if (alpha.is_array()) request["ratio"] = 0.4;
    const json answer = asked(request);
    ASSERT_EQ(answer["ok"], true) << answer;
    const double low = answer["result"]["psi"][0].get<double>();
    const double high = answer["result"]["psi"][1].get<double>();
    EXPECT_NEAR(low + high, 1.2, 1e-14);
    const auto drawn = [&](double psi) {
      json draw{{"op", alpha.is_array() ? "lac.compound" : "lac.segment"},
                {"points", handles(1.2, psi)},
                {"alpha", alpha}};
      if (alpha.is_array()) draw["ratio"] = 0.4;
      return asked(draw)["ok"].get<bool>();
    };
    const double margin = 1e-3 * (high - low);
    EXPECT_TRUE(drawn(low + margin) && drawn(high - margin));
    if (high < 1.2) {
      EXPECT_FALSE(drawn(high + margin) || drawn(low - margin));
    }
  }
}

TEST(LacRegion, MarksOpenEndsAndMirrors) {
  const json involute = asked({{"op", "lac.region"}, {"theta", 1}, {"alpha", 2}})["result"];
  EXPECT_EQ(involute["open"], (json{false, false}));
  const json spiral = asked({{"op", "lac.region"}, {"theta", 1}, {"alpha", 1}})["result"];
  EXPECT_EQ(spiral["open"], (json{true, true}));
  EXPECT_EQ(spiral["psi"], (json{0.0, 1.0}));
  const json right = asked({{"op", "lac.region"}, {"theta", -1}, {"alpha", 2}})["result"];
  EXPECT_EQ(right["psi"][0].get<double>(), -involute["psi"][1].get<double>());
  const json compound =
      asked({{"op", "lac.region"}, {"theta", 1}, {"alpha", {3, 0.5}}, {"ratio", 0.5}})["result"];
  EXPECT_EQ(compound["open"], (json{false, false}));
}

TEST(LacRegion, RefusesWhatHasNoRegion) {
  const auto path = [](const json& request) { return asked(request)["error"]["path"]; };
  EXPECT_EQ(path({{"op", "lac.region"}, {"theta", 0}, {"alpha", 1}}), "theta");
  EXPECT_EQ(path({{"op", "lac.region"}, {"theta", 4}, {"alpha", 1}}), "theta");
  EXPECT_EQ(path({{"op", "lac.region"}, {"theta", 1}, {"alpha", {1, 2}}}), "ratio");
  EXPECT_EQ(path({{"op", "lac.region"}, {"theta", 1}, {"alpha", json::array()}}), "alpha");
  EXPECT_EQ(path({{"op", "lac.region"}, {"theta", 1}, {"alpha", "x"}}), "alpha");
}

using Place = std::array<double, 2>;

bool is_inside(const json& outline, const Place& p) {
  bool inside = false;
  for (std::size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++) {
    const Place a = outline[i].get<Place>();
    const Place b = outline[j].get<Place>();
    if ((a[1] > p[1]) != (b[1] > p[1]) &&
        p[0] < a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]))
      inside = !inside;
  }
  return inside;
}

double distance_to(const json& outline, const Place& p) {
  double least = HUGE_VAL;
  for (std::size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++) {
    const Place a = outline[i].get<Place>();
    const Place b = outline[j].get<Place>();
    const double x = b[0] - a[0];
    const double y = b[1] - a[1];
    const double along = ((p[0] - a[0]) * x + (p[1] - a[1]) * y) / std::max(x * x + y * y, 1e-300);
    const double t = std::clamp(along, 0.0, 1.0);
    least = std::min(least, std::hypot(a[0] + t * x - p[0], a[1] + t * y - p[1]));
  }
  return least;
}

/// Whether the curve of the operation that draws it says so.
bool is_drawn(json points, int handle, const Place& place, const json& alpha) {
  points[static_cast<std::size_t>(handle)] = place;
  json request{{"op", "lac.segment"}, {"points", points}, {"alpha", alpha}};
  if (alpha.is_array()) request.update({{"op", "lac.compound"}, {"ratio", 0.4}});
  return asked(request)["ok"].get<bool>();
}

/// Random places: in an outline exactly where the curve is drawn, the nearest as near as any drawn.
TEST(LacRegion, TellsWhereAHandleMayStand) {
  std::mt19937 dice(11);
  std::uniform_real_distribution<double> wide(-3, 4);
  const json points{{0, 0}, {1, 0}, {1.4, 0.9}};
  for (const json& alpha : {json(-1.5), json(0.5), json(2), json{2.0, -2.0}})
    for (const int handle : {0, 1, 2}) {
      SCOPED_TRACE(alpha.dump() + " handle " + std::to_string(handle));
      std::vector<Place> drawn;
      json nearest;
      Place from{};
      for (int i = 0; i < 150; ++i) {
        const Place place{wide(dice), wide(dice)};
        json request{
            {"op", "lac.region"}, {"points", points}, {"handle", handle}, {"alpha", alpha}};
        request["points"][static_cast<std::size_t>(handle)] = place;
        if (alpha.is_array()) request["ratio"] = 0.4;
        const json answer = asked(request);
        ASSERT_EQ(answer["ok"], true) << answer;
        const json& outlines = answer["result"]["outlines"];
        ASSERT_EQ(outlines.size(), 2U);
        const bool can = is_drawn(points, handle, place, alpha);
        EXPECT_EQ(answer["result"].contains("nearest"), !can) << json(place);
        if (can) drawn.push_back(place);
        if (distance_to(outlines[0], place) < 0.02 || distance_to(outlines[1], place) < 0.02)
          continue;
        EXPECT_EQ(is_inside(outlines[0], place) || is_inside(outlines[1], place), can)
            << json(place);
        if (can) continue;
        nearest = answer["result"]["nearest"];
        from = place;
      }
      EXPECT_GT(drawn.size(), 5U);
      if (nearest.is_null()) continue;  // everywhere in sight: slopes from 0 to 1
      const Place near = nearest.get<Place>();
      EXPECT_TRUE(is_drawn(points, handle, near, alpha)) << nearest;
      const double away = std::hypot(near[0] - from[0], near[1] - from[1]);
      for (const Place& p : drawn)
        EXPECT_GT(std::hypot(p[0] - from[0], p[1] - from[1]), 0.99 * away - 0.01) << json(p);
    }
}

/// Largest distance of the curve's ends from where they should be, and of their directions.
double miss(const json& result, const json& request) {
  const auto path = exchange::path_from_json(result["curve"], "curve");
  const curve::Jet2 first = jet(*path, 0);
  const curve::Jet2 last = jet(*path, std::nextafter(1.0, 0.0));
  const auto off = [&](const curve::Jet2& jet, const char* point, int end) {
    const json& p = request[point];
    const double place = distance(jet.point, {p[0].get<double>(), p[1].get<double>()});
    const double wanted = request["directions"][end].get<double>();
    return std::max(place, std::abs(core::wrap_angle(tangent_angle(jet) - wanted)));
  };
  return std::max(off(first, "start", 0), off(last, "end", 1));
}

TEST(LacHermite, MeetsEndsAndDirections) {
  struct Case {
    json directions;
    double alpha;
    const char* shape;
  };
  for (const Case& c : {Case{{0.5, -0.4}, -1, "C"}, Case{{0.8, 0.7}, -1, "S"},
                        Case{{0.8 + 4 * core::kPi, 0.7}, -3, "S"}, Case{{-0.5, 0.6}, 1.5, "C"}}) {
    const json request{{"op", "lac.hermite"},
                       {"start", {1, 2}},
                       {"end", {3, 2}},
                       {"directions", c.directions},
                       {"alpha", c.alpha}};
    const json answer = asked(request);
    ASSERT_EQ(answer["ok"], true) << answer;
    EXPECT_EQ(answer["result"]["shape"], c.shape);
    EXPECT_LT(miss(answer["result"], request), 1e-13);
  }
}

TEST(LacHermite, MeetsCurvatures) {
  const json request{{"op", "lac.hermite"},
                     {"start", {0, 0}},
                     {"end", {2, 0.5}},
                     {"directions", {0.6, -0.2}},
                     {"curvatures", {-0.3, -0.9}},
                     {"alpha", -1.5}};
  const json answer = asked(request);
  ASSERT_EQ(answer["ok"], true) << answer;
  EXPECT_LT(miss(answer["result"], request), 1e-11);
  const json& pieces = answer["result"]["curve"]["pieces"];
  EXPECT_EQ(pieces.front()["curvature"][0], -0.3);
  EXPECT_EQ(pieces.back()["curvature"][1], -0.9);
}

TEST(LacHermite, SaysWhyNot) {
  json request{{"op", "lac.hermite"},
               {"start", {0, 0}},
               {"end", {2, 0}},
               {"directions", {0.8, 0.7}},
               {"alpha", 1}};
  expect_undrawable(asked(request));
  request["directions"] = {1};
  EXPECT_EQ(asked(request)["error"]["path"], "directions");
  request["directions"] = {1, 2};
  request["end"] = {0, 0};
  EXPECT_EQ(asked(request)["error"]["code"], "bad-input");
}

}  // namespace
}  // namespace keyline::operations
