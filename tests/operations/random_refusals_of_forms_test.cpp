#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <iostream>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "own_gauss.h"
#include "random_values.h"

/// Refusals of the Taylor forms and the rational cubic of lac.quasi, held against searches of
/// another kind (see random_refusals_test.cpp).
namespace keyline::operations {
namespace {

using nlohmann::json;
using own::answered;
using own::Random;
using own::refusals;
using own::uniform;
using Complex = std::complex<double>;

struct Handles {
  double theta = 0, psi = 0;
  json points() const {
    const double s = std::sin(theta - psi) / std::sin(theta);
    return {{0, 0}, {s * std::cos(psi), -s * std::sin(psi)}, {1, 0}};
  }
};
Handles any_handles(Random& random) {
  const double theta = uniform(random, 0.2, 2.5);
  return {theta, theta * uniform(random, 0.05, 0.95)};
}

/// What a Taylor polynomial misses handles by: the turning of its end tangents, the chord's angle.
struct Off {
  double turning = 0, chord = 0;
};

struct Series {
  bool by_angle = false;
  double alpha = 0, about = 0;
  int degree = 0;
};

/// Of the series of a curve that turns by `turned` and whose radius grows by e^growth: of its
/// velocity, by powers of the fraction of angle or arc, from the law alone. Its scale is its own.
std::vector<Complex> velocity(const Series& s, double turned, double growth) {
  const double power = s.by_angle ? s.alpha - 1 : s.alpha;  // of the radius, that runs linearly
  const double low = std::exp(power * std::min(growth, 0.0)),
               high = std::exp(power * std::max(growth, 0.0));
  const double first = growth < 0 ? high : low, last = growth < 0 ? low : high;
  // rate: of ln(base) by the fraction, at the point of expansion.
  const double rate =
      std::abs(power) < 1e-9 ? growth : (last - first) / std::lerp(first, last, s.about) / power;
  const double exponent = s.by_angle ? 1 : -1;  // of the radius in what is expanded
  std::vector<double> law{1};                   // radius or curvature, 1 at the point of expansion
  for (int k = 0; k + 1 < s.degree; ++k)
    law.push_back(law.back() * rate * (exponent - power * k) / (k + 1));
  // d theta / du, of the law's scale: `turned` over its integral.
  double scale = turned;
  if (!s.by_angle) {
    const auto curvature = [&](double u) {
      const double base = std::lerp(first, last, u) / std::lerp(first, last, s.about);
      return std::abs(power) < 1e-9 ? std::exp(-growth * (u - s.about))
                                    : std::pow(base, -1 / power);
    };
    double whole = 0;
    constexpr int kPanels = 24;  // towards both ends
    for (int i = 0; i < kPanels; ++i) {
      const double from = i == 0 ? 0 : std::exp2(i - kPanels), to = std::exp2(i + 1 - kPanels);
      whole +=
          own::gauss(curvature, from / 2, to / 2) + own::gauss(curvature, 1 - to / 2, 1 - from / 2);
    }
    scale = turned / whole;
  }
  std::vector<Complex> v{1};
  for (int k = 0; k + 1 < s.degree; ++k) {
    Complex next = 0;  // of e^(i theta): its derivative is i theta' times itself
    if (s.by_angle)
      next = v.back() * Complex(0, scale) / (k + 1.0);
    else {
      for (int j = 0; j <= k; ++j) next += Complex(0, scale) * law[j] * v[k - j];
      next /= k + 1.0;
    }
    v.push_back(next);
  }
  if (!s.by_angle) return v;
  std::vector<Complex> product(v.size());
  for (std::size_t i = 0; i < v.size(); ++i)
    for (std::size_t j = 0; j <= i; ++j) product[i] += law[j] * v[i - j];
  return product;
}

std::optional<Off> off(const Series& s, const Handles& h, double turned, double growth) {
  const std::vector<Complex> v = velocity(s, turned, growth);
  const auto sum = [&](double x, bool integrated) {
    Complex all = 0;
    for (std::size_t k = v.size(); k-- > 0;) all = all * x + (integrated ? v[k] / (k + 1.0) : v[k]);
    return integrated ? all * x : all;
  };
  const Complex first = sum(-s.about, false), last = sum(1 - s.about, false);
  const Complex chord = sum(1 - s.about, true) - sum(-s.about, true);
  const Off o{own::wrapped(std::arg(last / first) - h.theta),
              own::wrapped(std::arg(chord / first) - h.psi)};
  const double shortest = std::min(std::abs(first), std::abs(last)) / s.degree;
  if (!std::isfinite(o.turning + o.chord) || !(shortest > 1e-8 * std::abs(chord)))
    return std::nullopt;
  return o;
}

struct Cell {
  double t0 = 0, t1 = 0, g0 = 0, g1 = 0;
  std::array<Cell, 4> quarters() const {
    const double t = 0.5 * (t0 + t1), g = 0.5 * (g0 + g1);
    return {{{t0, t, g0, g}, {t, t1, g0, g}, {t0, t, g, g1}, {t, t1, g, g1}}};
  }
};

/// The miss at a place of a cell, both from 0 to 1.
std::optional<Off> off(const Series& s, const Handles& h, const Cell& c, double x, double y) {
  return off(s, h, std::lerp(c.t0, c.t1, x), std::lerp(c.g0, c.g1, y));
}

/// How often the miss runs round nought along the border of a cell, drawn so that it is round
/// itself; 0 where it leaps.
int winding(const Series& s, const Handles& h, const Cell& c) {
  const auto left = off(s, h, c, 0, 0.5), right = off(s, h, c, 1, 0.5);
  const auto below = off(s, h, c, 0.5, 0), above = off(s, h, c, 0.5, 1);
  if (!left || !right || !below || !above) return 0;
  const Off x{right->turning - left->turning, right->chord - left->chord};
  const Off y{above->turning - below->turning, above->chord - below->chord};
  const double area = x.turning * y.chord - x.chord * y.turning;
  constexpr int kSteps = 6;
  double turns = 0;
  std::optional<Complex> before;
  for (int k = 0; k <= 4 * kSteps; ++k) {
    const double a = (k % (4 * kSteps)) / double{kSteps};
    const auto o = off(s, h, c,
                       a < 1   ? a
                       : a < 2 ? 1
                       : a < 3 ? 3 - a
                               : 0,
                       a < 1   ? 0
                       : a < 2 ? a - 1
                       : a < 3 ? 1
                               : 4 - a);
    if (!o) return 0;
    const Complex now((o->turning * y.chord - o->chord * y.turning) / area,
                      (x.turning * o->chord - x.chord * o->turning) / area);
    if (before) {
      const double step = std::arg(now / *before);
      if (!(std::abs(step) < 2)) return 0;
      turns += step;
    }
    before = now;
  }
  return static_cast<int>(std::lround(turns / (2 * std::numbers::pi)));
}

/// Whether both misses have either sign in a cell, and do not leap.
bool straddles(const Series& s, const Handles& h, const Cell& c) {
  Off least{INFINITY, INFINITY}, most{-INFINITY, -INFINITY};
  for (int i = 0; i <= 2; ++i)
    for (int j = 0; j <= 2; ++j) {
      const auto o = off(s, h, c, 0.5 * i, 0.5 * j);
      if (!o) return false;
      least = {std::min(least.turning, o->turning), std::min(least.chord, o->chord)};
      most = {std::max(most.turning, o->turning), std::max(most.chord, o->chord)};
    }
  return least.turning <= 0 && most.turning >= 0 && least.chord <= 0 && most.chord >= 0 &&
         most.turning - least.turning < 2 && most.chord - least.chord < 2;
}

/// Quarters of quarters in which both misses change their sign; at last, by degree: a cell round
/// whose border the miss turns holds a solution.
bool closes_in(const Series& s, const Handles& h, const Cell& c, int depth) {
  if (!straddles(s, h, c)) return false;
  if (depth == 0) {
    const double t = c.t1 - c.t0, g = c.g1 - c.g0;
    return winding(s, h, {c.t0 - t, c.t1 + t, c.g0 - g, c.g1 + g}) != 0;
  }
  for (const Cell& quarter : c.quarters())
    if (closes_in(s, h, quarter, depth - 1)) return true;
  return false;
}

/// Any turning up to a full turn, radii e^25 apart.
bool finds_series(const Series& s, const Handles& h) {
  constexpr int kTurnings = 40, kGrowths = 100;
  const auto turned = [&](int i) {
    return h.theta * 0.2 * std::pow(6.2 / h.theta / 0.2, i / double{kTurnings});
  };
  const auto growth = [](int j) { return -25 + 50.0 * j / kGrowths; };
  for (int i = 0; i < kTurnings; ++i)
    for (int j = 0; j < kGrowths; ++j)
      if (closes_in(s, h, {turned(i), turned(i + 1), growth(j), growth(j + 1)}, 9)) return true;
  return false;
}

TEST(RandomRefusals, NoTaylorFormIsFoundByTurnsRoundCells) {
  Random random(own::seed(46));
  const int wanted = refusals(6);
  int refused = 0, answered_ = 0, found = 0, disagreed = 0;
  for (int n = 0; refused < wanted && n < 200 * wanted; ++n) {
    const Handles h = any_handles(random);
    Series s{random() % 2 == 0, uniform(random, -3, 3), 0.5 * static_cast<double>(random() % 3),
             4 + static_cast<int>(random() % 7)};
    const json request{{"op", "lac.quasi"},  {"points", h.points()},
                       {"alpha", s.alpha},   {"form", s.by_angle ? "taylor-angle" : "taylor-arc"},
                       {"degree", s.degree}, {"about", s.about}};
    SCOPED_TRACE(request.dump());
    const json answer = answered(request);
    if (answer["ok"] == true) {
      if (answered_ == 10) continue;
      ++answered_;
      found += finds_series(s, h);
      continue;
    }
    if (answer["error"]["code"] == "unsupported") continue;
    ASSERT_EQ(answer["error"]["code"], "undrawable") << answer;
    const std::string why = answer["error"]["message"];
    if (why.find("no Lambda") == std::string::npos) continue;  // that of the target itself
    ++refused;
    if (!finds_series(s, h)) continue;
    ++disagreed;
    std::cout << "found: " << request << '\n';
  }
  EXPECT_EQ(refused, wanted);
  // Next to places at which a tangent leaps round, a few in a thousand lie in no cell that the
  // operation's scan goes into: its answer says that none was found.
  EXPECT_LE(disagreed, wanted / 100);
  RecordProperty("disagreed", std::to_string(disagreed));
  EXPECT_GE(found, answered_ / 2);  // of ten that exist; six to ten with the seeds tried
}

/// Between one-sided handles that turn by less than half a turn there always is one: small handles
/// leave both weights free, which are sought from 1e-4 to 1e4.
TEST(RandomRefusals, RationalCubicsAreFoundOverAllHandles) {
  Random random(own::seed(47));
  int asked = 0;
  while (asked < refusals(60)) {
    const json request{{"op", "lac.quasi"},
                       {"points", any_handles(random).points()},
                       {"alpha", uniform(random, -3, 3)},
                       {"form", "rational-cubic"}};
    SCOPED_TRACE(request.dump());
    json target = request;
    target["op"] = "lac.segment";
    target.erase("form");
    const json drawn = answered(target);
    if (drawn["ok"] == false) continue;
    // at the border of what can be drawn an end's curvature is 1e13 times the other's
    const json& bend = drawn["result"]["curve"]["pieces"][0]["curvature"];
    const auto [low, high] =
        std::minmax({std::abs(bend[0].get<double>()), std::abs(bend[1].get<double>())});
    if (!(low > 1e-9 * high)) continue;
    ++asked;
    EXPECT_EQ(answered(request)["ok"], true);
  }
}

/// Whether some rational cubic with these end curvatures over the handles has weights from 1e-4 to
/// 1e4, with a little to spare, by a grid of both shares of the edges. With the curvature at an end
/// 4/3 w0 w2 / w1^2 times the area of the three over the cube (Farin) it is bend = 2/3 w2 / w1^2 h
/// / a^2, a = x A and h = (1 - y) B sin(theta).
bool has_rational_cubic(const Handles& h, double length, double first_bend, double last_bend) {
  constexpr int kSteps = 240;
  constexpr double kMost = 27, kShortest = 1.1e-8;  // ln(1e12) is 27.6
  const double a = std::sin(h.theta - h.psi) / std::sin(h.theta),
               b = std::sin(h.psi) / std::sin(h.theta);
  const double first = std::log(1.5 * first_bend * a * a / (b * std::sin(h.theta)));
  const double last = std::log(1.5 * last_bend * b * b / (a * std::sin(h.theta)));
  for (int i = 0; i <= kSteps; ++i)
    for (int j = 0; j <= kSteps; ++j) {
      const double u = -20 + 40.0 * i / kSteps, v = -20 + 40.0 * j / kSteps;
      const double x = 1 / (1 + std::exp(-u)), y = 1 / (1 + std::exp(-v));
      const double shortest =
          std::min({x * a, y * b, a / (1 + std::exp(u)), b / (1 + std::exp(v))});
      const double p = first + 2 * std::log(x) + std::log1p(std::exp(v));  // ln(w2 / w1^2)
      const double q = last + 2 * std::log(y) + std::log1p(std::exp(u));   // ln(w1 / w2^2)
      if (shortest > kShortest * length && std::abs(2 * p + q) < kMost &&
          std::abs(p + 2 * q) < kMost)
        return true;
    }
  return false;
}

/// Beside the borders, with slopes next to 0 and 1, where end curvatures are up to 1e300 apart.
TEST(RandomRefusals, NoRationalCubicIsFoundByItsWeights) {
  Random random(own::seed(49));
  const int wanted = refusals(12);
  int refused = 0, answered_ = 0, found = 0;
  for (int n = 0; refused < wanted && n < 100 * wanted; ++n) {
    Handles h{std::exp(uniform(random, std::log(0.02), std::log(2.9)))};
    const double edge = own::power_of_ten(random, -6, -0.3);
    h.psi = h.theta * (random() % 2 == 0 ? edge : 1 - edge);
    json request{
        {"op", "lac.segment"}, {"points", h.points()}, {"alpha", uniform(random, -0.5, 1.5)}};
    const json drawn = answered(request);
    if (drawn["ok"] == false || drawn["result"]["curve"]["pieces"].size() > 1) continue;
    const json& piece = drawn["result"]["curve"]["pieces"][0];
    if (!piece.contains("curvature")) continue;
    const double first = std::abs(piece["curvature"][0].get<double>()),
                 last = std::abs(piece["curvature"][1].get<double>());
    if (!(first > 0 && last > 0)) continue;
    request["op"] = "lac.quasi";
    request["form"] = "rational-cubic";
    SCOPED_TRACE(request.dump());
    const json answer = answered(request);
    const bool exists = has_rational_cubic(h, piece["length"], first, last);
    if (answer["ok"] == true) {
      ++answered_;
      found += exists;
      continue;
    }
    ++refused;
    EXPECT_FALSE(exists) << answer;
  }
  EXPECT_EQ(refused, wanted);
  EXPECT_LE(answered_ - found, 2 + answered_ / 50);  // else it has no say in what is refused
}

// Found with seed 9112: end curvatures 3e8 times apart, which weights below 1e4 give only where
// both handles end beside the third one given.
TEST(RandomRefusals, ARationalCubicWithHandlesNearTheirMeetingIsFound) {
  const json request = json::parse(R"({"op":"lac.quasi","form":"rational-cubic",
    "alpha":-0.22487142777552682,"points":[[0,0],[0.8527908142208221,-0.07048413162100069],[1,0]]})");
  const json result = own::result_of(request);
  const json& bend = result["target"]["pieces"][0]["curvature"];
  const std::vector<std::array<double, 2>> p = result["curve"]["points"];
  const std::vector<double> w = result["curve"]["weights"];
  // Farin, Curves and Surfaces for CAGD: 4/3 w0 w2 / w1^2 times the area of the three over the cube
  const auto curvature = [&](std::size_t i, std::size_t j, std::size_t k) {
    const double x = p[j][0] - p[i][0], y = p[j][1] - p[i][1];
    const double area = (x * (p[k][1] - p[j][1]) - y * (p[k][0] - p[j][0])) / 2;
    return 4.0 / 3 * w[i] * w[k] / (w[j] * w[j]) * area / std::pow(std::hypot(x, y), 3);
  };
  EXPECT_NEAR(curvature(0, 1, 2) / bend[0].get<double>(), 1, 1e-6);
  EXPECT_NEAR(-curvature(3, 2, 1) / bend[1].get<double>(), 1, 1e-6);
  EXPECT_NEAR(p[1][1] / p[1][0], -0.07048413162100069 / 0.8527908142208221, 1e-12);
  EXPECT_NEAR(p[2][1] / (1 - p[2][0]), -0.07048413162100069 / (1 - 0.8527908142208221), 1e-9);
}

}  // namespace
}  // namespace keyline::operations
