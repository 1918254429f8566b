#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "random_values.h"
#include "worst.h"

/// lac.space with two slopes and data in a plane, asked at random for curves that begin at an
/// inflection or go through one (see random_requests_test.cpp).
namespace keyline::operations {
namespace {

using nlohmann::json;
using own::answered;
using own::Random;
using own::uniform;
using own::Worst;

/// Curvature a length s on from where it is 1 and has a rate, by the law of a slope.
std::optional<double> carried(double alpha, double rate, double s) {
  if (std::abs(alpha) < 1e-9) return std::exp(rate * s);
  const double base = 1 - alpha * rate * s;
  if (base > 1e-9) return std::pow(base, -1 / alpha);
  if (alpha > 0) return std::nullopt;
  return std::abs(base) <= 1e-9 ? 0.0 : -std::pow(-base, -1 / alpha);
}

struct Rhythm {
  double alpha0 = -1, alpha1 = 1, share = 0.5;
};

/// A plane curve of two pieces with one rate at the joint, `rate` of the curvature there.
std::optional<json> plane_curve(const Rhythm& r, double rate, double size) {
  const auto first = carried(r.alpha0, -rate, r.share);
  const auto last = carried(r.alpha1, rate, 1 - r.share);
  constexpr double kSharpest = 30;  // a track of windings without number would fill the memory
  if (!first || !last || size * std::max(std::abs(*first), std::abs(*last)) > kSharpest)
    return std::nullopt;
  const auto piece = [&](double alpha, double length, double from, double to) {
    return json{{"alpha", alpha}, {"length", length}, {"curvature", {size * from, size * to}}};
  };
  return json{
      {"type", "log-aesthetic"},
      {"start", {0, 0}},
      {"direction", 0},
      {"pieces", {piece(r.alpha0, r.share, *first, 1), piece(r.alpha1, 1 - r.share, 1, *last)}}};
}

double turned(const own::Track& track) {
  double sum = 0;
  for (std::size_t i = 1; i < track.places.size(); ++i)
    sum += std::abs(track.places[i].direction - track.places[i - 1].direction);
  return sum;
}

json in_space(const Rhythm& r, const own::Place& end, double mirror) {
  return {{"op", "lac.space"},
          {"start", {0, 0, 0}},
          {"end", {end.x, mirror * end.y, 0}},
          {"tangents", {{1, 0, 0}, {std::cos(end.direction), mirror * std::sin(end.direction), 0}}},
          {"alpha", {r.alpha0, r.alpha1}},
          {"beta", -1},
          {"omega", 0.1},
          {"ratio", r.share}};
}

json run_back(json request) {
  for (json& x : request["end"]) x = -x.get<double>();
  std::swap(request["tangents"][0], request["tangents"][1]);
  for (json& t : request["tangents"])
    for (json& x : t) x = -x.get<double>();
  std::swap(request["alpha"][0], request["alpha"][1]);
  request["ratio"] = 1 - request["ratio"].get<double>();
  return request;
}

/// The answer in its plane z = 0, to be walked through.
json flat(const json& curve) {
  const json& t = curve["frame"][0];
  json plane{{"type", "log-aesthetic"},
             {"start", {curve["start"][0], curve["start"][1]}},
             {"direction", std::atan2(t[1].get<double>(), t[0].get<double>())},
             {"pieces", curve["pieces"]}};
  const double side = curve["frame"][2][2].get<double>() < 0 ? -1 : 1;
  for (json& p : plane["pieces"])
    for (json& k : p["curvature"]) k = side * k.get<double>();
  return plane;
}

/// Rate of curvature at the start (end: 1) of a piece, from its ends by its law.
double rate_at(const json& piece, int end) {
  const double alpha = piece["alpha"], length = piece["length"];
  const double k0 = piece["curvature"][0], k1 = piece["curvature"][1], k = end == 0 ? k0 : k1;
  if (std::abs(alpha) < 1e-9) return k * std::log(k1 / k0) / length;
  const auto power = [&](double x) { return std::copysign(std::pow(std::abs(x), -alpha), x); };
  return std::pow(std::abs(k), 1 + alpha) * (power(k1) - power(k0)) / (-alpha * length);
}

struct Drawn {
  Rhythm rhythm;
  own::Track track;
};

/// Curves that begin at an inflection, and ones that go through it.
std::optional<Drawn> any_drawn(Random& random) {
  const double steep[] = {-1, -0.5, -2, uniform(random, -3, -0.2)};
  const double any[] = {-1, 0, 1, 2, uniform(random, -3, 3)};
  const Rhythm r{steep[random() % 4], any[random() % 5], uniform(random, 0.1, 0.9)};
  const double to_start = -1 / (r.alpha0 * r.share);
  const double rate = random() % 2 == 0 ? to_start : to_start * uniform(random, 1, 4);
  if (r.alpha1 > 0 && rate > 0.98 / (r.alpha1 * (1 - r.share))) return std::nullopt;
  const auto curve = plane_curve(r, rate, own::power_of_ten(random, -1, 0.8));
  if (!curve) return std::nullopt;
  Drawn d{r, own::walked(*curve)};
  const bool calm = turned(d.track) < 2.8 && std::hypot(d.track.end().x, d.track.end().y) > 0.2;
  return calm ? std::optional(std::move(d)) : std::nullopt;
}

TEST(RandomPlaneRhythms, BeginAtOrGoThroughAnInflection) {
  Random random(own::seed(81));
  Worst worst("end");
  const int count = own::requests(0.03);
  for (int n = 0; n < count;) {
    const auto drawn = any_drawn(random);
    if (!drawn) continue;
    ++n;
    const own::Place& end = drawn->track.end();
    const json request = in_space(drawn->rhythm, end, 1);
    SCOPED_TRACE(request.dump());
    const json result = own::result_of(request);
    ASSERT_TRUE(result.contains("curve"));
    EXPECT_EQ(result["planar"], true);
    const json plane = flat(result["curve"]);
    const own::Track track = own::walked(plane);
    const double chord = std::hypot(end.x, end.y);
    worst.expect_below(std::hypot(track.end().x - end.x, track.end().y - end.y) / chord, 1e-11);
    worst.expect_below(std::abs(own::wrapped(track.end().direction - end.direction)), 1e-11);
    worst.expect_below(std::abs(track.places[0].direction), 1e-11);
    EXPECT_LT(turned(track), turned(drawn->track) * (1 + 1e-9));  // the one that turns least
    const json& pieces = plane["pieces"];
    EXPECT_NEAR(pieces[0]["length"].get<double>() / track.length, drawn->rhythm.share, 1e-12);
    EXPECT_EQ(pieces[0]["curvature"][1], pieces[1]["curvature"][0]);
    const double rate = rate_at(pieces[0], 1);
    EXPECT_NEAR(rate_at(pieces[1], 0), rate, 1e-8 * std::abs(rate));
    for (const json& other : {in_space(drawn->rhythm, end, -1), run_back(request)})
      EXPECT_NEAR(own::result_of(other)["length"].get<double>() / track.length, 1, 1e-9) << other;
  }
}

/// Of these several curves meet the data, and one way round found another than the other. The least
/// turning is that of a search on a grid 8 times as dense.
TEST(RandomPlaneRhythms, TheCurveThatTurnsLeastIsFoundFromEitherEnd) {
  struct Known {
    Rhythm rhythm;
    own::Place end;
    double turning;
  };
  const auto towards = [](double x, double y, double tx, double ty) {
    own::Place end;
    end.x = x;
    end.y = y;
    end.direction = std::atan2(ty, tx);
    return end;
  };
  const Known known[] = {
      {{-2, 2, 0.7813204798899717},
       towards(0.991711652589218, -0.11656943168402077, 0.9999769792732962, -0.006785346229471649),
       0.354441},
      {{-1.758235333382902, -1, 0.8995923274628501},
       towards(0.999119444242301, -0.03473314283145471, 0.999762388372506, 0.021798320937687996),
       0.136930},
      // All but e^-10 of what the second piece bears: its curvature grows 23,000 times.
      {{-2, 1, 0.6076109436475291},
       towards(0.9345921446183115, -0.030756747658308416, 0.5134956143236548, 0.8580922176959609),
       1.253982}};
  for (const Known& k : known) {
    const json request = in_space(k.rhythm, k.end, 1);
    for (const json& asked : {request, run_back(request)}) {
      const json curve = own::result_of(asked)["curve"];
      EXPECT_NEAR(turned(own::walked(flat(curve))), k.turning, 1e-5) << asked;
    }
  }
}

TEST(RandomPlaneRhythms, AnInflectionThatNoRateAllowsIsRefusedWithItsReason) {
  // The second piece bears rates up to 1 / (alpha share) of the curvature; the first would take
  // 1 / share to come out of an inflection.
  json request = in_space({-1, 1, 0.4}, {1, 0, 0}, 1);
  request["tangents"] = {{1, 0.5, 0}, {1, 0.5, 0}};
  const json answer = answered(request);
  EXPECT_EQ(answer["error"]["code"], "undrawable") << answer;
  request["ratio"] = 0.9;
  EXPECT_EQ(answered(request)["ok"], true);
}

/// What a tangent keeps of its direction across the chord has few digits: 2.7e-6 of it.
TEST(RandomPlaneRhythms, ATangentNextToTheChordCostsNoDigits) {
  own::Place end;
  end.x = 0.9995969987550086;
  end.y = 2.7028404791656913e-06;
  end.direction = std::atan2(0.07067542172675434, 0.997499365796162);
  const json request = in_space({-2, -1.321888890135827, 0.48301886370881986}, end, 1);
  const own::Place met = own::walked(flat(own::result_of(request)["curve"])).end();
  EXPECT_NEAR(met.x, end.x, 1e-13);
  EXPECT_NEAR(met.y, end.y, 1e-13);
  EXPECT_NEAR(met.direction, end.direction, 1e-13);
}

/// Equal tangents on one side of the chord: a clothoid with the inflection in its middle.
TEST(RandomPlaneRhythms, OneSlopeTurnsBackAsMuch) {
  json request = in_space({-1, -1, 0.5}, {2, 0, 0}, 1);
  request["tangents"] = {{1, 0.5, 0}, {1, 0.5, 0}};
  request["alpha"] = -1;
  const json result = own::result_of(request);
  const json curvature = result["curve"]["pieces"][0]["curvature"];
  EXPECT_NEAR(curvature[0].get<double>(), -curvature[1].get<double>(), 1e-12);
  const own::Track track = own::walked(flat(result["curve"]));
  EXPECT_NEAR(track.end().x, 2, 1e-12);
  EXPECT_NEAR(track.end().y, 0, 1e-12);
}

}  // namespace
}  // namespace keyline::operations
