#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>

#include <gtest/gtest.h>

#include "random_values.h"

/// Requests drawn at random until so many were refused: where an operation says that there is no
/// answer, a search of another kind must not find one. 60 of each kind; with KEYLINE_FULL set
/// 1,000. Those of lac.segment are proved in random_requests_test.cpp.
namespace keyline::operations {
namespace {

using nlohmann::json;
using own::answered;
using own::Random;
using own::uniform;
using Complex = std::complex<double>;

constexpr double kPi = std::numbers::pi;

double any_slope(Random& random) {
  return random() % 4 == 0 ? static_cast<double>(random() % 5) - 2 : uniform(random, -3, 3);
}

/// Radius of curvature by tangent angle: d rho / d theta = rate rho^(2 - alpha) from `start` on;
/// empty where it has run to infinity.
std::optional<double> radius(double alpha, double start, double rate, double turned) {
  if (std::abs(alpha - 1) < 1e-12) return start * std::exp(rate * turned);
  const double power = std::pow(start, alpha - 1) + (alpha - 1) * rate * turned;
  if (!(power > 0)) return std::nullopt;
  return std::pow(power, 1 / (alpha - 1));
}

/// Chord angle, from the first tangent, of the curve of two slopes that turns by theta, the radius
/// 1 at its sharp end and growing at `rate` there; empty where it runs out before.
std::optional<double> compound_chord_angle(double a0, double a1, double ratio, double theta,
                                           double rate) {
  const auto joint = radius(a0, 1, rate, ratio * theta);
  if (!joint || !std::isfinite(*joint) || !(*joint > 0)) return std::nullopt;
  // The same rate, the other law; in the joint's radius, so that no power leaves the doubles.
  const double second = rate * std::pow(*joint, 1 - a0);
  const auto at = [&](double turned) -> std::optional<double> {
    if (turned <= ratio * theta) return radius(a0, 1, rate, turned);
    const auto relative = radius(a1, 1, second, turned - ratio * theta);
    if (!relative) return std::nullopt;
    return *joint * *relative;
  };
  const auto last = at(theta);
  if (!last || !std::isfinite(*last)) return std::nullopt;
  const auto along = [&](double from, double to, bool cosine) {
    return own::integral(
        [&](double turned) {
          const double rho = at(turned).value_or(0) / *last;
          return rho * (cosine ? std::cos(turned) : std::sin(turned));
        },
        from, to);
  };
  const double x = along(0, ratio * theta, true) + along(ratio * theta, theta, true);
  const double y = along(0, ratio * theta, false) + along(ratio * theta, theta, false);
  return std::atan2(y, x);
}

/// Every rate from next to none to next to too much.
TEST(RandomRefusals, NoCompoundCurveIsFoundByScanningAllRates) {
  Random random(own::seed(41));
  int refused = 0;
  for (int n = 0; refused < own::refusals(60) && n < 100 * own::refusals(60); ++n) {
    const double theta = uniform(random, 0.1, 2.5);
    const double psi = theta * uniform(random, 0.55, 0.999);
    const double a0 = any_slope(random), a1 = any_slope(random);
    const double ratio = uniform(random, 0.05, 0.95);
    const double s = std::sin(theta - psi) / std::sin(theta);
    const json request{{"op", "lac.compound"},
                       {"points", {{0, 0}, {s * std::cos(psi), -s * std::sin(psi)}, {1, 0}}},
                       {"alpha", {a0, a1}},
                       {"ratio", ratio}};
    SCOPED_TRACE(request.dump());
    const json answer = answered(request);
    if (answer["ok"] == true) continue;
    ASSERT_EQ(answer["error"]["code"], "undrawable") << answer;
    ++refused;
    double most = 0;
    double known = -20, beyond = INFINITY;  // ln of a rate that serves, of one that does not
    for (double log_rate = -20; log_rate < 300; log_rate += 0.5) {
      const auto angle = compound_chord_angle(a0, a1, ratio, theta, std::exp(log_rate));
      if (!angle) {
        beyond = log_rate;
        break;
      }
      known = log_rate;
      most = std::max(most, *angle);
    }
    for (int k = 0; k < 40 && std::isfinite(beyond); ++k) {
      const double middle = 0.5 * (known + beyond);
      const auto angle = compound_chord_angle(a0, a1, ratio, theta, std::exp(middle));
      (angle ? known : beyond) = middle;
      if (angle) most = std::max(most, *angle);
    }
    EXPECT_GT(std::max(psi, theta - psi), most - 1e-9);
  }
  EXPECT_EQ(refused, own::refusals(60));
}

/// Class A curves of one matrix on a grid of the plane: none ends where one was refused.
TEST(RandomRefusals, NoClassACurveIsFoundOnAGridOfThePlane) {
  Random random(own::seed(42));
  int refused = 0;
  for (int n = 0; refused < own::refusals(60) && n < 100 * own::refusals(60); ++n) {
    const int degree = 2 + static_cast<int>(random() % 5);
    const double alpha = uniform(random, 0.02, 1.09), s = uniform(random, 0.3, 3);
    const double low = uniform(random, 0, 0.9), high = low + uniform(random, 0.02, 0.2);
    const json request{{"op", "curve.cav"},
                       {"alpha", alpha},
                       {"s", s},
                       {"degree", degree},
                       {"direction", "as-given"},
                       {"branch", random() % 2 == 0 ? "growing" : "falling"},
                       {"alpha_range", {low, high}},
                       {"s_range", {0.2, 5}},
                       {"end_tolerance", 0}};
    SCOPED_TRACE(request.dump());
    const json answer = answered(request);
    if (answer["ok"] == true) continue;
    ASSERT_EQ(answer["error"]["code"], "undrawable") << answer;
    ++refused;
    const bool growing = request["branch"] == "growing";
    const auto reach = [&](double a, double scale) {
      Complex sum = 0, edge = 1;
      for (int i = 0; i < degree; ++i) {
        sum += edge;
        edge *= std::polar(scale, a);
      }
      return sum;
    };
    // The direction of the end, continued along s: where it passes the one wanted there is a curve,
    // whatever its size (beta).
    const Complex wanted = reach(alpha, s);
    constexpr int kAlphas = 60, kScales = 400;
    for (int i = 0; i <= kAlphas; ++i) {
      const double a = std::lerp(low, high, i / double{kAlphas});
      const double edge = growing ? 1 / std::cos(a) : std::cos(a);
      const double from = growing ? edge : 0.2, to = growing ? 5 : std::min(edge, 5.0);
      if (!(to >= from)) continue;
      double before = NAN;
      for (int j = 0; j <= kScales; ++j) {
        const double scale = from * std::pow(to / from, j / double{kScales});
        const double off = std::arg(reach(a, scale) / wanted);
        const bool passes = before * off < 0 && std::abs(off - before) < 1;
        EXPECT_FALSE(passes) << a << ' ' << scale;
        if (passes) break;
        before = off;
      }
    }
  }
  EXPECT_EQ(refused, own::refusals(60));
}

/// With slopes from 0 on curvature never changes its sign: the tangent turns one way from the first
/// direction to the last, and the chord, a mean of the tangents, lies between them.
TEST(RandomRefusals, ChainsWithCurvaturesAreRefusedByTheirSignsAlone) {
  Random random(own::seed(43));
  int refused = 0;
  for (int n = 0; refused < own::refusals(60) && n < 100 * own::refusals(60); ++n) {
    const double alpha = uniform(random, -3, 3);
    const double from = uniform(random, -1.5, 1.5), to = uniform(random, -1.5, 1.5);
    const json request{
        {"op", "lac.hermite"}, {"start", {0, 0}},
        {"end", {1, 0}},       {"directions", {from, to}},
        {"alpha", alpha},      {"curvatures", {uniform(random, -3, 3), uniform(random, -3, 3)}}};
    SCOPED_TRACE(request.dump());
    const json answer = answered(request);
    if (answer["ok"] == true) continue;
    if (answer["error"]["code"] == "not-converged") continue;  // says itself that none was found
    ASSERT_EQ(answer["error"]["code"], "undrawable") << answer;
    ++refused;
    EXPECT_GE(alpha, 0);
    const double turning = to - from;
    const bool between = from * to < 0;
    const bool signs = request["curvatures"][0].get<double>() * turning > 0 &&
                       request["curvatures"][1].get<double>() * turning > 0;
    EXPECT_FALSE(between && signs) << answer;
  }
  EXPECT_EQ(refused, own::refusals(60));
}

}  // namespace
}  // namespace keyline::operations
