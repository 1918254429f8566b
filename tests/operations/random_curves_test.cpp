#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "own_curves.h"
#include "random_values.h"
#include "worst.h"

/// Requests to curve.* drawn at random, their answers judged by numerics of the tests' own
/// (own_curves.h): 2,000 of all kinds together with those of fit.* and surface.*, with KEYLINE_FULL
/// set 1e5.
namespace keyline::operations {
namespace {

using namespace own;

std::string digest(const json& request) { return request.dump().substr(0, 1200); }

json one_or_more(Random& random) {
  if (random() % 3 == 0) return any_bspline(random);
  return any_bezier(random);
}

/// Curvature at many places of a planar curve; those next to a cusp too.
std::vector<double> curvatures(const std::vector<Bezier>& curve, int each) {
  std::vector<double> all;
  for (const Spot& s : spots(curve, each)) all.push_back(curvature(s));
  return all;
}

/// The share of the range by which curvature turns back: 0 where it is monotone.
double turned_back(const std::vector<double>& k) {
  double up = 0, down = 0, high = k[0], low = k[0];
  for (const double x : k) {
    high = std::max(high, x);
    low = std::min(low, x);
    down = std::max(down, high - x);
    up = std::max(up, x - low);
  }
  return std::min(up, down) / std::max(high - low, 1e-300);
}

/// Whether curvature rises somewhere and falls somewhere: at many places, halving towards the ends
/// of every piece and around the witness.
bool turns(const std::vector<Bezier>& curve, double witness) {
  bool up = false, down = false;
  const auto look = [&](const Bezier& c, double t) {
    if (t < 0 || t > 1) return;
    const double rate = curvature_rate(c, t);
    up = up || rate > 0;
    down = down || rate < 0;
  };
  double last = NAN;
  for (const Bezier& c : curve) {
    for (int k = 0; k <= 1000; ++k) look(c, k / 1000.0);
    for (double step = 0.5; step > 1e-12; step /= 2)
      for (const double t : {step, 1 - step, witness + step, witness - step}) look(c, t);
    const double first = curvature(spot(c, 0));
    up = up || first > last * (1 + 1e-9);  // a joint may jump
    down = down || first < last * (1 - 1e-9);
    last = curvature(spot(c, 1));
  }
  return up && down;
}

std::size_t sign_changes(const std::vector<double>& k) {
  std::size_t count = 0;
  double before = 0;
  for (const double x : k) {
    count += before * x < 0;
    if (x != 0) before = x;
  }
  return count;
}

/// The largest distance of the places from the curve.
double farthest_from(const std::vector<Bezier>& curve, const std::vector<Vec>& places) {
  double most = 0;
  for (const Vec& p : places) most = std::max(most, distance_from(curve, p));
  return most;
}
std::vector<Vec> places_of(const std::vector<Bezier>& curve, int each) {
  std::vector<Vec> all;
  for (const Spot& s : spots(curve, each)) all.push_back(s.place);
  return all;
}

/// What of an analysis must be the same of the curve reversed, in a mirror or of another size.
json unmoved(const json& result, bool turned) {
  json all{{"monotone", result["monotone"]},
           {"inflections", result["inflections"].size()},
           {"extrema", result["extrema"].size()}};
  json rhythms = json::array();
  for (const json& p : result["pieces"]) rhythms.push_back(p["rhythm"]);
  if (turned) std::reverse(rhythms.begin(), rhythms.end());
  all["rhythms"] = rhythms;
  return all;
}

TEST(RandomCurves, AreMeasuredRight) {
  Random random(11);
  Worst worst_length("length"), worst_volume("volume");
  int yes = 0, no = 0, undecided = 0;
  for (int n = 0; n < requests(0.01); ++n) {
    const json curve = one_or_more(random);
    const json request{{"op", "curve.analyze"}, {"curve", curve}, {"plot_samples", 11}};
    SCOPED_TRACE(digest(request));
    const json result = result_of(request);
    EXPECT_EQ(holes(result, {"gradient", "slope", "intercept", "variance"}),
              std::vector<std::string>{});
    const auto beziers = beziers_of(curve);
    const double length = length_of(beziers);
    worst_length.expect_below(std::abs(result["length"].get<double>() / length - 1), 1e-9);
    worst_volume.expect_below(
        std::abs(result["volume"].get<double>() - volume_of(beziers)) / (length * length), 1e-9);
    const auto k = curvatures(beziers, 400);
    const auto [least, most] = std::ranges::minmax(k);
    const double spread = most - least;
    EXPECT_LE(result["curvature"]["min"].get<double>(), least + 1e-6 * spread);
    EXPECT_GE(result["curvature"]["max"].get<double>(), most - 1e-6 * spread);
    if (result["merged"].empty()) {
      EXPECT_EQ(result["inflections"].size(), sign_changes(k));
    }
    const std::string monotone = result["monotone"];
    yes += monotone == "yes";
    no += monotone == "no";
    undecided += monotone == "undecided";
    if (monotone == "yes") {
      EXPECT_LT(turned_back(k), 1e-9);
    }
    if (monotone == "no") {
      EXPECT_TRUE(turns(beziers, result["witness"]));
    }
    for (const auto& [other, turned] : {std::pair{mirrored(curve), false},
                                        {own::reversed(curve), true},
                                        {scaled(curve, 8), false}}) {
      json again = request;
      again["curve"] = other;
      EXPECT_EQ(unmoved(result_of(again), turned), unmoved(result, false)) << digest(again);
    }
  }
  EXPECT_GT(yes, 0);
  EXPECT_GT(no, yes);
  EXPECT_LT(undecided, 1 + requests(0.01) / 50);
}

/// A curve of one matrix, whose edges turn by alpha and grow by s.
json matrix_curve(double alpha, double s, int degree, const Frame2& frame) {
  json points = json::array({frame(0, 0)});
  double x = 0, y = 0, heading = 0, edge = 1;
  for (int i = 0; i < degree; ++i) {
    x += edge * std::cos(heading);
    y += edge * std::sin(heading);
    points.push_back(frame(x, y));
    heading += alpha;
    edge *= s;
  }
  return {{"type", "bezier"}, {"points", points}};
}

TEST(RandomCurves, HaveTheirPlaceEnergyAndMinimumInThePlane) {
  Random random(12);
  Worst worst_energy("energy"), worst_place("place"), worst_end("end of the minimum");
  for (int n = 0; n < requests(0.01); ++n) {
    const double alpha = uniform(random, 0.02, 1), s = uniform(random, 1, 2);
    const int degree = 2 + static_cast<int>(random() % 5);
    const Frame2 frame = any_frame(random);
    const json curve = matrix_curve(sign(random) * alpha, s, degree, frame);
    const json request{{"op", "curve.cav"}, {"curve", curve}, {"end_tolerance", 0}};
    SCOPED_TRACE(digest(request));
    const json answer = answered(request);
    const bool class_a = s >= 1 / std::cos(alpha) * (1 + 1e-9);
    if (answer["ok"] == false) {
      EXPECT_EQ(answer["error"]["code"], "undrawable") << answer;
      EXPECT_FALSE(class_a);  // it would be its own minimum's neighbour
      continue;
    }
    const json& result = answer["result"];
    EXPECT_EQ(holes(result), std::vector<std::string>{});
    const Bezier bezier = beziers_of(curve)[0];
    worst_energy.expect_below(std::abs(result["energy"].get<double>() / energy_of(bezier) - 1),
                              1e-8);
    worst_place.expect_below(std::abs(result["alpha"].get<double>() - alpha), 1e-6);
    worst_place.expect_below(std::abs(result["s"].get<double>() - s), 1e-6);
    const int type = result["type"];
    if (class_a) {
      EXPECT_LE(type, 2);
      EXPECT_LT(turned_back(curvatures({bezier}, 400)), 1e-9);
      EXPECT_EQ(result["monotone"], "yes");
    } else if (s < 1 / std::cos(alpha) * (1 - 1e-9)) {
      EXPECT_EQ(type, 3);
    }
    // The minimum: Class A, ends where it must, and bends as much as it says, no more than this.
    const json& m = result["minimum"];
    const double ma = m["alpha"], ms = m["s"];
    EXPECT_GE(ms, 1 / std::cos(ma) * (1 - 1e-9));
    const json flat = matrix_curve(ma, ms, degree, {0, 0, 0, frame.size * m["beta"].get<double>()});
    const json own_flat = matrix_curve(alpha, s, degree, {0, 0, 0, frame.size});
    worst_end.expect_below(
        distance(vec(flat["points"].back()), vec(own_flat["points"].back())) / frame.size, 1e-8);
    worst_energy.expect_below(
        std::abs(m["energy"].get<double>() / energy_of(beziers_of(flat)[0]) - 1), 1e-8);
    if (class_a) {
      EXPECT_LE(m["energy"].get<double>(), result["energy"].get<double>() * (1 + 1e-9));
    }
    for (const json& other : {mirrored(curve), own::reversed(curve), scaled(curve, 8)}) {
      json again = request;
      again["curve"] = other;
      EXPECT_NEAR(result_of(again)["cav"], result["cav"].get<double>(), 1e-6);
      EXPECT_EQ(result_of(again)["type"], type);
    }
  }
}

TEST(RandomCurves, AreEditedToTheirMinimum) {
  Random random(13);
  int edited = 0;
  for (int n = 0; n < requests(0.03); ++n) {
    const json curve = any_bezier(random, 2, 6);
    const double amount = random() % 2 == 0 ? 1 : uniform(random, 0, 1);
    const json request{{"op", "curve.edit"},
                       {"curve", curve},
                       {"amount", amount},
                       {"end_tolerance", 0},
                       {"direction", "as-given"}};
    SCOPED_TRACE(digest(request));
    const json answer = answered(request);
    if (answer["ok"] == false) {
      EXPECT_EQ(answer["error"]["code"], "undrawable") << answer;
      continue;
    }
    ++edited;
    const json& result = answer["result"];
    EXPECT_EQ(holes(result, {"alpha", "s", "cav", "minimum", "nearest"}),
              std::vector<std::string>{});
    const Bezier from = beziers_of(curve)[0], to = beziers_of(result["curve"])[0];
    const double chord = length_of(from);
    EXPECT_LT(distance(spot(from, 0).place, spot(to, 0).place), 1e-12 * chord);
    EXPECT_LT(distance(spot(from, 1).place, spot(to, 1).place), 1e-8 * chord);
    EXPECT_LT(std::abs(wrapped(direction(spot(from, 0)) - direction(spot(to, 0)))), 1e-8);
    if (amount < 1) continue;
    EXPECT_EQ(result["after"]["type"], 1);
    EXPECT_LT(result["after"]["cav"].get<double>(), 1e-5);
    EXPECT_LT(turned_back(curvatures({to}, 400)), 1e-6);
    EXPECT_NEAR(result["after"]["energy"].get<double>() / energy_of(to), 1, 1e-8);
  }
  EXPECT_GT(edited, requests(0.03) / 10);
}

json any_path(Random& random) {
  const Frame2 frame = any_frame(random);
  json path{{"type", "path"}, {"curves", json::array()}, {"closed", false}};
  json at = frame(0, 0);
  const std::size_t count = 2 + random() % 3;
  for (std::size_t i = 0; i < count; ++i) {
    json points = any_points(random, 3 + random() % 3, frame, random() % 2 == 0);
    const double dx = at[0].get<double>() - points[0][0].get<double>();
    const double dy = at[1].get<double>() - points[0][1].get<double>();
    for (json& p : points) p = {p[0].get<double>() + dx, p[1].get<double>() + dy};
    points[0] = at;
    at = points.back();
    path["curves"].push_back({{"type", "bezier"}, {"points", points}});
  }
  return path;
}

TEST(RandomCurves, PiecesAreEditedWithinWhatIsSaid) {
  Random random(14);
  for (int n = 0; n < requests(0.02); ++n) {
    json request{{"op", "curve.edit_pieces"}, {"curve", any_path(random)}};
    const double length = length_of(beziers_of(request["curve"]));
    if (n % 2 == 0) request["limit"] = 0.03 * length;
    if (n % 3 == 0) request["amount"] = uniform(random, 0, 1);
    SCOPED_TRACE(digest(request));
    const json result = result_of(request);
    const double rounding = 1e-12 * length;
    const auto given = beziers_of(request["curve"]), edited = beziers_of(result["curve"]);
    ASSERT_EQ(given.size(), edited.size());
    for (std::size_t i = 0; i < given.size(); ++i) {
      const double told = result["pieces"][i]["departure"];
      EXPECT_LE(farthest_from({edited[i]}, places_of({given[i]}, 50)), told + rounding);
      EXPECT_LE(farthest_from({given[i]}, places_of({edited[i]}, 50)), told + rounding);
      for (const double t : {0.0, 1.0}) {
        const Spot a = spot(given[i], t), b = spot(edited[i], t);
        EXPECT_LT(distance(a.place, b.place), 1e-12 * length);
        EXPECT_LT(std::abs(wrapped(direction(a) - direction(b))), 1e-7);
      }
      if (request.contains("limit")) {
        EXPECT_LE(told, request["limit"].get<double>());
      }
    }
  }
}

json any_log_aesthetic(Random& random) {
  const Frame2 frame = any_frame(random);
  json curve{{"type", "log-aesthetic"},
             {"start", frame(0, 0)},
             {"direction", frame.angle},
             {"pieces", json::array()}};
  double k = uniform(random, 0.1, 2);
  const std::size_t count = 1 + random() % 3;
  for (std::size_t i = 0; i < count; ++i) {
    const double next = k * power_of_ten(random, -0.7, 0.7);
    curve["pieces"].push_back({{"alpha", uniform(random, -2, 2)},
                               {"length", frame.size * uniform(random, 0.3, 1)},
                               {"curvature", {k / frame.size, next / frame.size}}});
    k = next;
  }
  return curve;
}

json any_curve(Random& random) {
  switch (random() % 4) {
    case 0:
      return any_bspline(random);
    case 1:
      return any_log_aesthetic(random);
    case 2:
      return any_path(random);
    default:
      return any_bezier(random);
  }
}

/// Places of either within so much of the other.
void expect_together(const json& a, const json& b, double allowed) {
  const auto pa = beziers_of(a), pb = beziers_of(b);
  EXPECT_LE(farthest_from(pb, own::places_of(a, 60)), allowed);
  EXPECT_LE(farthest_from(pa, own::places_of(b, 60)), allowed);
}

double extent(const json& curve) {
  double most = 0;
  const auto all = own::places_of(curve, 40);
  for (const Vec& p : all) most = std::max(most, distance(p, all[0]));
  return most;
}

double farthest(const json& curve) {
  double most = 0;
  for (const Vec& p : own::places_of(curve, 40)) most = std::max(most, size(p));
  return most;
}

TEST(RandomCurves, FormsKeepWithinTheDeviationTheyTell) {
  Random random(15);
  for (int n = 0; n < requests(0.05); ++n) {
    const json curve = any_curve(random);
    const double size = extent(curve);
    const double tolerance = size * power_of_ten(random, -6, -2);
    const int degree = 3 + static_cast<int>(random() % 4);
    const json request{{"op", "curve.show"},
                       {"curve", curve},
                       {"samples", 20},
                       {"bezier", {{"degree", degree}, {"tolerance", tolerance}}},
                       {"nurbs", {{"degree", degree}, {"tolerance", tolerance}}}};
    SCOPED_TRACE(digest(request));
    const json result = result_of(request);
    const double rounding = 1e-14 * farthest(curve) + 1e-13 * size;
    for (const char* form : {"bezier", "nurbs"}) {
      const double told = result[form]["deviation"];
      EXPECT_LE(told, tolerance);
      const auto made = beziers_of(result[form]);
      EXPECT_LE(farthest_from(made, own::places_of(curve, 100)), told + rounding) << form;
      if (curve["type"] == "log-aesthetic") continue;
      const auto given = beziers_of(curve);
      EXPECT_LE(farthest_from(given, places_of(made, 1 + 100 / static_cast<int>(made.size()))),
                told + rounding)
          << form;
    }
    EXPECT_EQ(result["polyline"]["points"].size(), 20U);
    if (curve["type"] == "log-aesthetic") continue;
    const auto given = beziers_of(curve);
    for (const json& p : result["polyline"]["points"])
      EXPECT_LT(distance_from(given, vec(p)), 1e-10 * size + rounding);
  }
}

TEST(RandomCurves, AreWorkedOnAsTheyStand) {
  Random random(16);
  for (int n = 0; n < requests(0.04); ++n) {
    json curve = any_curve(random);
    while (curve["type"] == "log-aesthetic") curve = any_curve(random);
    SCOPED_TRACE(digest(curve));
    const double allowed = 1e-11 * extent(curve) + 1e-14 * farthest(curve);
    const auto beziers = beziers_of(curve);
    const double length = length_of(beziers);
    const json back = result_of({{"op", "curve.reverse"}, {"curve", curve}})["curve"];
    EXPECT_LT(distance(spot(beziers_of(back).front(), 0).place, spot(beziers.back(), 1).place),
              allowed);
    expect_together(back, curve, allowed);
    // Twice in the same mirror.
    json mirror{{"op", "curve.mirror"},
                {"curve", curve},
                {"point", {uniform(random, -1, 1), 2}},
                {"direction", uniform(random, -3, 3)}};
    mirror["curve"] = result_of(mirror)["curve"];
    EXPECT_NEAR(length_of(beziers_of(mirror["curve"])) / length, 1, 1e-9);
    expect_together(result_of(mirror)["curve"], curve, allowed);
    const double from = uniform(random, 0, 0.5), to = uniform(random, 0.5, 1);
    const json part =
        result_of({{"op", "curve.trim"}, {"curve", curve}, {"from", from}, {"to", to}})["curve"];
    EXPECT_NEAR(length_of(beziers_of(part)) / length, to - from, 1e-8);
    EXPECT_LT(farthest_from(beziers, own::places_of(part, 40)), allowed);
    const json parts =
        result_of({{"op", "curve.split"}, {"curve", curve}, {"at", {from, to}}})["parts"];
    ASSERT_EQ(parts.size(), 3U);
    double sum = 0;
    for (const json& p : parts) sum += length_of(beziers_of(p["curve"]));
    EXPECT_NEAR(sum / length, 1, 1e-9);
    EXPECT_NEAR(length_of(beziers_of(parts[0]["curve"])) / length, from, 1e-8);
    // Put together again, in any order.
    const json joined =
        result_of({{"op", "curve.join"},
                   {"tolerance", 10 * allowed},
                   {"curves", {parts[0]["curve"], parts[2]["curve"], parts[1]["curve"]}}});
    EXPECT_NEAR(length_of(beziers_of(joined["curve"])) / length, 1, 1e-9);
  }
}

TEST(RandomCurves, OffsetsLieAtTheirDistance) {
  Random random(17);
  int drawn = 0;
  for (int n = 0; n < requests(0.04); ++n) {
    json curve = one_or_more(random);
    if (n % 4 == 0) {  // a handle drawn in
      curve = any_bezier(random, 3, 3);
      curve["points"][random() % 2 == 0 ? 1 : 2] = curve["points"][n % 8 == 0 ? 0 : 3];
    }
    const auto beziers = beziers_of(curve);
    const double length = length_of(beziers);
    const double d = sign(random) * length * power_of_ten(random, -3, -0.7);
    const double tolerance = length * power_of_ten(random, -6, -3);
    const json request{
        {"op", "curve.offset"}, {"curve", curve}, {"distance", d}, {"tolerance", tolerance}};
    SCOPED_TRACE(digest(request));
    const json answer = answered(request);
    auto k = curvatures(beziers, 500);
    std::erase_if(k, [](double x) { return !std::isfinite(x); });
    const auto [least, most] = std::ranges::minmax(k);
    const bool turns_back = d > 0 ? most * d >= 1 : least * d >= 1;
    if (answer["ok"] == false) {
      EXPECT_EQ(answer["error"]["code"], "undrawable") << answer;
      // Next to a drawn-in handle curvature grows without end, past all places looked at here.
      EXPECT_GT(std::max(most * d, least * d), n % 4 == 0 ? 0 : 1 - 1e-3) << answer;
      continue;
    }
    EXPECT_FALSE(turns_back);
    ++drawn;
    const double told = answer["result"]["deviation"];
    EXPECT_LE(told, tolerance);
    const auto made = beziers_of(answer["result"]["curve"]);
    std::vector<Vec> exact;
    for (const Spot& s : spots(beziers, 100 / static_cast<int>(beziers.size()))) {
      const double v = size(s.first);
      if (v == 0) continue;
      exact.push_back(s.place + (d / v) * Vec{-s.first[1], s.first[0], 0});
    }
    EXPECT_LE(farthest_from(made, exact), told + 1e-12 * length + 1e-14 * farthest(curve));
  }
  EXPECT_GT(drawn, requests(0.04) / 5);
}

TEST(RandomCurves, AreComparedAndMeasuredAgainstPoints) {
  Random random(18);
  for (int n = 0; n < requests(0.03); ++n) {
    json a = one_or_more(random);
    const double size = extent(a);
    json b = with_points(a, [&](json p) {
      for (json& x : p) x = x.get<double>() + size * uniform(random, -0.1, 0.1);
      return p;
    });
    const json request{{"op", "curve.compare"}, {"curves", {a, b}}, {"places", 33}};
    SCOPED_TRACE(digest(request));
    const json result = result_of(request);
    const auto pa = beziers_of(a), pb = beziers_of(b);
    for (const std::size_t i : {0, 1}) {
      const json& d = result["deviation"][i];
      const double there = distance_from(i == 0 ? pb : pa, vec(d["at"]));
      EXPECT_NEAR(d["max"], there, 1e-9 * size);
      EXPECT_NEAR(result["combs"][i]["length"].get<double>() / length_of(i == 0 ? pa : pb), 1,
                  1e-9);
      // Seen from no place is the other curve much farther than the largest that was told.
      for (const Spot& s : spots(i == 0 ? pa : pb, 20))
        EXPECT_LE(distance_from(i == 0 ? pb : pa, s.place),
                  d["max"].get<double>() + length_of(i == 0 ? pa : pb) / 32);
    }
    json points = json::array();
    for (int k = 0; k < 20; ++k)
      points.push_back({pa[0][0][0] + size * uniform(random, -1, 1),
                        pa[0][0][1] + size * uniform(random, -1, 1)});
    const json away = result_of({{"op", "curve.deviation"}, {"curve", a}, {"points", points}});
    for (std::size_t k = 0; k < points.size(); ++k) {
      EXPECT_NEAR(std::abs(away["distance"][k].get<double>()), distance_from(pa, vec(points[k])),
                  1e-9 * size);
      EXPECT_NEAR(distance(vec(away["feet"][k]), vec(points[k])),
                  std::abs(away["distance"][k].get<double>()), 1e-12 * size + 1e-15 * farthest(a));
    }
  }
}

TEST(RandomCurves, JointsAreWhatTheyAreMade) {
  Random random(19);
  Worst worst("curvature jump");
  for (int n = 0; n < requests(0.03); ++n) {
    const json a = one_or_more(random), b = one_or_more(random);
    const json request{{"op", "curve.continuity"}, {"curves", {a, b}}, {"closed", true}};
    SCOPED_TRACE(digest(request));
    const json joints = result_of(request)["joints"];
    ASSERT_EQ(joints.size(), 2U);
    const auto pa = beziers_of(a), pb = beziers_of(b);
    for (const std::size_t i : {0, 1}) {
      const Spot end = spot((i == 0 ? pa : pb).back(), 1);
      const Spot start = spot((i == 0 ? pb : pa).front(), 0);
      const double far = size(end.place) + size(start.place);
      EXPECT_NEAR(joints[i]["gap"], distance(end.place, start.place), 1e-14 * far);
      EXPECT_LT(
          std::abs(wrapped(joints[i]["angle"].get<double>() - direction(start) + direction(end))),
          1e-9);
      const double jump = curvature(start) - curvature(end);
      worst.expect_below(std::abs(joints[i]["curvature_jump"].get<double>() - jump) /
                             (std::abs(curvature(start)) + std::abs(curvature(end))),
                         1e-9);
    }
  }
}

}  // namespace
}  // namespace keyline::operations
