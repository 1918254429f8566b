// lac.raise_joints, judged by the law of the pieces and quadrature of the tests' own.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "own_numerics.h"
#include "worst.h"

namespace keyline::operations {
namespace {

using nlohmann::json;
using own::answered;
using own::result_of;
using own::uniform;
using Random = std::mt19937_64;

json piece(double alpha, double length, double k0, double k1) {
  return {{"alpha", alpha}, {"length", length}, {"curvature", {k0, k1}}};
}
json chain(std::vector<json> pieces) {
  return {
      {"type", "log-aesthetic"}, {"start", {0.3, -0.2}}, {"direction", 0.4}, {"pieces", pieces}};
}
json raised(const json& curve) {
  return result_of({{"op", "lac.raise_joints"}, {"curve", curve}, {"hold", "joints"}});
}

/// dkappa/ds at an end, from kappa^-alpha being linear in the length (alpha = 0: its logarithm).
double rate(const json& p, int end) {
  const long double alpha = p["alpha"].get<double>(), length = p["length"].get<double>();
  const long double k0 = p["curvature"][0].get<double>(), k1 = p["curvature"][1].get<double>();
  const auto power = [&](long double k) {
    return (k < 0 ? -1 : 1) * std::pow(std::abs(k), -alpha);
  };
  const long double k = end == 0 ? k0 : k1;
  if (alpha == 0) return static_cast<double>(k * std::log(k1 / k0) / length);
  return static_cast<double>(std::pow(std::abs(k), 1 + alpha) * (power(k1) - power(k0)) /
                             (-alpha * length));
}

/// A run whose curvature rises (or falls) from the first to the last piece, by a factor each.
json any_run(Random& random, int pieces, double least = 1.15, double most = 2.6) {
  const bool rising = random() % 2 == 0;
  const double side = random() % 2 == 0 ? 1 : -1;
  double k = uniform(random, 0.2, 1.2);
  std::vector<json> all;
  for (int i = 0; i < pieces; ++i) {
    const double growth = uniform(random, least, most);
    const double next = rising ? k * growth : k / growth;
    all.push_back(piece(random() % 4 == 0 ? -1 : uniform(random, -3, 3),
                        uniform(random, 0.2, 1.2) / std::max(k, next), side * k, side * next));
    k = next;
  }
  return chain(all);
}

/// Places the new curve passes of the given one's joints, and how far off it is there.
double largest_miss(const json& given, const json& now, std::size_t parts) {
  const own::Track a = own::walked(given), b = own::walked(now);
  double most = 0;
  for (std::size_t i = 0; i < a.joints.size(); ++i) {
    const own::Place& p = a.places[a.joints[i]];
    const own::Place& q = b.places[b.joints[std::min(parts * i, b.joints.size() - 1)]];
    most = std::max({most, std::hypot(p.x - q.x, p.y - q.y), std::abs(p.direction - q.direction)});
  }
  return most;
}

/// The same curve as so many pieces for one, by the law of a piece: kappa^-alpha is linear.
std::vector<own::Place> finely(const json& curve, int cuts) {
  json fine = curve;
  fine["pieces"] = json::array();
  for (const json& p : curve["pieces"]) {
    const double alpha = p["alpha"], k0 = p["curvature"][0], k1 = p["curvature"][1];
    const auto at = [&](int i) {
      const double t = static_cast<double>(i) / cuts;
      if (i == 0 || i == cuts) return i == 0 ? k0 : k1;
      if (std::abs(alpha) < 1e-9) return k0 * std::pow(k1 / k0, t);
      // By their ratio: the power itself of 0.0073 to -150 overflows.
      return k0 * std::pow(std::lerp(1.0, std::pow(k1 / k0, -alpha), t), -1 / alpha);
    };
    for (int i = 0; i < cuts; ++i)
      fine["pieces"].push_back(piece(alpha, p["length"].get<double>() / cuts, at(i), at(i + 1)));
  }
  return own::walked(fine).places;
}

/// Largest distance of places of one from the other: from chords so short that they are off by
/// less than 1e-6 of its length.
double departure(const json& a, const json& b) {
  const auto line = finely(b, 200);
  double most = 0;
  for (const own::Place& p : finely(a, 20)) {
    double nearest = 1e300;
    for (std::size_t i = 1; i < line.size(); ++i) {
      const own::Place &u = line[i - 1], &v = line[i];
      const double x = v.x - u.x, y = v.y - u.y;
      const double t = std::clamp(((p.x - u.x) * x + (p.y - u.y) * y) / (x * x + y * y), 0.0, 1.0);
      nearest = std::min(nearest, std::hypot(p.x - u.x - t * x, p.y - u.y - t * y));
    }
    most = std::max(most, nearest);
  }
  return most;
}

TEST(RaiseJoints, RunsBecomeG3AndKeepTheirJoints) {
  Random random(own::seed(41));
  own::Worst rates("rates"), places("places");
  int joints = 0, refused = 0;
  for (int n = 0; n < own::requests(0.02); ++n) {
    const int pieces = 2 + static_cast<int>(random() % 5);
    const json given = any_run(random, pieces);
    SCOPED_TRACE(given.dump());
    const json result = raised(given);
    joints += pieces - 1;
    refused += pieces - 1 - result["raised"].get<int>();
    EXPECT_EQ(own::faults(result["curve"]), std::vector<std::string>{});
    const json& now = result["curve"]["pieces"];
    if (result["raised"] != pieces - 1) continue;
    for (std::size_t i = 1; i < now.size(); ++i) {
      EXPECT_EQ(now[i - 1]["curvature"][1], now[i]["curvature"][0]);
      const double r0 = rate(now[i - 1], 1), r1 = rate(now[i], 0);
      rates.expect_below(std::abs(r1 - r0) / std::abs(r0), 1e-9);
    }
    places.expect_below(largest_miss(given, result["curve"], now.size() / pieces), 1e-11);
    const double told = result["departure"], length = own::walked(given).length;
    EXPECT_GE(told + 1e-6 * length, departure(given, result["curve"]));
    EXPECT_GE(told + 1e-6 * length, departure(result["curve"], given));
    EXPECT_LT(told, 0.01 * length);
  }
  RecordProperty("refused", std::to_string(refused) + " of " + std::to_string(joints));
  EXPECT_EQ(refused, 0);
}

/// Rates of both sides differ by 200 beside a piece whose curvature hardly grows: three parts for a
/// piece do not do, four do, also where no limit is given.
TEST(RaiseJoints, FourPartsWhereThreeDoNotDo) {
  const json given = chain(
      {piece(-1.2746399817545633, 0.7321055716720599, -0.9049558793180952, -1.2199679806186465),
       piece(0.17593849929187666, 0.30226155232655866, -1.2199679806186465, -2.3554949667015594),
       piece(-0.48795106535182775, 0.12965112067657275, -2.3554949667015594, -5.1156640824259965),
       piece(-0.714320444992385, 0.05119271237441505, -5.1156640824259965, -11.705681139003927),
       piece(-1.0, 0.0643380068823079, -11.705681139003927, -13.599657756062156),
       piece(-2.5245067213970027, 0.0073108099666444725, -13.599657756062156, -32.94161525391818)});
  const json result = raised(given);
  const json& now = result["curve"]["pieces"];
  EXPECT_EQ(result["raised"], 5);
  ASSERT_EQ(now.size(), 24u);
  for (std::size_t i = 1; i < now.size(); ++i)
    EXPECT_NEAR(rate(now[i], 0) / rate(now[i - 1], 1), 1, 1e-9);
  EXPECT_LT(largest_miss(given, result["curve"], 4), 1e-11);
  const double told = result["departure"], length = own::walked(given).length;
  EXPECT_GE(told + 1e-6 * length, departure(given, result["curve"]));
  EXPECT_LT(told, 0.01 * length);
}

TEST(RaiseJoints, WithoutNewPiecesWhereOnlyTheEndsAreHeld) {
  Random random(own::seed(43));
  for (int n = 0; n < own::requests(0.02); ++n) {
    const std::size_t pieces = 2 + random() % 4;
    const json given = any_run(random, static_cast<int>(pieces));
    SCOPED_TRACE(given.dump());
    const json result = result_of({{"op", "lac.raise_joints"}, {"curve", given}});
    const json& now = result["curve"]["pieces"];
    ASSERT_EQ(now.size(), pieces);
    EXPECT_EQ(result["raised"].get<std::size_t>(), pieces - 1);
    for (std::size_t i = 1; i < pieces; ++i) {
      const own::Place place =
          own::walked(result["curve"]).places[own::walked(result["curve"]).joints[i]];
      EXPECT_NEAR(rate(now[i], 0) / rate(now[i - 1], 1), 1, 1e-9);
      EXPECT_NEAR(result["joints"][i - 1]["place"][0].get<double>(), place.x, 1e-9);
    }
    EXPECT_EQ(now[0]["curvature"][0], given["pieces"][0]["curvature"][0]);
    EXPECT_EQ(now[pieces - 1]["curvature"][1], given["pieces"][pieces - 1]["curvature"][1]);
    const own::Track a = own::walked(given), b = own::walked(result["curve"]);
    EXPECT_LT(std::hypot(a.end().x - b.end().x, a.end().y - b.end().y), 1e-10);
    EXPECT_LT(std::abs(own::wrapped(a.end().direction - b.end().direction)), 1e-10);
    const double told = result["departure"];
    EXPECT_GE(told + 1e-6 * a.length, departure(given, result["curve"]));
    EXPECT_GE(told + 1e-6 * a.length, departure(result["curve"], given));
  }
}

/// Curvature that hardly grows leaves the slopes much to do: rates differ as much as in other runs.
TEST(RaiseJoints, NearlyAllOfLongRunsThatHardlyGrow) {
  Random random(own::seed(44));
  int raised_joints = 0, joints = 0;
  for (int n = 0; n < std::max(8, own::requests(0.002)); ++n) {
    const json given = any_run(random, 20, 1.05, 1.35);
    SCOPED_TRACE(given.dump());
    const json result = raised(given);
    EXPECT_LT(result["departure"].get<double>(), 1e-3 * own::walked(given).length);
    raised_joints += result["raised"].get<int>();
    joints += 19;
  }
  RecordProperty("raised", std::to_string(raised_joints) + " of " + std::to_string(joints));
  EXPECT_GE(raised_joints, 0.9 * joints);
}

TEST(RaiseJoints, TheSameInAMirrorAndBackwards) {
  Random random(own::seed(42));
  for (int n = 0; n < own::requests(0.03); ++n) {
    const json given = any_run(random, 3);
    json mirror = given, back = given;
    for (json& p : mirror["pieces"])
      for (json& k : p["curvature"]) k = -k.get<double>();
    std::reverse(back["pieces"].begin(), back["pieces"].end());
    for (json& p : back["pieces"])
      p["curvature"] = {-p["curvature"][1].get<double>(), -p["curvature"][0].get<double>()};
    const json result = raised(given);
    EXPECT_NEAR(raised(mirror)["departure"].get<double>(), result["departure"].get<double>(), 1e-8);
    EXPECT_EQ(raised(back)["raised"], result["raised"]);
  }
}

TEST(RaiseJoints, CurvatureMayVanishOnTheWay) {
  // Inside a piece, and at a joint: there both sides become clothoids.
  for (const json& given :
       {chain({piece(-1, 1, -0.5, 0.4), piece(-0.6, 1, 0.4, 1.3)}),
        chain({piece(-2, 1, -1, -0.4), piece(-0.5, 1.1, -0.4, 0.7), piece(1, 0.5, 0.7, 1.1)}),
        chain({piece(-1, 1, -0.8, 0), piece(-1, 0.7, 0, 1)}),
        chain({piece(-0.9, 1, -0.8, 0), piece(-1.2, 0.9, 0, 1), piece(0.5, 0.5, 1, 1.4)})}) {
    SCOPED_TRACE(given.dump());
    const json result = raised(given);
    EXPECT_EQ(result["raised"].get<std::size_t>(), given["pieces"].size() - 1) << result;
    const json& now = result["curve"]["pieces"];
    for (std::size_t i = 1; i < now.size(); ++i) {
      const double r0 = now[i]["curvature"][0] == 0 ? NAN : rate(now[i - 1], 1);
      if (std::isnan(r0)) {
        EXPECT_EQ(now[i - 1]["alpha"], -1);
        EXPECT_EQ(now[i]["alpha"], -1);
        const double before =
            -now[i - 1]["curvature"][0].get<double>() / now[i - 1]["length"].get<double>();
        EXPECT_NEAR(now[i]["curvature"][1].get<double>() / now[i]["length"].get<double>() / before,
                    1, 1e-9);
      } else {
        EXPECT_NEAR(rate(now[i], 0) / r0, 1, 1e-9);
      }
    }
    const own::Place end = own::walked(given).end(), reached = own::walked(result["curve"]).end();
    EXPECT_LT(std::hypot(end.x - reached.x, end.y - reached.y), 1e-11);
  }
}

TEST(RaiseJoints, EveryJointThatStaysSaysWhy) {
  const json given = chain({piece(-1, 1, 0.1, 0.3), piece(0.5, 1, 0.3, 0.9), piece(-1, 1, 0.9, 0.4),
                            piece(-1, 1, 0.4, 0.4), piece(-1, 1, 0.5, 1), piece(-1, 1, 1, 1.5)});
  const json result = raised(given);
  const char* fates[] = {"raised", "turn", "constant", "jump", "already"};
  ASSERT_EQ(result["joints"].size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) {
    const json& joint = result["joints"][i];
    EXPECT_EQ(joint["fate"], fates[i]) << i;
    EXPECT_EQ(joint.contains("why"), i > 0 && i < 4) << joint;
    EXPECT_EQ(joint["piece"], i + 1);
  }
  EXPECT_EQ(result["raised"], 1);
  // What is beside no raised joint is as given.
  const json& now = result["curve"]["pieces"];
  ASSERT_EQ(now.size(), 10U);
  for (std::size_t i = 2; i < 6; ++i) EXPECT_EQ(now[i + 4], given["pieces"][i]);
}

TEST(RaiseJoints, StayWithinTheirLimit) {
  const json given = chain({piece(-1, 1, 0.1, 0.3), piece(2, 1, 0.3, 0.9), piece(-1, 1, 0.9, 1.4)});
  const double free = raised(given)["departure"];
  ASSERT_GT(free, 0);
  const json held = result_of(
      {{"op", "lac.raise_joints"}, {"curve", given}, {"hold", "joints"}, {"limit", free * 1e-3}});
  EXPECT_LE(held["departure"].get<double>(), free * 1e-3);
  EXPECT_LT(held["raised"].get<int>(), 2);
  bool told = false;
  for (const json& joint : held["joints"]) told |= joint["fate"] == "beyond-limit";
  EXPECT_TRUE(told);
  const json wrong = answered({{"op", "lac.raise_joints"},
                               {"curve", {{"type", "polyline"}, {"points", {{0, 0}, {1, 0}}}}}});
  EXPECT_EQ(wrong["error"]["code"], "unsupported");
}

}  // namespace
}  // namespace keyline::operations
